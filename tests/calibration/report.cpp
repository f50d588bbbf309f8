#include "tests/calibration/report.h"

#include <cmath>
#include <cstdio>
#include <numeric>

namespace antipode::test {
namespace {

constexpr const char* techniques[] = {"pt", "bpt", "vcm"};
constexpr uint64_t forecastAt = 24;      // before, there is none
constexpr uint64_t lastFittedSeed = 50;  // see the constants of film/relative_weights.cpp
constexpr double knownPercent = 10;      // noise of the mean of all renders, at most
constexpr double forecastFactor = 0.7;   // of the error told there: twice the iterations, where noise is all

std::string number(const char* format, double value) {
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}
std::string digits(double value) { return number(value < 99.5 ? "%.2g" : "%.0f", value); }
std::string percent(double share) { return number("%.0f", 100 * share); }
std::string percent(const Count& count) { return count.tries ? number("%.1f", 100 * count.share()) : "–"; }

std::string interval(const Count& count) {
    const auto [low, high] = binomialInterval(count);
    return percent(count) + " (" + number("%.1f", 100 * low) + " to " + number("%.1f", 100 * high) + ")";
}

/// Two digits.
double rounded(double value) {
    const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
    return std::round(value / unit) * unit;
}

}  // namespace

std::vector<uint64_t> CalibrationReport::looks() const {
    std::vector<uint64_t> looks;
    for (uint64_t n = 4; n <= options_.iterations; n *= 2) looks.push_back(n);
    return looks;
}

void CalibrationReport::add(const CalibrationScene& from, const std::string& keep) {
    const Scene scene = load(from);
    std::optional<Calibration> bpt;
    for (const char* technique : techniques) {
        RenderSettings settings;
        settings.width = settings.height = options_.side;
        settings.technique = technique;
        std::vector<Followed> runs;
        for (uint64_t s = 0; s < options_.seeds; ++s) {
            settings.seed = options_.firstSeed + s;
            runs.push_back(follow(renderRun(scene, from.name, settings, options_.iterations, keep), settings.width,
                                  settings.height));
        }
        Calibration calibration(std::move(runs));
        const bool known = calibration.meanNoise(options_.iterations) <= knownPercent;
        for (const uint64_t n : looks()) {
            const std::vector<double> ratios = calibration.ratios(n);
            Row row{from.name,
                    technique,
                    n,
                    calibration.noise(n),
                    calibration.meanNoise(n),
                    known,
                    calibration.held(n),
                    calibration.toldTooHigh(n),
                    calibration.held(n, [](const ErrorEstimate& told) { return !told.doubtful(); })};
            row.ratio = quantile(ratios, 0.5);
            row.ratioLow = quantile(ratios, 0.05);
            row.ratioHigh = quantile(ratios, 0.95);
            if (bpt && row.technique == "vcm") row.bias = biasOf(calibration, n, *bpt);
            rows_.push_back(row);
        }
        if (!known) continue;
        Forecasts& forecasts = forecasts_[technique];
        forecasts.asked += calibration.runs();
        const std::vector<ForecastMiss> misses = forecastMisses(calibration, forecastAt, forecastFactor);
        forecasts.misses.insert(forecasts.misses.end(), misses.begin(), misses.end());
        const double target = rounded(calibration.noise(options_.iterations * 5 / 8));
        targets_.push_back({from.name, technique, target, calibration.runs(), targetEnds(calibration, target)});
        if (std::string(technique) == "bpt" && from.complete) bpt = std::move(calibration);
    }
}

std::string CalibrationReport::csv() const {
    std::ostringstream text;
    text << "scene,technique,iterations,known,noise_percent,noise_of_mean_percent,renders,held,told_too_high,undoubted,"
            "undoubted_held,ratio_median,ratio_5,ratio_95,bias_percent,bias_noise_percent\n";
    for (const Row& row : rows_) {
        text << row.scene << ',' << row.technique << ',' << row.iterations << ',' << row.known << ',' << row.noise
             << ',' << row.meanNoise << ',' << row.held.tries << ',' << row.held.hits << ',' << row.tooHigh.hits << ','
             << row.heldUndoubted.tries << ',' << row.heldUndoubted.hits << ',' << row.ratio << ',' << row.ratioLow
             << ',' << row.ratioHigh << ',';
        if (row.bias)
            text << row.bias->percent << ',' << row.bias->doubt;
        else
            text << ',';
        text << '\n';
    }
    return text.str();
}

std::string CalibrationReport::page() const {
    std::ostringstream text;
    text << "# Is the error that a render tells true?\n\nThis page is written by\n\n```sh\n"
            "cmake --preset ci && cmake --build --preset ci --target antipode_calibration\n"
            "build/ci/tests/calibration/antipode_calibration --first-seed "
         << options_.firstSeed << " --out docs/accuracy\n```\n\n"
         << "Scenes are rendered at " << options_.side << "×" << options_.side << " with " << options_.seeds
         << " seeds each, and after every iteration the client's own code tells error, time and whether it would end.\n"
            "*True noise* is the distance of a render from the mean of the other seeds' after as many iterations (less "
            "what that mean is off by), as √relMSE;\nso bias and light that no seed has met are not in it. Where the "
            "mean of all is itself off by more than "
         << digits(knownPercent)
         << " % (†) no truth is known: such rows are\nshown and counted nowhere else. Numbers for programs: "
            "[calibration.csv](calibration.csv).\n"
         << (options_.firstSeed <= lastFittedSeed
                 ? "With these scenes and seeds the constants of the estimate were found.\n"
                 : "")
         << "\n## How often the stated 95 % interval held the true noise\n\n"
            "In brackets the 95 % interval of that share itself (binomial); *undoubted*: renders that did not say that "
            "rare bright samples may come.\n\n";
    text << "| iterations |";
    for (const char* technique : techniques) text << " `" << technique << "`: held, % | undoubted, % |";
    text << "\n| --- |"
         << " --- | --- | --- | --- | --- | --- |\n";
    for (const uint64_t n : looks()) {
        text << "| " << n << " |";
        for (const char* technique : techniques) {
            Count held, undoubted;
            for (const Row& row : rows_)
                if (row.known && row.technique == technique && row.iterations == n)
                    held += row.held, undoubted += row.heldUndoubted;
            text << " " << interval(held) << " | " << percent(undoubted) << " of " << undoubted.tries << " |";
        }
        text << "\n";
    }
    text << "\n## Scene by scene\n\n*Too high*: renders whose interval lay above the truth. *Bias*: how far the mean "
            "of `vcm` lies from that of `bpt`, where that finds all light,\nless the noise of both; < where it is "
            "within that noise. These films have no blur layer to tell it.\n";
    text
        << "\n| scene | technique | iterations | true noise, % | told / true: median (5 % to 95 %) | held | too high | "
           "doubted | bias, % |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for (const Row& row : rows_) {
        text << "| " << row.scene << (row.known ? "" : " †") << " | `" << row.technique << "` | " << row.iterations
             << " | " << digits(row.noise) << " | " << number("%.2f", row.ratio) << " (" << number("%.2f", row.ratioLow)
             << " to " << number("%.2f", row.ratioHigh) << ") | " << row.held.hits << " of " << row.held.tries << " | "
             << row.tooHigh.hits << " | " << row.held.tries - row.heldUndoubted.tries << " | ";
        if (!row.bias)
            text << "–";
        else if (row.bias->percent < row.bias->doubt)
            text << "< " << digits(row.bias->doubt);
        else
            text << digits(row.bias->percent);
        text << " |\n";
    }
    text
        << "\n## When a smaller error is there\n\nAfter " << forecastAt
        << " iterations each render is asked when its error will be " << digits(forecastFactor)
        << " of what it tells then, about twice as many for noise alone.\nMisses are shares of the true number of "
           "iterations (or CPU seconds), or of what of it was still to come. Beyond iteration "
        << options_.iterations
        << " the truth\nfollows the slope of the mean. Renders without a fit, or with a spread beyond the time itself, "
           "tell none.\n\n| technique | told a time | median miss, % | 90th percentile | of what remained: median | "
           "90th | in CPU "
           "seconds: median | 90th | spread held, % |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for (const char* technique : techniques) {
        const auto found = forecasts_.find(technique);
        if (found == forecasts_.end() || found->second.misses.empty()) continue;
        const std::vector<ForecastMiss>& misses = found->second.misses;
        const auto part = [&](double ForecastMiss::*of, double share) {
            std::vector<double> values;
            for (const ForecastMiss& miss : misses) values.push_back(miss.*of);
            return percent(quantile(values, share));
        };
        Count held;
        for (const ForecastMiss& miss : misses) held += {miss.held, 1};
        text << "| `" << technique << "` | " << misses.size() << " of " << found->second.asked << " | "
             << part(&ForecastMiss::ofTotal, 0.5) << " | " << part(&ForecastMiss::ofTotal, 0.9) << " | "
             << part(&ForecastMiss::ofRemaining, 0.5) << " | " << part(&ForecastMiss::ofRemaining, 0.9) << " | "
             << part(&ForecastMiss::ofSeconds, 0.5) << " | " << part(&ForecastMiss::ofSeconds, 0.9) << " | "
             << percent(held) << " |\n";
    }
    text << "\n## What `--target-error` ends with\n\nThe target is the mean noise after " << options_.iterations * 5 / 8
         << " iterations; renders that would go on beyond " << options_.iterations
         << " have not ended.\n\n| scene | technique | target, % | ended | true noise, % of the target: median (5 % to "
            "95 %) | 80 to 120 % "
            "|\n| --- | --- | --- | --- | --- | --- |\n";
    for (const Target& target : targets_) {
        text << "| " << target.scene << " | `" << target.technique << "` | " << digits(target.percent) << " | "
             << target.ends.size() << " of " << target.asked << " | ";
        if (target.ends.empty()) {
            text << "– | – |\n";
            continue;
        }
        std::vector<double> ends;
        Count within;
        for (const TargetEnd& end : target.ends) {
            ends.push_back(end.noise / target.percent);
            within += {ends.back() >= 0.8 && ends.back() <= 1.2, 1};
        }
        text << percent(quantile(ends, 0.5)) << " (" << percent(quantile(ends, 0.05)) << " to "
             << percent(quantile(ends, 0.95)) << ") | " << within.hits << " |\n";
    }
    return text.str();
}

}  // namespace antipode::test
