#include "tests/calibration/calibration.h"

#include <algorithm>
#include <cmath>

#include "client/error_forecast.h"
#include "client/error_target.h"
#include "tests/support/statistics.h"

namespace antipode::test {

double binomialBelow(const Count& count, double p) {
    if (count.hits >= count.tries) return 1;
    return regularisedBeta(double(count.tries - count.hits), double(count.hits + 1), 1 - p);
}

std::pair<double, double> binomialInterval(const Count& count) {
    // The p at which P(X ≤ hits) is `tail`, which falls with p.
    const auto solve = [](const Count& c, double tail) {
        double low = 0, high = 1;
        for (int i = 0; i < 60; ++i) {
            const double middle = (low + high) / 2;
            (binomialBelow(c, middle) > tail ? low : high) = middle;
        }
        return low;
    };
    const double low = count.hits == 0 ? 0 : solve({count.hits - 1, count.tries}, 0.975);
    return {low, count.hits == count.tries ? 1 : solve(count, 0.025)};
}

double quantile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    const double at = share * double(values.size() - 1);
    const size_t below = size_t(at);
    if (below + 1 == values.size()) return values[below];
    return values[below] + (at - double(below)) * (values[below + 1] - values[below]);
}

Calibration::Calibration(std::vector<Followed> runs) : runs_(std::move(runs)) {
    const double S = double(runs_.size());
    const size_t values = runs_[0].images.back().size();
    means_.assign(runs_[0].images.size(), std::vector<double>(values));
    noise_.assign(runs_.size(), std::vector<double>(means_.size()));
    for (size_t n = means_.size() - 1; n > 0; --n) {
        for (const Followed& run : runs_)
            for (size_t v = 0; v < values; ++v) means_[n][v] += run.images[n][v] / S;
        for (size_t s = 0; s < runs_.size(); ++s) {
            double sum = 0;
            for (size_t v = 0; v < values; ++v) {
                const double fromOthers = (runs_[s].images[n][v] - means_[n][v]) * S / (S - 1);
                sum += fromOthers * fromOthers / (means_.back()[v] * means_.back()[v] + relativeErrorEpsilon);
            }
            noise_[s][n] = 100 * std::sqrt(sum / double(values) * (S - 1) / S);
        }
    }
}

double Calibration::noise(uint64_t n) const {
    double squares = 0;
    for (const auto& run : noise_) squares += run[n] * run[n];
    return std::sqrt(squares / double(runs()));
}

double Calibration::exponent() const {
    const uint64_t last = iterations();
    return std::log(noise(last / 2) / noise(last)) / std::log(double(last) / double(last / 2));
}

Count Calibration::held(uint64_t n, const Counts& counts) const {
    Count count;
    for (size_t s = 0; s < runs(); ++s) {
        const auto& told = runs_[s].told[n];
        if (!told || !counts(*told)) continue;
        ++count.tries;
        count.hits += told->low <= noise(s, n) && noise(s, n) <= told->high;
    }
    return count;
}

Count Calibration::toldTooHigh(uint64_t n) const {
    Count count;
    for (size_t s = 0; s < runs(); ++s) {
        if (!runs_[s].told[n]) continue;
        ++count.tries;
        count.hits += runs_[s].told[n]->low > noise(s, n);
    }
    return count;
}

std::vector<double> Calibration::ratios(uint64_t n) const {
    std::vector<double> ratios;
    for (size_t s = 0; s < runs(); ++s)
        if (runs_[s].told[n]) ratios.push_back(runs_[s].told[n]->percent / noise(s, n));
    return ratios;
}

double Calibration::iterationsTo(size_t s, double percent) const {
    for (uint64_t n = 1; n <= iterations(); ++n) {
        if (noise(s, n) > percent) continue;
        if (n == 1 || noise(s, n - 1) <= noise(s, n)) return double(n);
        const double part = std::log(noise(s, n - 1) / percent) / std::log(noise(s, n - 1) / noise(s, n));
        return double(n - 1) * std::pow(double(n) / double(n - 1), part);
    }
    return double(iterations()) * std::pow(noise(s, iterations()) / percent, 1 / exponent());
}

double Calibration::meanNoise(uint64_t n) const { return noise(n) / std::sqrt(double(runs())); }

Bias biasOf(const Calibration& a, uint64_t n, const Calibration& b) {
    const uint64_t last = b.iterations();
    const std::vector<double>&x = a.mean(n), &reference = b.mean(last);
    double square = 0;
    for (size_t v = 0; v < x.size(); ++v) {
        const double difference = x[v] - reference[v];
        square += difference * difference / (reference[v] * reference[v] + relativeErrorEpsilon);
    }
    const double noise = a.meanNoise(n) * a.meanNoise(n) + b.meanNoise(last) * b.meanNoise(last);
    return {std::sqrt(std::max(10000 * square / double(x.size()) - noise, 0.0)), std::sqrt(noise)};
}

std::vector<ForecastMiss> forecastMisses(const Calibration& calibration, uint64_t n, double factor) {
    std::vector<ForecastMiss> misses;
    for (size_t s = 0; s < calibration.runs(); ++s) {
        const Followed& run = calibration.run(s);
        ErrorForecast forecast;
        for (uint64_t i = 1; i <= n; ++i)
            if (run.told[i]) forecast.add(*run.told[i]);
        if (!run.told[n]) continue;
        const double target = factor * run.told[n]->percent;
        const auto predicted = forecast.iterationsTo(target);
        if (!predicted || predicted->spread >= predicted->expected - double(n)) continue;  // which the client hides
        const double truth = calibration.iterationsTo(s, target), miss = std::abs(predicted->expected - truth);
        const double seconds = run.cpuSeconds[n] / double(n) * predicted->expected;
        const uint64_t last = calibration.iterations();
        const double rendered = truth < double(last) ? run.cpuSeconds[size_t(std::ceil(truth))]
                                                     : run.cpuSeconds[last] / double(last) * truth;
        misses.push_back({miss / truth, miss / std::max(truth - double(n), 1.0),
                          std::abs(seconds - rendered) / rendered, miss <= predicted->spread});
    }
    return misses;
}

std::vector<TargetEnd> targetEnds(const Calibration& calibration, double percent) {
    std::vector<TargetEnd> ends;
    for (size_t s = 0; s < calibration.runs(); ++s) {
        ErrorTarget target(percent, 0);
        for (uint64_t n = target.check(); n <= calibration.iterations(); n = target.check())
            if (target.reached(calibration.run(s).told[n])) {
                ends.push_back({n, calibration.noise(s, n)});
                break;
            }
    }
    return ends;
}

}  // namespace antipode::test
