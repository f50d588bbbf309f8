// When a render ends by its error, and what it says of the time until then.
#include "client/error_target.h"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "client/error_forecast.h"
#include "client/error_report.h"
#include "client/progress.h"

using namespace antipode;

namespace {

ErrorEstimate estimateOf(uint64_t iterations, double percent, double relativeWidth = 0.05) {
    return {iterations, percent, percent * (1 - relativeWidth), percent * (1 + relativeWidth), 0.1};
}

/// The iterations at which it looked, the last of which it ends with, where the error is `atOne`·n^−`exponent`.
std::vector<uint64_t> checksOf(double target, double atOne, double exponent, double relativeWidth = 0.05) {
    ErrorTarget search(target, 0);
    std::vector<uint64_t> checks;
    do {
        checks.push_back(search.check());
    } while (
        !search.reached(estimateOf(checks.back(), atOne * std::pow(double(checks.back()), -exponent), relativeWidth)));
    return checks;
}

}  // namespace

TEST(ErrorTarget, EndsSoonAfterTheErrorIsThere) {
    for (const double exponent : {0.5, 1.0 / 3})
        for (const double atOne : {8.0, 30.0, 97.0}) {
            const std::vector<uint64_t> checks = checksOf(2, atOne, exponent);
            const double needed = std::pow(atOne / 2, 1 / exponent);
            EXPECT_GE(double(checks.back()), needed);
            EXPECT_LE(double(checks.back()), std::max(8.0, 1.25 * needed)) << atOne << " " << exponent;
            EXPECT_LE(checks.size(), 8 + std::log2(needed));
        }
}

TEST(ErrorTarget, WaitsForACertainEstimate) {
    // Half as much again is possible: the error has to be 1.2·2/1.5 = 1.6 before that may be at most 2.4.
    EXPECT_GE(double(checksOf(2, 32, 0.5, 0.5).back()), 400);
    ErrorTarget search(2, 0);
    EXPECT_FALSE(search.reached(std::nullopt)) << "nothing is known";
    EXPECT_EQ(search.check(), 16u);
}

TEST(ErrorTarget, LooksFirstAtWhatACheckpointHas) { EXPECT_EQ(ErrorTarget(2, 100).check(), 100u); }

TEST(ErrorForecast, FitsTheExponent) {
    ErrorForecast forecast;
    for (uint64_t n = 1; n <= 200; ++n) {
        forecast.add(estimateOf(n, 60 * std::pow(double(n), -1.0 / 3)));
        EXPECT_EQ(forecast.exponent().has_value(), n >= 24) << n;
    }
    EXPECT_NEAR(*forecast.exponent(), 1.0 / 3, 1e-9);
    const auto to5 = forecast.iterationsTo(5);
    ASSERT_TRUE(to5);
    EXPECT_NEAR(to5->expected, 12 * 12 * 12, 1e-6);
    EXPECT_GT(to5->spread, 0.1 * to5->expected) << "an interval of 5 % of the error is 15 % of the time";
    EXPECT_LT(to5->spread, 0.2 * to5->expected);
    EXPECT_FALSE(forecast.iterationsTo(50)) << "it is there already";
}

TEST(ErrorForecast, SaysNothingWhereTheErrorDoesNotFall) {
    ErrorForecast forecast;
    for (uint64_t n = 8; n <= 512; n *= 2) forecast.add(estimateOf(n, n % 3 == 1 ? 4 : 5));
    EXPECT_FALSE(forecast.iterationsTo(1));
}

TEST(ErrorTarget, DoubtsAreConfirmedByTwiceTheIterations) {
    const auto doubtful = [](uint64_t n, double percent) {
        ErrorEstimate estimate = estimateOf(n, percent);
        estimate.tailIndex = 2;
        return estimate;
    };
    ErrorTarget target(2, 0);
    EXPECT_EQ(target.check(), 8u);
    EXPECT_FALSE(target.reached(doubtful(8, 1.5)));
    EXPECT_EQ(target.check(), 16u);
    EXPECT_FALSE(target.reached(doubtful(16, 4))) << "a firefly came";
    EXPECT_EQ(target.check(), 32u);
    EXPECT_FALSE(target.reached(doubtful(32, 1.9)));
    EXPECT_EQ(target.check(), 64u);
    EXPECT_TRUE(target.reached(doubtful(64, 1.4)));
}

