#include "server/log_throttle.h"

namespace antipode {

void LogThrottle::say(const std::string& line, double now) {
    tick(now);
    if (lines_ == 0) start_ = now;
    if (++lines_ <= most_) write_(line);
}

void LogThrottle::tick(double now) {
    if (lines_ == 0 || now - start_ < periodSeconds_) return;
    if (lines_ > most_) write_(std::to_string(lines_ - most_) + " more lines like that within the last minute");
    lines_ = 0;
}

}  // namespace antipode
