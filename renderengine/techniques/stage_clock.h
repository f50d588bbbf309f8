// Sums of device time per stage, from the timestamps of command lists.
#pragma once

#include <string>
#include <vector>

#include "renderengine/engine.h"
#include "vulkan/commands.h"

namespace antipode {

class StageClock {
public:
    /// Adds the time between consecutive timestamps to the stage that the later one names.
    void add(const std::vector<Timestamp>& timestamps);
    /// Rays that a timed stage traced; none is added to a stage that never ran.
    void addRays(const std::string& stage, uint64_t rays);
    const std::vector<StageTime>& times() const { return times_; }
    void reset() { times_.clear(); }

private:
    std::vector<StageTime> times_;
};

}  // namespace antipode
