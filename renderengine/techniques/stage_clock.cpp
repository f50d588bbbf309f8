#include "techniques/stage_clock.h"

#include <algorithm>

namespace antipode {

void StageClock::add(const std::vector<Timestamp>& timestamps) {
    for (size_t i = 1; i < timestamps.size(); ++i) {
        const std::string& stage = timestamps[i].label;
        auto found = std::find_if(times_.begin(), times_.end(), [&](const StageTime& t) { return t.stage == stage; });
        if (found == times_.end()) found = times_.insert(times_.end(), StageTime{stage, 0, 0});
        found->seconds += timestamps[i].seconds - timestamps[i - 1].seconds;
    }
}

void StageClock::addRays(const std::string& stage, uint64_t rays) {
    for (StageTime& t : times_)
        if (t.stage == stage) t.rays += rays;
}

}  // namespace antipode
