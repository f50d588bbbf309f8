#include "farm/jobs/coordinator_options.h"

#include "renderengine/film_layout.h"

namespace antipode {
namespace {

/// Film sums, measured: 243 to 400 MB a CPU second.
constexpr double mergeBytesPerSecond = 2e8;

}  // namespace

double mergeableResults(const RenderSettings& settings) {
    return mergeBytesPerSecond / (8.0 * double(filmLayout(settings).values()));
}

}  // namespace antipode
