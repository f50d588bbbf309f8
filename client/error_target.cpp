#include "client/error_target.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace antipode {
namespace {

constexpr uint64_t firstCheck = 8;
constexpr double tolerance = 1.2;

}  // namespace

ErrorTarget::ErrorTarget(double percent, uint64_t rendered)
    : percent_(percent), check_(std::max(firstCheck, rendered)) {}

bool ErrorTarget::reached(const std::optional<ErrorEstimate>& estimate) {
    if (estimate && estimate->percent <= percent_ && estimate->high <= tolerance * percent_) {
        if (!estimate->doubtful() || (confirmation_ && check_ >= *confirmation_)) return true;
        confirmation_ = check_ = 2 * check_;
        return false;
    }
    confirmation_.reset();
    const double missing =
        estimate ? std::max(estimate->percent / percent_, estimate->high / (tolerance * percent_)) : 2;
    const uint64_t step = std::max<uint64_t>(check_ / 8, 1);
    const double wanted = std::min(double(check_) * missing * missing, 2.0 * double(check_));
    // In whole sixteenths of an octave, so that blocks up to the check are not all small.
    const uint64_t grain = std::max<uint64_t>(std::bit_floor(check_) / 16, 1);
    check_ = (std::max(uint64_t(std::ceil(wanted)), check_ + step) + grain - 1) / grain * grain;
    return false;
}

}  // namespace antipode
