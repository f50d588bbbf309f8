#include "tests/benchmarks/device_rays.h"

#include <limits>

#include "benchmark_kernels.h"
#include "renderengine/error.h"

namespace antipode::benchmark {
namespace {

using namespace shared;

constexpr uint32_t groupSize = 64;

std::vector<std::pair<uint32_t, uint32_t>> specialisation(const PackedScene& packed) {
    return {{SPEC_FEATURES, packed.features},
            {SPEC_LOBES, packed.lobes},
            {SPEC_STACK_DEPTH, std::max(packed.bvh.stackDepth, 1u)},
            {SPEC_GROUP_SIZE, groupSize}};
}

}  // namespace

DeviceRays::DeviceRays(Device& device, const PackedScene& packed)
    : device_(device),
      scene_(device, packed),
      table_(device, kernelBindings(), sizeof(DispatchParameters<double>)),
      commands_(device),
      counters_(device, 4ull * COUNTER_COUNT, Residency::HostVisible),
      pipeline_(device, table_, benchmark_kernels::closest_hit(), specialisation(packed)) {
    counters_.fill(0);
    scene_.bind(table_);
    table_.set(BIND_COUNTERS, counters_);
}

void DeviceRays::load(std::span<const Ray> rays) {
    count_ = uint32_t(rays.size());
    std::vector<vec4> texels;
    texels.reserve(2 * rays.size());
    for (const auto& [origin, direction] : rays) {
        texels.push_back({origin.x, origin.y, origin.z, 0});
        texels.push_back({direction.x, direction.y, direction.z, 0});
    }
    rays_.clear();
    hits_.clear();
    rays_.emplace_back(device_, texels.size() * sizeof(vec4), Residency::DeviceOnly);
    rays_[0].upload(texels.data(), texels.size() * sizeof(vec4));
    hits_.emplace_back(device_, rays.size() * sizeof(uvec4), Residency::DeviceOnly);
    table_.set(BIND_PATHS, rays_[0], VK_FORMAT_R32G32B32A32_UINT);
    table_.set(BIND_HITS_OUT, hits_[0]);
}

Duration DeviceRays::trace() {
    DispatchParameters<float> push{};
    push.elementCount = count_;
    commands_.begin();
    commands_.bind(table_);
    commands_.timestamp("start");
    commands_.dispatch(pipeline_, (count_ + groupSize - 1) / groupSize, std::as_bytes(std::span(&push, 1)));
    commands_.barrier();
    commands_.timestamp("done");
    Duration duration = timed([&] { commands_.submitAndWait(); });
    if (const auto stamps = commands_.timestampSeconds(); !stamps.empty()) duration.wall = stamps.back().seconds;
    return duration;
}

std::vector<float> DeviceRays::distances() const {
    std::vector<uint32_t> counters(COUNTER_COUNT);
    counters_.download(counters.data(), counters_.bytes());
    if (counters[COUNTER_EVENTS + SOURCE_CAMERA_TRACE * EVENT_KINDS + EVENT_LOOP_LIMIT] != 0)
        throw Error(ErrorCode::Device, "The driver cut a traversal short.");
    struct Hit {
        float t, b1, b2;
        uint32_t primitive;
    };
    std::vector<Hit> hits(count_);
    hits_[0].download(hits.data(), hits.size() * sizeof(Hit));
    std::vector<float> result;
    result.reserve(hits.size());
    for (const Hit& hit : hits)
        result.push_back(hit.primitive == NO_INDEX ? std::numeric_limits<float>::infinity() : hit.t);
    return result;
}

}  // namespace antipode::benchmark
