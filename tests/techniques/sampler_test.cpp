// Sobol' numbers in whole renders: the same expectation as independent ones, an estimate of error that stays honest,
// and errors that fall faster where light is smooth.
//
// Residue classes are independent images of one expectation, whatever the numbers within a class share: they are the
// samples here. Significance .01 over all tests of a case (Šidák); seeds 1, 2, ….
#include <cmath>

#include "proto/scene_loader.h"
#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/row_names.h"

namespace antipode::test {
namespace {

constexpr uint32_t side = 24, classes = SettingsLimits::residueClasses;

class SamplerTest : public EngineTest {
protected:
    SamplerTest() {
        settings.width = settings.height = side;
        settings.maxPathLength = 6;
        settings.residueClasses = classes;
    }

    /// The classes' images, each of `iterations` iterations; class after class, seed after seed.
    std::vector<Image> renderClasses(const std::string& technique, Sampler sampler, uint64_t seeds, uint64_t iterations,
                                     uint64_t firstSeed = 1) {
        std::vector<Image> images;
        for (uint64_t seed = firstSeed; seed < firstSeed + seeds; ++seed) {
            RenderSettings own = settings;
            own.technique = technique;
            own.sampler = sampler;
            own.seed = seed;
            Engine engine(scene, own);
            for (uint64_t i = 1; i <= classes * iterations; ++i) engine.render(i);
            expectHealthy(engine);
            const FilmSums sums = engine.sums();
            for (uint32_t k = 0; k < classes; ++k) {
                FilmSums alone{sums.layout, iterations, {}, {}};
                alone.layout.layers.resize(1);
                const auto layer = sums.layer(k);
                alone.values.assign(layer.begin(), layer.end());
                images.push_back(alone.image());
            }
        }
        return images;
    }

