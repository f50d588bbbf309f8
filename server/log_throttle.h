// Keeps strangers from filling a log.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

namespace antipode {

/// Writes so many lines in each period, and at its end how many more there were.
class LogThrottle {
public:
    using Write = std::function<void(const std::string& line)>;
    explicit LogThrottle(Write write, uint32_t most = 20, double periodSeconds = 60)
        : write_(std::move(write)), most_(most), periodSeconds_(periodSeconds) {}

    /// `now`: monotonic seconds.
    void say(const std::string& line, double now);
    /// Ends a period that is over, which is to be looked at now and then.
    void tick(double now);

private:
    const Write write_;
    const uint32_t most_;
    const double periodSeconds_;
    double start_ = 0;
    uint64_t lines_ = 0;  ///< of this period, written or not
};

}  // namespace antipode
