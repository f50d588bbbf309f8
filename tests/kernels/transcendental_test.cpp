// lib/transcendental.glsl in double against the host's long double: within 2 ulp, and exact where that matters.
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "kernels_double_probes.h"
#include "support/hard_case.h"
#include "support/random.h"
#include "tests/kernels/kernel_harness.h"

namespace antipode {
namespace {

struct Pair {
    double x, y;
};

struct Values {
    std::vector<Pair> sineCosine, expLog, arcTangent;
};

class TranscendentalTest : public DeviceTest {
protected:
    Values run(const std::vector<Pair>& at, uint32_t variant = 0) {
        ProbeData inputs;
        for (const Pair& p : at) inputs.a.push_back(std::bit_cast<Texel>(p));
        const ProbeData outputs = harness.run(double_probes::transcendental_probe(), inputs, variant);
        const auto pairs = [](const std::vector<Texel>& texels) {
            std::vector<Pair> result;
            for (const Texel& t : texels) result.push_back(std::bit_cast<Pair>(t));
            return result;
        };
        return {pairs(outputs.a), pairs(outputs.b), pairs(outputs.c)};
    }

    /// Error in units of the last place of the true value; those of zeros in units of the smallest normal number.
    static double ulps(double value, long double truth) {
        const double rounded = double(truth);
        if (std::isinf(rounded)) return value == rounded ? 0 : std::numeric_limits<double>::infinity();
        const double ulp = std::max(std::abs(std::nextafter(rounded, HUGE_VAL) - rounded), 0x1p-1074);
        return std::abs(double((static_cast<long double>(value) - truth) / static_cast<long double>(ulp)));
    }

    void expectAccurate(const char* function, double worst) {
        expectWithin(
            {"Precision", "GLSL has this function for floats alone", std::string(function) + ": largest error, ulp", 2},
            worst, device->info().name, Precision::Double);
    }

    KernelHarness harness{*device};
};

/// `count` numbers spread evenly over [least, greatest], then as many over its powers of two down to 2^-200.
std::vector<Pair> argumentsIn(double least, double greatest, size_t count) {
    Random random(1);
    std::vector<Pair> pairs;
    for (size_t i = 0; i < count; ++i) pairs.push_back({random.uniform(least, greatest), random.uniform(1e-9, 4)});
    for (size_t i = 0; i < count; ++i) {
        const double y = std::ldexp(random.uniform(1, 2), int(random.index(400)) - 200);
        pairs.push_back({std::ldexp(random.uniform(least, greatest), -int(random.index(200))), y});
    }
    return pairs;
}

TEST_F(TranscendentalTest, SineAndCosine) {
    std::vector<Pair> at = argumentsIn(-7, 7, 1 << 17);
    // The multiples of π/2, and their neighbours, where reduction cancels.
    for (int k = -4; k <= 4; ++k)
        for (double to : {-10.0, 0.0, 10.0}) {
            const double x = 0.5 * k * std::numbers::pi;
            at.push_back({to == 0 ? x : std::nextafter(x, to), 1});
        }
    const Values values = run(at);
    double sine = 0, cosine = 0;
    for (size_t i = 0; i < at.size(); ++i) {
        sine = std::max(sine, ulps(values.sineCosine[i].x, std::sin(static_cast<long double>(at[i].x))));
        cosine = std::max(cosine, ulps(values.sineCosine[i].y, std::cos(static_cast<long double>(at[i].x))));
    }
    expectAccurate("sin", sine);
    expectAccurate("cos", cosine);
}

TEST_F(TranscendentalTest, ExponentialAndLogarithm) {
    std::vector<Pair> at = argumentsIn(-700, 709, 1 << 17);
    for (double y :
         {1.0, std::nextafter(1.0, 0.0), std::nextafter(1.0, 2.0), 0.5, 2.0, std::numbers::sqrt2, 1e300, 1e-300})
        at.push_back({y == 1.0 ? 0.0 : 1.0, y});
    const Values values = run(at);
    double exponential = 0, logarithm = 0;
    for (size_t i = 0; i < at.size(); ++i) {
        exponential = std::max(exponential, ulps(values.expLog[i].x, std::exp(static_cast<long double>(at[i].x))));
        logarithm = std::max(logarithm, ulps(values.expLog[i].y, std::log(static_cast<long double>(at[i].y))));
    }
    expectAccurate("exp", exponential);
    expectAccurate("log", logarithm);
}

TEST_F(TranscendentalTest, EndsOfTheRangeAndNaN) {
    const double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Values values =
        run({{-infinity, 0.0}, {-1e4, 1}, {1e4, 1}, {infinity, 1}, {0.0, 1}, {nan, nan}, {1, -1}, {1, infinity}});
    EXPECT_EQ(values.expLog[0].x, 0.0);
    EXPECT_EQ(values.expLog[0].y, -infinity) << "a random number may be 0";
    EXPECT_EQ(values.expLog[1].x, 0.0);
    EXPECT_EQ(values.expLog[2].x, infinity);
    EXPECT_EQ(values.expLog[3].x, infinity);
    EXPECT_EQ(values.expLog[4].x, 1.0);
    EXPECT_EQ(values.expLog[4].y, 0.0);
    for (const double lost : {values.sineCosine[5].x, values.sineCosine[5].y, values.expLog[5].x, values.expLog[5].y,
                              values.arcTangent[5].x, values.arcTangent[5].y, values.expLog[6].y})
        EXPECT_TRUE(std::isnan(lost)) << "a NaN must not become a number";
    EXPECT_EQ(values.expLog[7].y, infinity);
}

TEST_F(TranscendentalTest, ArcTangentInAllQuadrants) {
    Random random(2);
    std::vector<Pair> at{{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {0, 0}, {1, 1}, {-1, -1}, {1e-300, 1}, {1, 1e-300}};
    for (int i = 0; i < 1 << 18; ++i) {
        const auto number = [&] { return std::ldexp(random.uniform(-1, 1), -int(random.index(i % 2 ? 3 : 60))); };
        at.push_back({number(), number()});
    }
    const Values values = run(at);
    double worst = 0;
    for (size_t i = 0; i < at.size(); ++i)
        worst = std::max(worst, ulps(values.arcTangent[i].x,
                                     std::atan2(static_cast<long double>(at[i].y), static_cast<long double>(at[i].x))));
    expectAccurate("atan", worst);
}

// What Phong's lobe stands on where its exponent is large.
TEST_F(TranscendentalTest, NearZero) {
    Random random(3);
    std::vector<Pair> at{{0, 1}, {0.25, 1}, {std::nextafter(0.25, 0.0), 1}, {0.7, 1}, {0.75, 1}};
    for (int i = 0; i < 1 << 17; ++i)
        at.push_back({std::ldexp(random.uniform(0.5, 1), -int(random.index(i % 2 ? 3 : 60))), 1});
    const Values logs = run(at, 0), exps = run(at, 1);
    double logarithm = 0, exponential = 0;
    for (size_t i = 0; i < at.size(); ++i) {
        const auto x = static_cast<long double>(at[i].x);
        logarithm = std::max(logarithm, ulps(logs.arcTangent[i].y, std::log1p(-x)));
        exponential = std::max(exponential, ulps(exps.arcTangent[i].y, -std::expm1(-x)));
    }
    expectAccurate("log(1-v)", logarithm);
    expectAccurate("1-exp(-x)", exponential);
}

}  // namespace
}  // namespace antipode
