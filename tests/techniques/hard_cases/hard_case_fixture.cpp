#include "tests/techniques/hard_cases/hard_case_fixture.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "support/worst.h"
#include "tests/techniques/row_names.h"

namespace antipode::test {
namespace {

constexpr uint64_t kTests = 400;

bool merges(const std::string& technique) { return technique == "vcm" || technique == "bpm" || technique == "ppm"; }

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

void HardCaseTest::compare(const MeanCase& c, const std::vector<double>* expected) {
    const std::vector<Block> blocks =
        c.blocks.empty() ? std::vector<Block>{{0, 0, c.settings.width, c.settings.height}} : c.blocks;
    Worst surprise;
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
            std::ostringstream said;
            said << settings.technique << ", block " << b << ": " << moments.mean() << " ± " << error << " instead of "
                 << target << " (bias up to " << bias << "), ratio " << moments.mean() / target;
            surprise.add(-std::log10(result.pValue), said.str());
        }
    }
    SCOPED_TRACE(surprise.where);
    const std::string quantity = expected ? "largest −log₁₀ p of t-tests over blocks and techniques"
                                          : "largest −log₁₀ p of Welch tests of techniques against " + c.techniques[0];
    expectMeasured({c.group, c.difficulty, quantity, -std::log10(sidak(kAlpha, kTests))}, surprise.value,
                   c.settings.precision);
}

void HardCaseTest::expectMeans(const MeanCase& c, const std::vector<double>& expected) { compare(c, &expected); }
void HardCaseTest::expectAgreement(const MeanCase& c) { compare(c, nullptr); }

void HardCaseTest::expectMeasured(const HardCase& row, double measured, Precision precision) {
    expectWithin(row, measured, deviceName(), precision);
}

}  // namespace antipode::test
