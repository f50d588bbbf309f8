// How fast the error falls: the slope of log RMSE over log iterations.
#include <cmath>

#include "proto/scene_loader.h"
#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/row_names.h"

namespace antipode::test {
namespace {

constexpr uint64_t referenceIterations = 1 << 14;
constexpr int firstPower = 4, lastPower = 12;

/// A reference with the variance that its own noise adds to every mean squared error against it.
struct Reference {
    std::vector<Vec3d> mean;
    double meanSquaredError = 0;
};

class ConvergenceRate : public EngineTest {
protected:
    ConvergenceRate() : scene(loadScene(ANTIPODE_SOURCE_DIR "/scenes/cornell/area.textproto")) {
        settings.width = settings.height = 16;
        settings.maxPathLength = 4;
        settings.sampler = Sampler::Independent;
    }

    /// From the means of `batches` groups of iterations, whose spread tells the error of their mean.
    Reference renderReference() {
        constexpr uint64_t batches = 16;
        RenderSettings bidirectional = settings;
        bidirectional.technique = "bpt";
        bidirectional.seed = 99;
        Engine engine(scene, bidirectional);
        Reference reference;
        std::vector<Image> means;
        for (uint64_t b = 0; b < batches; ++b) {
            engine.reset();
            for (uint64_t i = 0; i < referenceIterations / batches; ++i)
                engine.render(b * (referenceIterations / batches) + i + 1);
            means.push_back(engine.sums().image());
        }
        expectHealthy(engine);
        for (size_t p = 0; p < means.front().pixels.size(); ++p) {
            Vec3d mean{};
            for (int channel = 0; channel < 3; ++channel) {
                Moments moments;
                for (const Image& image : means) moments.add(image.pixels[p][channel]);
                mean[channel] = moments.mean();
                reference.meanSquaredError += moments.meanVariance();
            }
            reference.mean.push_back(mean);
        }
        reference.meanSquaredError /= 3.0 * double(reference.mean.size());
        return reference;
    }

    /// The least-squares slope of log2 RMSE over log2 iterations.
    double slopeOf(const std::string& technique, const Reference& reference, uint64_t seed = 1) {
        RenderSettings own = settings;
        own.technique = technique;
        own.seed = seed;
        Engine engine(scene, own);
        std::vector<double> logErrors;
        uint64_t done = 0;
        for (int power = firstPower; power <= lastPower; ++power) {
            while (done < uint64_t(1) << power) engine.render(++done);
            const Image image = engine.sums().image();
            double error = 0;
            for (size_t p = 0; p < image.pixels.size(); ++p) {
                const Vec3d difference = Vec3d(image.pixels[p]) - reference.mean[p];
                error += dot(difference, difference);
            }
            error = error / (3.0 * double(image.pixels.size())) - reference.meanSquaredError;
            logErrors.push_back(0.5 * std::log2(error));
        }
        expectHealthy(engine);
        const double count = double(logErrors.size()), middle = (count - 1) / 2;
        double covariance = 0, variance = 0;
        for (size_t i = 0; i < logErrors.size(); ++i) {
            covariance += (double(i) - middle) * logErrors[i];
            variance += (double(i) - middle) * (double(i) - middle);
        }
        return covariance / variance;
    }

    const Scene scene;
    RenderSettings settings;
};

}  // namespace

// Of independent numbers, which theory speaks of: sampler_test.cpp tells how Sobol' numbers do.
// Unbiased techniques fall with the root of the iterations; merging alone with α = 2/3 by Knaus and Zwicker's −1/3; all
// techniques in one sum no worse than that. One seed where the bounds leave room for what a fit over nine points that
// share their samples does. Merging alone has rare, bright samples, which bend a single fit by .08: null hypothesis,
// the mean of eight seeds' slopes is −1/3; Student's t, α = .01, and a standard error of at most .05.
TEST_F(ConvergenceRate, FollowsTheory) {
    const Reference reference = renderReference();
    const auto record = [](const std::string& difficulty, const std::string& quantity, double bound, double measured) {
        expectWithin({"Convergence rates", difficulty, quantity, bound}, measured, deviceName());
    };
    const std::string unbiased = "without bias the error falls with the root of the iterations",
                      biased = "a bias that vanishes with the merge radius", together = "all techniques in one sum";
    record(unbiased, "|slope + ½| of pt", 0.05, std::abs(slopeOf("pt", reference) + 0.5));
    record(unbiased, "|slope + ½| of bpt", 0.05, std::abs(slopeOf("bpt", reference) + 0.5));
    Moments slopes;
    for (uint64_t seed = 1; seed <= 8; ++seed) slopes.add(slopeOf("ppm", reference, seed));
    const double merging = slopes.mean();
    SCOPED_TRACE(testing::Message() << "ppm " << merging << " ± " << std::sqrt(slopes.meanVariance()));
    record(biased, "standard error of ppm's slope over 8 seeds", 0.05, std::sqrt(slopes.meanVariance()));
    record(biased, "−log₁₀ p of ppm's slope against −⅓", 2, -std::log10(tTest(slopes, -1.0 / 3.0).pValue));
    record(together, "slope of bpm, less that of ppm", 0, slopeOf("bpm", reference) - merging);
    record(together, "slope of vcm, less that of ppm", 0, slopeOf("vcm", reference) - merging);
}

}  // namespace antipode::test