TEST(ErrorForecast, NamesRoundNumbers) {
    EXPECT_DOUBLE_EQ(nextMark(70), 50);
    EXPECT_DOUBLE_EQ(nextMark(50), 20);
    EXPECT_DOUBLE_EQ(nextMark(13.3), 10);
    EXPECT_DOUBLE_EQ(nextMark(1.8), 1);
    EXPECT_DOUBLE_EQ(nextMark(0.3), 0.2);
}

TEST(ErrorReport, HasTwoDigits) {
    EXPECT_EQ(errorText({1, 1.84, 1.72, 1.96, 0}), "1.8 % error (1.7 to 2)");
    EXPECT_EQ(errorText({1, 44000.5, 134.2, 100000, 0}), "44000 % error (134 to 100000)");
    EXPECT_EQ(errorText({1, 0.0123, 0.0119, 0.0131, 0}), "0.012 % error (0.012 to 0.013)");
}

TEST(ErrorReport, DoubtsWhatRareBrightSamplesMake) {
    ErrorEstimate error{64, 1.84, 1.72, 1.96, 0.83, 0.2, 1.19};
    EXPECT_EQ(errorDoubt(error), "");
    EXPECT_FALSE(errorJson(error).contains("doubt"));
    EXPECT_EQ(errorJson(error)["limited_by"], "noise");
    error.tailIndex = 1.2;
    EXPECT_EQ(errorDoubt(error),
              "the error may be larger than told: rare bright samples make it, 83 % of it in 1 % of the pixels, and "
              "brighter ones may still come");
    EXPECT_EQ(errorJson(error)["doubt"], errorDoubt(error));
    error.worstShare = 0.996;
    EXPECT_NE(errorDoubt(error).find("99.6 % of it"), std::string::npos) << errorDoubt(error);
    error.tailIndex = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(errorJson(error)["tail_index"].is_null());
    EXPECT_NE(errorDoubt(error), "");
    error.halfShare = 0.001;
    EXPECT_EQ(errorJson(error)["limited_by"], "few-pixels");
}

TEST(Progress, TellsTheErrorAndWhenItWillBeSmaller) {
    ProgressState state;
    state.iterations = 12;
    state.elapsedSeconds = 3;
    state.error = estimateOf(12, 1.8);
    EXPECT_EQ(progressText(state), "12 iterations, 4 it/s, 3.0 s; 1.8 % error (1.7 to 1.9); limited by noise");
    state.forecast = {1, 250, 20};
    state.error->halfShare = 0.0031;
    EXPECT_EQ(progressText(state),
              "12 iterations, 4 it/s, 3.0 s; 1.8 % error (1.7 to 1.9), 1 % in 4:10 ± 20.0 s; 0.31 % of the pixels hold "
              "half of the error");
    EXPECT_EQ(progressJson(state).find('\n'), std::string::npos);
    state.error->halfPixels = 57;
    EXPECT_NE(progressText(state).find("± 20.0 s; 57 pixels hold half of the error"), std::string::npos);
    state.error->halfPixels = 1;
    EXPECT_NE(progressText(state).find("one pixel holds half of the error"), std::string::npos);
    ProgressState wild = state;
    wild.forecast->spread = 251;
    EXPECT_EQ(progressText(wild).find("1 % in"), std::string::npos) << "a time that is off by more than itself is none";
    EXPECT_NE(progressJson(state).find(R"("forecast":{"percent":1.0,"seconds":250.0,"spread":20.0})"),
              std::string::npos)
        << progressJson(state);
}

TEST(Progress, TimeRunsDownWithinAnIteration) {
    ProgressState state;
    state.iterations = 10, state.iterationLimit = 20;
    state.elapsedSeconds = state.iterationSeconds = 100;
    EXPECT_TRUE(progressText(state).ends_with("1:40 left")) << progressText(state);
    state.elapsedSeconds = 105;
    EXPECT_TRUE(progressText(state).ends_with("1:35 left")) << progressText(state);
}
