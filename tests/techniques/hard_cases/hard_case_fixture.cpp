#include "tests/techniques/hard_cases/hard_case_fixture.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace antipode::test {
namespace {

/// The |z| of a standard normal that has this two-sided p-value: makes t-tests of different degrees comparable.
double sigmasOf(double p) {
    double low = 0, high = 40;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (normalTwoSidedP(middle) > p ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

bool merges(const std::string& technique) { return technique == "bpm" || technique == "ppm"; }

Moments shifted(const std::vector<Image>& images, const Block& block, double shift) {
    Moments moments;
    for (const Image& image : images) moments.add(meanOf(image, block, 1) + shift);
    return moments;
}

}  // namespace

RenderSettings smallImage(uint32_t size, double mergeRadius) {
    RenderSettings settings;
    settings.width = settings.height = size;
    settings.initialRadius = mergeRadius;
    settings.alpha = 1;
    return settings;
}

HardCaseTest::HardCaseTest() { setenv("LP_NUM_THREADS", "0", 0); }

/// The tests of one case: the worst of them is recorded.
class HardCaseTest::Family {
public:
    explicit Family(uint64_t tests) : tests_(tests) {}
    void add(const TestResult& result) { worst_ = std::max(worst_, sigmasOf(result.pValue)); }
    double worst() const { return worst_; }
    double bound() const { return sigmasOf(sidak(kAlpha, tests_)); }
    std::string quantity() const { return "largest of " + std::to_string(tests_) + " deviations, in standard errors"; }

private:
    uint64_t tests_;
    double worst_ = 0;
};

void HardCaseTest::compare(const MeanCase& c, const std::vector<double>* expected) {
    const std::vector<Block> blocks =
        c.blocks.empty() ? std::vector<Block>{{0, 0, c.settings.width, c.settings.height}} : c.blocks;
    Family family(blocks.size() * (c.techniques.size() - (expected ? 0 : 1)));
    std::vector<Moments> reference;
    for (size_t i = 0; i < c.techniques.size(); ++i) {
        RenderSettings settings = c.settings;
        settings.technique = c.techniques[i];
        settings.seed = 1 + i;
        SCOPED_TRACE(settings.technique);
        const std::vector<Image> images = samplesOf(c.scene, settings, c.iterations);
        for (size_t b = 0; b < blocks.size(); ++b) {
            const Moments moments = momentsOf(images, blocks[b], 1);
            const double error = std::sqrt(moments.meanVariance());
            if (!expected && i == 0) reference.push_back(moments);
            const double target = expected ? (*expected)[b] : reference[b].mean();
            EXPECT_LE(error, c.greatestError * target) << "block " << b << ", mean " << moments.mean();
            if (!expected && i == 0) continue;
            const double bias = (c.bias + (merges(settings.technique) ? c.mergeBias : 0)) * target;
            const double shift = std::clamp(target - moments.mean(), -bias, bias);
            const Moments nearest = shifted(images, blocks[b], shift);
            const TestResult result = expected ? tTest(nearest, target) : welchTest(nearest, reference[b]);
            if (result.pValue < sidak(kAlpha, 2 * blocks.size() * c.techniques.size()))
                ADD_FAILURE() << "block " << b << ": " << moments.mean() << " ± " << error << " instead of " << target
                              << ", ratio " << moments.mean() / target;
            family.add(result);
        }
    }
    expectMeasured({c.group, c.difficulty, family.quantity(), family.bound()}, family.worst(), c.settings.precision);
}

void HardCaseTest::expectMeans(const MeanCase& c, const std::vector<double>& expected) { compare(c, &expected); }
void HardCaseTest::expectAgreement(const MeanCase& c) { compare(c, nullptr); }

void HardCaseTest::expectMeasured(const HardCase& row, double measured, Precision precision) {
    expectWithin(row, measured, device_.empty() ? "host" : device_, precision);
}

std::vector<Image> HardCaseTest::samplesOf(const Scene& scene, const RenderSettings& settings, uint64_t count) {
    Engine engine(scene, settings);
    remember(engine);
    std::vector<Image> images;
    for (uint64_t i = 1; i <= count; ++i) {
        engine.reset();
        engine.render(i);
        expectHealthy(engine);
        images.push_back(engine.sums().image());
    }
    return images;
}

}  // namespace antipode::test
