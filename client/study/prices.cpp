#include "client/study/prices.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace antipode::study {
namespace {

const VariantResult* find(const SceneResult& scene, const std::string& name) {
    for (const VariantResult& result : scene.variants)
        if (result.variant.name == name) return &result;
    return nullptr;
}

/// "1.93 × WHAT (1.90 to 1.96)".
std::string times(const Interval& ratio, const std::string& what) {
    if (!std::isfinite(ratio.low) || !std::isfinite(ratio.high)) return "an unknown share of " + what;
    char text[32], range[64];
    std::snprintf(text, sizeof text, "%.3g × ", ratio.value);
    std::snprintf(range, sizeof range, " (%.3g to %.3g)", ratio.low, ratio.high);
    return text + what + range;
}

bool holdsOne(const Interval& ratio) { return ratio.low <= 1 && ratio.high >= 1; }

}  // namespace

bool limitedByReference(const Snapshot& snapshot, const std::optional<Interval>& own) {
    const double takenOff = snapshot.errors.referenceRelMse, estimated = own ? own->value * own->value * 1e-4 : 0;
    return std::max(takenOff, estimated) > 0.25 * (snapshot.errors.total() + takenOff);
}

std::vector<Point> pointsOf(const VariantResult& result, const std::optional<Interval>& own, double Snapshot::*clock) {
    std::vector<Point> points;
    for (const Snapshot& snapshot : result.snapshots)
        if (!limitedByReference(snapshot, own)) points.push_back({snapshot.*clock, percentOf(snapshot.errors).value});
    return points;
}

std::vector<Price> prices(const SceneResult& scene) {
    std::vector<Price> list;
    for (const VariantResult& result : scene.variants) {
        const VariantResult* base = find(scene, result.variant.against);
        if (!base) continue;
        // The longest renders that both have.
        const Snapshot *own = nullptr, *other = nullptr;
        for (const Snapshot& s : result.snapshots)
            for (const Snapshot& b : base->snapshots)
                if (s.iterations == b.iterations) own = &s, other = &b;
        if (!own) continue;
        Price price{result.variant.name, result.variant.label, base->variant.name, own->iterations, {}, {}, {}};
        price.time = durationRatio(result.spent.iterationCpu, base->spent.iterationCpu);
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        const bool limited =
            limitedByReference(*own, scene.referencePercent) || limitedByReference(*other, scene.referencePercent);
        price.error = limited ? Interval{nan, nan, nan} : errorRatio(own->errors, other->errors);
        const double logTime = std::log(price.time.high / price.time.value),
                     logError = 2 * std::log(price.error.high / price.error.value);
        const double half = std::exp(std::hypot(logTime, logError));
        const double value = price.time.value * price.error.value * price.error.value;
        price.sameError = {value, value / half, value * half};
        list.push_back(price);
    }
    return list;
}

std::string sentence(const Price& price) {
    std::string text = price.label + ": " + times(price.time, "the time of " + price.against) + " and " +
                       times(price.error, "its error") + " after " + std::to_string(price.iterations) +
                       (price.iterations == 1 ? " iteration" : " iterations");
    if (!std::isfinite(price.sameError.value)) return text + ".";
    char more[128];
    const double value = price.sameError.value;
    if (holdsOne(price.sameError))
        std::snprintf(more, sizeof more, "; no difference at equal error that this study can tell.");
    else if (value > 1)
        std::snprintf(more, sizeof more, "; the same error costs %.3g times as long.", value);
    else
        std::snprintf(more, sizeof more, "; the same error comes %.3g times sooner.", 1 / value);
    return text + more;
}

}  // namespace antipode::study
