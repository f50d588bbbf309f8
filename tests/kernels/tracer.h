// Traces rays through a scene with lib/traversal.glsl, and starts rays on what they hit with lib/surface.glsl.
#pragma once

#include "kernels/shared/layout.h"
#include "tests/kernels/intersection_scenes.h"
#include "tests/kernels/kernel_harness.h"

namespace antipode {

struct TracedRay {
    Vec3f origin, direction;
    uint32_t startsOn = shared::NO_INDEX;  ///< in the scene's order: triangles, then spheres
    float tMax = 1e29f;
};

struct TracedHit {
    float t, b1, b2;
    uint32_t primitive;  ///< in the scene's order; NO_INDEX where the ray met nothing
    bool any() const { return primitive != shared::NO_INDEX; }
};

class Tracer {
public:
    /// `stackDepth` replaces what the BVH needs: for tests of what happens with less.
    Tracer(Device& device, const Scene& scene, std::optional<uint32_t> stackDepth = {});
    uint32_t stackDepth() const { return packed_.bvh.stackDepth; }

    std::vector<TracedHit> closest(const std::vector<TracedRay>& rays) { return trace(rays, 0); }
    /// Only whether there is a hit means anything.
    std::vector<TracedHit> any(const std::vector<TracedRay>& rays) { return trace(rays, 1); }
    /// Rays that leave the hits of `rays` in `directions`, one for each.
    std::vector<TracedRay> leave(const std::vector<TracedRay>& rays, const std::vector<TracedHit>& hits,
                                 const std::vector<Vec3f>& directions);
    /// Geometric normals at the hits, as the kernels find them.
    std::vector<Vec3f> normals(const std::vector<TracedRay>& rays, const std::vector<TracedHit>& hits);

    const Scene& scene() const { return scene_; }
    uint32_t events(EventKind kind) const { return harness_.events(EventSource::CameraTrace, kind); }

private:
    std::vector<TracedHit> trace(const std::vector<TracedRay>& rays, uint32_t variant);
    ProbeData leaveProbe(const std::vector<TracedRay>& rays, const std::vector<TracedHit>& hits,
                         const std::vector<Vec3f>& directions);
    uint32_t packedIndex(uint32_t primitive) const {
        return primitive == shared::NO_INDEX ? primitive : packedIndex_[primitive];
    }

    Scene scene_;
    PackedScene packed_;
    std::vector<uint32_t> packedIndex_;  ///< inverse of the BVH's order
    KernelHarness harness_;
};

}  // namespace antipode
