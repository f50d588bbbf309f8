// The lens of lib/camera.glsl. Null hypothesis: points are uniform on its disk (χ² on 16 × 16 cells of equal area);
// α = .01, seed 1.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/hard_case.h"
#include "support/statistics.h"
#include "tests/kernels/kernel_harness.h"

namespace antipode {
namespace {

class LensSamplingTest : public DeviceTest {};

TEST_F(LensSamplingTest, PointsAreUniformOnTheDisk) {
    constexpr double radius = 0.25;
    constexpr size_t draws = 200000, side = 16;
    PackedScene packed;
    packed.features = shared::FEATURE_LENS;
    shared::JobParameters<double> job;
    job.cameraPosition = {1, 2, 3, 100};
    job.cameraForward = {0, 1, 0, radius};
    job.cameraRight = {1, 0, 0, 4};
    job.cameraUp = {0, 0, 1, 1};
    Random random(1);
    ProbeData inputs;
    inputs.a = uniformTexels(draws, random);
    // The ends of the random numbers.
    for (const float x : {0.0f, 1 - 0x1p-24f})
        for (const float y : {0.0f, 1 - 0x1p-24f}) inputs.a.push_back({x, y, 0, 0});
    const ProbeData outputs = KernelHarness(*device, packed, job).run(kernel_probes::lens_probe(), inputs);
    std::vector<double> observed(side * side), expected(side * side, double(draws) / (side * side));
    for (size_t i = 0; i < outputs.a.size(); ++i) {
        const double x = double(outputs.a[i].x) / radius, y = double(outputs.a[i].y) / radius;
        EXPECT_LE(std::hypot(x, y), 1 + 1e-6);
        EXPECT_NEAR(outputs.a[i].z, 0, 1e-6) << "off the lens";
        if (i >= draws) continue;
        const auto cell = [](double v) { return size_t(std::clamp(int(v * side), 0, int(side) - 1)); };
        ++observed[cell(x * x + y * y) * side + cell(std::atan2(y, x) / (2 * std::numbers::pi) + 0.5)];
    }
    expectWithin({"Sampling", "points of a lens", "−log₁₀ p of a χ² test", 2},
                 -std::log10(chiSquareTest(observed, expected).pValue), device->info().name);
}

}  // namespace
}  // namespace antipode
