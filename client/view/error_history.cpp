#include "client/view/error_history.h"

namespace antipode::view {
namespace {

constexpr double growth = 1.05;

}  // namespace

void ErrorHistory::add(double seconds, const ErrorEstimate& estimate) {
    if (!(seconds > 0) || !(estimate.percent > 0)) return;
    const size_t count = points_.size();
    // The latest makes room where it is too near to the one before it.
    if (count >= 2 && points_[count - 1].seconds < growth * points_[count - 2].seconds) points_.pop_back();
    points_.push_back({seconds, estimate.iterations, estimate.percent, estimate.low, estimate.high});
}

}  // namespace antipode::view
