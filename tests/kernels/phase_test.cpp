// lib/phase.glsl: Henyey and Greenstein's phase function is drawn by the density that it has.
#include <cmath>

#include "support/hard_case.h"
#include "support/worst.h"
#include "tests/kernels/kernel_harness.h"

namespace antipode {
namespace {

class PhaseTest : public DeviceTest {
protected:
    static constexpr int kRows = 4096, kColumns = 16;

    /// Directions at the midpoints of a grid of random numbers, with their densities; z is the way that light travels.
    std::vector<Texel> sample(float g) {
        ProbeData inputs;
        for (int i = 0; i < kRows; ++i)
            for (int j = 0; j < kColumns; ++j) {
                inputs.a.push_back({0, 0, -1, g});
                inputs.b.push_back({(float(i) + 0.5f) / kRows, (float(j) + 0.5f) / kColumns, 0, 0});
            }
        return KernelHarness(*device).run(kernel_probes::phase_probe(), inputs).a;
    }
};

/// Not random: means over the grid are quadratures of ∫ cosⁿθ p dω by midpoints, whose error falls with the square of
/// the rows. The moments are g and (1 + 2g²)/3; and around the axis directions are spread evenly.
TEST_F(PhaseTest, MomentsAreThoseOfTheDensity) {
    Worst first, second, around;
    for (const float g : {-0.999f, -0.9f, -0.3f, -1e-4f, 0.0f, 1e-6f, 0.05f, 0.5f, 0.95f, 0.999f}) {
        double mean = 0, square = 0;
        Vec3d sum;
        for (const Texel& t : sample(g)) {
            mean += t.z, square += double(t.z) * t.z;
            sum += Vec3d(xyz(t));
        }
        const double count = kRows * kColumns;
        const std::string where = "g = " + std::to_string(g);
        first.add(std::abs(mean / count - double(g)), where);
        second.add(std::abs(square / count - (1 + 2 * double(g) * double(g)) / 3), where);
        around.add(std::hypot(sum.x, sum.y) / count, where);
    }
    const std::string difficulty = "phase functions of mean cosines from -0.999 to 0.999";
    SCOPED_TRACE(first.where + "; " + second.where + "; " + around.where);
    expectWithin({"Media", difficulty, "largest error of the mean cosine", 1e-4}, first.value, device->info().name);
    expectWithin({"Media", difficulty, "largest error of its square's mean", 2e-4}, second.value, device->info().name);
    expectWithin({"Media", difficulty, "largest mean across the axis", 1e-6}, around.value, device->info().name);
}

/// The density is that of the distribution which is drawn: between two neighbours of the grid lies 1/rows of it, so
/// that the densities' mean times 2πΔcosθ is 1/rows, to the second order of the step.
TEST_F(PhaseTest, DensityIsThatOfTheSamples) {
    Worst worst;
    for (const float g : {-0.95f, -0.3f, 0.0f, 0.5f, 0.9f}) {
        const std::vector<Texel> all = sample(g);
        for (int i = 1; i + 2 < kRows; ++i) {
            const Texel &a = all[size_t(i) * kColumns], &b = all[size_t(i + 1) * kColumns];
            const double step = std::abs(double(b.z) - double(a.z));
            if (step < 1e-3) continue;  // what float leaves of the difference of two cosines near ±1
            worst.add(std::abs(M_PI * (double(a.w) + double(b.w)) * step * kRows - 1),
                      "g = " + std::to_string(g) + ", row " + std::to_string(i));
        }
    }
    SCOPED_TRACE(worst.where);
    expectWithin({"Media", "densities of sampled directions in media", "largest relative error over a step", 2e-3},
                 worst.value, device->info().name);
}

}  // namespace
}  // namespace antipode
