#include "techniques/path_buffers.h"

namespace antipode {

using namespace shared;

PathBuffers::PathBuffers(Device& device, uint32_t batchSize, uint32_t filmPixels, const JobParameters& job)
    : batchSize_(batchSize),
      job_(device, sizeof job, Residency::DeviceOnly),
      paths_(device, 16ull * PATH_TEXELS * batchSize, Residency::DeviceOnly),
      hits_(device, 16ull * batchSize, Residency::DeviceOnly),
      radiance_(device, 16ull * batchSize, Residency::DeviceOnly),
      shadow_(device, 16ull * SHADOW_TEXELS * batchSize, Residency::DeviceOnly),
      queues_(device, 12ull * batchSize, Residency::DeviceOnly),
      counters_(device, 4ull * COUNTER_COUNT, Residency::DeviceOnly),
      slotFlags_(device, 4ull * batchSize, Residency::DeviceOnly),
      waveVertices_(device, 48ull * batchSize, Residency::DeviceOnly),
      film_(device, filmPixels) {
    job_.upload(&job, sizeof job);
    counters_.fill(0);
}

void PathBuffers::bind(BindingTable& table) const {
    table.set(BIND_JOB, job_);
    table.set(BIND_PATHS, paths_, VK_FORMAT_R32G32B32A32_UINT);
    table.set(BIND_PATHS_OUT, paths_);
    table.set(BIND_HITS, hits_, VK_FORMAT_R32G32B32A32_UINT);
    table.set(BIND_HITS_OUT, hits_);
    table.set(BIND_RADIANCE, radiance_);
    table.set(BIND_SHADOW, shadow_, VK_FORMAT_R32G32B32A32_UINT);
    table.set(BIND_SHADOW_OUT, shadow_);
    table.set(BIND_QUEUES, queues_, VK_FORMAT_R32_UINT);
    table.set(BIND_QUEUES_OUT, queues_);
    table.set(BIND_COUNTERS, counters_);
    table.set(BIND_SLOT_FLAGS, slotFlags_);
    table.set(BIND_WAVE_VERTICES, waveVertices_);
    film_.bind(table);
}

}  // namespace antipode
