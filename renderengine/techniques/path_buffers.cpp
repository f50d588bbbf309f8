#include "techniques/path_buffers.h"

#include "techniques/parameter_bytes.h"

namespace antipode {

using namespace shared;

PathBuffers::PathBuffers(Device& device, uint32_t batchSize, const Job& job, bool interfaces)
    : batchSize_(batchSize),
      job_(device, sizeof job.parameters, Residency::DeviceOnly),
      paths_(device, recordBytes(job.precision) * PATH_RECORDS * batchSize, Residency::DeviceOnly),
      hits_(device, recordBytes(job.precision) * batchSize, Residency::DeviceOnly),
      radiance_(device, recordBytes(job.precision) * batchSize, Residency::DeviceOnly),
      techniqueRadiance_(
          device,
          recordBytes(job.precision) *
              ((job.layers & LAYERS_OF_CAMERA_TECHNIQUES) != 0 ? uint64_t(CAMERA_TECHNIQUES) * batchSize : 1),
          Residency::DeviceOnly),
      shadow_(device, recordBytes(job.precision) * SHADOW_RECORDS * batchSize, Residency::DeviceOnly),
      queues_(device, 12ull * batchSize, Residency::DeviceOnly),
      counters_(device, 4ull * COUNTER_COUNT, Residency::DeviceOnly),
      slotFlags_(device, 4ull * batchSize, Residency::DeviceOnly),
      waveVertices_(device, recordBytes(job.precision) * VERTEX_RECORDS * batchSize, Residency::DeviceOnly),
      media_(device, sizeof(uvec4) * (interfaces ? MEDIA_TEXELS * uint64_t(batchSize) : 1), Residency::DeviceOnly),
      film_(device, job.film) {
    const std::vector<std::byte> parameters = parameterBytes(job.parameters, job.precision);
    job_.upload(parameters.data(), parameters.size());
    counters_.fill(0);
}

void PathBuffers::bind(BindingTable& table) const {
    table.set(BIND_JOB, job_);
    table.set(BIND_PATHS, paths_, VK_FORMAT_R32G32B32A32_UINT);
    table.set(BIND_PATHS_OUT, paths_);
    table.set(BIND_HITS, hits_, VK_FORMAT_R32G32B32A32_UINT);
    table.set(BIND_HITS_OUT, hits_);
    table.set(BIND_RADIANCE, radiance_);
    table.set(BIND_TECHNIQUE_RADIANCE, techniqueRadiance_);
    table.set(BIND_SHADOW, shadow_, VK_FORMAT_R32G32B32A32_UINT);
    table.set(BIND_SHADOW_OUT, shadow_);
    table.set(BIND_QUEUES, queues_, VK_FORMAT_R32_UINT);
    table.set(BIND_QUEUES_OUT, queues_);
    table.set(BIND_COUNTERS, counters_);
    table.set(BIND_SLOT_FLAGS, slotFlags_);
    table.set(BIND_WAVE_VERTICES, waveVertices_);
    table.set(BIND_MEDIA, media_);
    film_.bind(table);
}

}  // namespace antipode
