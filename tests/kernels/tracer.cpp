#include "tests/kernels/tracer.h"

namespace antipode {

Tracer::Tracer(Device& device, const Scene& scene, std::optional<uint32_t> stackDepth)
    : scene_(scene),
      packed_([&] {
          PackedScene packed = packScene(scene);
          packed.bvh.stackDepth = stackDepth.value_or(packed.bvh.stackDepth);
          return packed;
      }()),
      packedIndex_(packed_.bvh.primitiveOrder.size()),
      harness_(device, packed_, {}) {
    for (uint32_t i = 0; i < packedIndex_.size(); ++i) packedIndex_[packed_.bvh.primitiveOrder[i]] = i;
}

std::vector<TracedHit> Tracer::trace(const std::vector<TracedRay>& rays, uint32_t variant) {
    ProbeData inputs;
    for (const TracedRay& ray : rays) {
        inputs.a.push_back(texel(ray.origin, ray.tMax));
        inputs.b.push_back(texel(ray.direction, packedIndex(ray.startsOn)));
    }
    const ProbeData outputs = harness_.run(kernel_probes::intersect_probe(), inputs, variant);
    std::vector<TracedHit> hits;
    for (const Texel& out : outputs.a) {
        const uint32_t primitive = bitsOf(out.w);
        hits.push_back({out.x, out.y, out.z,
                        primitive == shared::NO_INDEX ? primitive : packed_.bvh.primitiveOrder.at(primitive)});
    }
    return hits;
}

ProbeData Tracer::leaveProbe(const std::vector<TracedRay>& rays, const std::vector<TracedHit>& hits,
                             const std::vector<Vec3f>& directions) {
    ProbeData inputs;
    for (size_t i = 0; i < rays.size(); ++i) {
        const TracedHit& hit = hits[i];
        inputs.a.push_back({hit.t, hit.b1, hit.b2, std::bit_cast<float>(packedIndex(hit.primitive))});
        inputs.b.push_back(texel(rays[i].origin + rays[i].direction * hit.t));
        inputs.c.push_back(texel(directions[i]));
    }
    return harness_.run(kernel_probes::leave_probe(), inputs);
}

std::vector<TracedRay> Tracer::leave(const std::vector<TracedRay>& rays, const std::vector<TracedHit>& hits,
                                     const std::vector<Vec3f>& directions) {
    const ProbeData outputs = leaveProbe(rays, hits, directions);
    std::vector<TracedRay> leaving;
    for (size_t i = 0; i < rays.size(); ++i) leaving.push_back({xyz(outputs.a[i]), directions[i], hits[i].primitive});
    return leaving;
}

std::vector<Vec3f> Tracer::normals(const std::vector<TracedRay>& rays, const std::vector<TracedHit>& hits) {
    const ProbeData outputs = leaveProbe(rays, hits, std::vector<Vec3f>(rays.size(), Vec3f(0, 0, 1)));
    std::vector<Vec3f> result;
    for (const Texel& out : outputs.b) result.push_back(xyz(out));
    return result;
}

}  // namespace antipode
