// What the tests of this folder share: means of small images, technique by technique, against a closed form or against
// the first technique, and their rows in the table of hard cases.
//
// Statistics. One iteration's mean over a block is one sample. Null hypothesis: its expectation is the closed form's or
// the first technique's, apart from a bias that the case states. Student's or Welch's t over the iterations, α = .01
// over kTests tests (Šidák), which is no fewer than all MeanCases of this folder make together; the first technique has
// seed 1, every one after it the next. A standard error above the case's `greatestError` fails: a test that says
// nothing is none.
#pragma once

#include "support/hard_case.h"
#include "tests/techniques/engine_fixture.h"

namespace antipode::test {

struct MeanCase {
    std::string group, difficulty;
    Scene scene{};
    RenderSettings settings{};
    std::vector<std::string> techniques{"pt", "lt", "bpt", "vcm"};
    uint64_t iterations = 24;
    std::vector<Block> blocks{};  ///< the whole image where empty
    double greatestError = 0.03;  ///< relative standard error of every mean
    double bias = 0;              ///< relative, that every technique may have against the closed form or the first one
    double mergeBias = 0;         ///< the same of techniques that merge, besides
};

/// Square images of so many pixels, seed 1, a merge radius that does not shrink.
RenderSettings smallImage(uint32_t size, double mergeRadius);

class HardCaseTest : public EngineTest {
protected:
    /// Keeps lavapipe from starting threads, which cost dispatches as small as these more than they bring.
    HardCaseTest();

    /// In the green channel, every technique against `expected`, one value for each block.
    void expectMeans(const MeanCase& c, const std::vector<double>& expected);
    /// The same for the whole image.
    void expectMean(const MeanCase& c, double expected) { expectMeans(c, {expected}); }
    /// Every technique but the first, which is the reference, against it.
    void expectAgreement(const MeanCase& c);

    /// Records a measured value with the device that engines run on.
    void expectMeasured(const HardCase& row, double measured, Precision precision = Precision::Float);

    /// renderEach from the first iteration on.
    std::vector<Image> samplesOf(const Scene& scene, const RenderSettings& settings, uint64_t count) {
        return renderEach(scene, settings, count);
    }

private:
    void compare(const MeanCase& c, const std::vector<double>* expected);
};

}  // namespace antipode::test
