// The page of a calibration.
#pragma once

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/calibration/calibration.h"
#include "tests/calibration/scenes.h"

namespace antipode::test {

struct CalibrationOptions {
    uint64_t seeds = 50;
    uint64_t firstSeed = 101;
    uint32_t side = 32;
    uint64_t iterations = 64;  ///< 48 at least
};

class CalibrationReport {
public:
    explicit CalibrationReport(const CalibrationOptions& options) : options_(options) {}

    /// Renders the scene with each technique, or takes what lies in `keep`, and adds it.
    void add(const CalibrationScene& scene, const std::string& keep);
    std::string page() const;
    /// A row for each scene, technique and number of iterations.
    std::string csv() const;

private:
    struct Row {
        std::string scene, technique;
        uint64_t iterations = 0;
        double noise = 0, meanNoise = 0;
        bool known = false;  ///< whether the mean of all renders is truth enough
        Count held, tooHigh, heldUndoubted;
        double ratio = 0, ratioLow = 0, ratioHigh = 0;
        std::optional<Bias> bias = {};
    };
    struct Forecasts {
        std::vector<ForecastMiss> misses;
        uint64_t asked = 0;
    };
    struct Target {
        std::string scene, technique;
        double percent = 0;
        uint64_t asked = 0;
        std::vector<TargetEnd> ends;
    };

    std::vector<uint64_t> looks() const;

    CalibrationOptions options_;
    std::vector<Row> rows_;
    std::map<std::string, Forecasts> forecasts_;
    std::vector<Target> targets_;
};

}  // namespace antipode::test