    const Scene scene = loadScene(ANTIPODE_SOURCE_DIR "/scenes/cornell/area.textproto");
    RenderSettings settings;
};

/// Mean over pixels and channels of the squared difference.
double meanSquare(const Image& a, const Image& b) {
    double sum = 0;
    for (size_t p = 0; p < a.pixels.size(); ++p) {
        const Vec3d d = Vec3d(a.pixels[p]) - Vec3d(b.pixels[p]);
        sum += dot(d, d);
    }
    return sum / (3.0 * double(a.pixels.size()));
}

Image meanOfAll(const std::vector<Image>& images) {
    Image mean = images.front();
    for (size_t p = 0; p < mean.pixels.size(); ++p) {
        Vec3d sum{};
        for (const Image& image : images) sum = sum + Vec3d(image.pixels[p]);
        mean.pixels[p] = Vec3f(sum * (1.0 / double(images.size())));
    }
    return mean;
}

}  // namespace

// Null hypothesis: both samplers have one expectation in the whole image and in each of 3 × 3 blocks. Welch's t-test,
// 4 seeds × 8 classes of 16 iterations as samples. vcm merges within radii that depend on the iteration alone, so that
// its bias is the same.
TEST_F(SamplerTest, BothHaveTheSameExpectation) {
    constexpr std::array techniques{"pt", "lt", "bpt", "vcm"};
    const std::vector<Block> blocks = blocksOf(side, side, 3, 3);
    const double significance = sidak(kAlpha, techniques.size() * blocks.size() * 3);
    for (const char* technique : techniques) {
        const std::vector<Image> sobol = renderClasses(technique, Sampler::Sobol, 4, 16),
                                 independent = renderClasses(technique, Sampler::Independent, 4, 16);
        for (const Block& block : blocks)
            for (int channel = 0; channel < 3; ++channel) {
                SCOPED_TRACE(testing::Message() << technique << ", block at " << block.left << "," << block.top);
                expectWithin(
                    {"Sampling", "Sobol' numbers beside independent ones, Cornell area",
                     "largest −log₁₀ p of Welch tests over techniques and blocks", -std::log10(significance)},
                    -std::log10(
                        welchTest(momentsOf(sobol, block, channel), momentsOf(independent, block, channel)).pValue),
                    deviceName());
            }
    }
}

// What the error is estimated from: the spread of the classes against the true error of their mean. Null hypothesis:
// both have one expectation; t-test of their differences, one for each of 16 seeds, against 0. The truth is the squared
// distance to the mean of the other seeds' images, whose own variance is taken off by the factor 15/16.
TEST_F(SamplerTest, ClassesTellTheErrorOfTheirMean) {
    constexpr uint64_t seeds = 16;
    constexpr std::array techniques{"pt", "vcm"};
    for (const char* technique : techniques) {
        const std::vector<Image> images = renderClasses(technique, Sampler::Sobol, seeds, 16);
        std::vector<Image> means;
        std::vector<double> told;
        for (uint64_t s = 0; s < seeds; ++s) {
            const std::vector<Image> own(images.begin() + long(s * classes), images.begin() + long((s + 1) * classes));
            means.push_back(meanOfAll(own));
            double spread = 0;
            for (const Image& image : own) spread += meanSquare(image, means.back());
            told.push_back(spread / (classes * (classes - 1)));
        }
        Moments differences, ratio;
        for (uint64_t s = 0; s < seeds; ++s) {
            std::vector<Image> others = means;
            others.erase(others.begin() + long(s));
            const double trueError = meanSquare(means[s], meanOfAll(others)) * (seeds - 1) / seeds;
            differences.add(told[s] - trueError);
            ratio.add(told[s] / trueError);
        }
        SCOPED_TRACE(testing::Message() << technique << ": told over true " << ratio.mean() << " ± "
                                        << std::sqrt(ratio.meanVariance()));
        RecordProperty(std::string("told_over_true_") + technique, std::to_string(ratio.mean()));
        expectWithin({"Sampling", "the error that classes of Sobol' numbers tell, against the true one",
                      "largest −log₁₀ p of t-tests over techniques", -std::log10(sidak(kAlpha, techniques.size()))},
                     -std::log10(tTest(differences, 0).pValue), deviceName());
    }
}

// Direct light of a quad: two dimensions for the pixel and two for the lamp. Null hypothesis: with independent numbers
// the slope of log error over log iterations is −½; t-test over 8 classes. With Sobol' numbers it is below −.6 by the
// same test, one-sided.
TEST_F(SamplerTest, ErrorsFallFasterWhereLightIsSmooth) {
    settings.maxPathLength = 2;
    const Image reference = meanOfAll(renderClasses("pt", Sampler::Sobol, 2, 256, 2));
    const auto slopes = [&](Sampler sampler) {
        std::vector<double> iterations;
        std::vector<std::vector<double>> errors(classes);
        for (uint64_t n = 4; n <= 64; n *= 2) {
            iterations.push_back(double(n));
            const std::vector<Image> images = renderClasses("pt", sampler, 1, n);
            for (uint32_t k = 0; k < classes; ++k) errors[k].push_back(std::sqrt(meanSquare(images[k], reference)));
        }
        Moments moments;
        for (const auto& own : errors) moments.add(fitLogLog(iterations, own).slope);
        return moments;
    };
    const Moments independent = slopes(Sampler::Independent), sobol = slopes(Sampler::Sobol);
    SCOPED_TRACE(testing::Message() << "slopes " << independent.mean() << " and " << sobol.mean());
    RecordProperty("slope_independent", std::to_string(independent.mean()));
    RecordProperty("slope_sobol", std::to_string(sobol.mean()));
    const std::string difficulty = "direct light of a quad, with independent and with Sobol' numbers";
    expectWithin({"Convergence rates", difficulty, "−log₁₀ p of the slope against −½, independent", 2},
                 -std::log10(tTest(independent, -0.5).pValue), deviceName());
    EXPECT_LT(sobol.mean(), -0.6);
    EXPECT_LT(tTest(sobol, -0.6).pValue, kAlpha);
}

}  // namespace antipode::test
