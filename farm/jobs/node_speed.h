// How fast a node is, from what it has just done.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace antipode {

/// Iterations over seconds, both forgotten exponentially: coalesced or delayed reports do not bias the ratio.
class NodeSpeed {
public:
    /// What is older than a few times `memorySeconds` no longer counts.
    explicit NodeSpeed(double memorySeconds) : memory_(memorySeconds) {}

    void observe(uint64_t iterations, double seconds) {
        // A clock that stands still between two reports must not make a node infinitely fast.
        seconds = std::max(seconds, 1e-6 * double(iterations));
        const double kept = std::exp(-seconds / memory_);
        iterations_ = iterations_ * kept + double(iterations);
        seconds_ = seconds_ * kept + seconds;
    }
    bool known() const { return iterations_ > 0; }
    /// Iterations per second; 0 where unknown.
    double rate() const { return known() ? iterations_ / seconds_ : 0; }
    double secondsPerIteration() const { return known() ? seconds_ / iterations_ : 0; }

private:
    double memory_;
    double iterations_ = 0, seconds_ = 0;
};

}  // namespace antipode
