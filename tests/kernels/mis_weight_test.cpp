// The balance heuristic's weight of lib/mis.glsl from ratios of densities, to the ends of float.
#include <cmath>
#include <limits>

#include "support/hard_case.h"
#include "tests/kernels/kernel_harness.h"

namespace antipode {
namespace {

class MisWeightTest : public DeviceTest {
protected:
    std::vector<Texel> weights(const ProbeData& densities) {
        return KernelHarness(*device).run(kernel_probes::mis_probe(), densities).a;
    }
};

TEST_F(MisWeightTest, TwoTechniquesShareOne) {
    ProbeData densities;
    for (int a = -37; a <= 38; ++a)
        for (int b = -37; b <= 38; ++b)
            densities.a.push_back({float(std::pow(10.0, a)), float(std::pow(10.0, b)), 0, 0});
    double worst = 0;
    for (const Texel& w : weights(densities)) worst = std::max(worst, std::abs(double(w.x) + double(w.y) - 1));
    expectWithin({"MIS", "densities of two techniques from 10⁻³⁷ to 10³⁸", "largest |Σw − 1|", 1e-4}, worst,
                 device->info().name);
}

TEST_F(MisWeightTest, EndsOfFloatAreZeroAndOne) {
    constexpr float greatest = std::numeric_limits<float>::max();
    ProbeData densities;
    densities.a = {{greatest, 1, 0, 0}, {1, greatest, 0, 0}};
    const auto w = weights(densities);
    expectWithin({"MIS", "weights at the ends of float", "error of w(FLT_MAX, 1) = 1", 0}, std::abs(double(w[0].x) - 1),
                 device->info().name);
    // 1/FLT_MAX is no normal float: devices may give 0 or 2.9·10⁻³⁹.
    expectWithin({"MIS", "weights at the ends of float", "error of w(1, FLT_MAX) = 0", 3e-39}, double(w[1].x),
                 device->info().name);
    EXPECT_GE(w[1].x, 0);
}

}  // namespace
}  // namespace antipode
