// A scene with lights, and lib/light.glsl drawing from them.
#pragma once

#include "renderengine/scene.h"
#include "support/random.h"
#include "techniques/job.h"
#include "tests/kernels/kernel_harness.h"

namespace antipode {

struct DrawnEmission {
    Vec3d origin, direction, throughput;
    double dVCM, dVC;
    bool valid, infinite;
};

struct DrawnDirect {
    Vec3d direction, value, target;
    double pdf, emitRatio;
    bool valid, delta;
};

struct DrawnEnvironment {
    Vec3d direction, radiance;
    double pdf;
};

class LightBench {
public:
    LightBench(Device& device, const Scene& scene);

    std::vector<DrawnEmission> emission(size_t count, Random& random);
    std::vector<DrawnDirect> direct(const Vec3f& position, size_t count, Random& random);
    /// Index and probability of each pick.
    std::vector<std::pair<uint32_t, double>> picks(size_t count, Random& random);
    std::vector<DrawnEnvironment> environment(size_t count, Random& random);
    std::vector<DrawnEnvironment> evalEnvironment(const std::vector<Vec3d>& directions);

    const PackedScene& packed() const { return packed_; }
    Vec3d sceneCenter() const { return Vec3d(packed_.bounds.center()); }
    double sceneRadius() const { return double(packed_.bounds.radius()); }

private:
    std::vector<DrawnEnvironment> environmentOf(const ProbeData& inputs, uint32_t variant);

    PackedScene packed_;
    KernelHarness harness_;
};

/// A scene of one black triangle, to add lights to.
Scene darkScene();

}  // namespace antipode
