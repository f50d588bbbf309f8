#include "proto/wire/loop_watch.h"

#include <cmath>

namespace antipode::wire {

LoopWatch LoopWatch::ofThisBuild([[maybe_unused]] const Tell& tell) {
#ifdef ANTIPODE_WATCHES_LOOPS
    return LoopWatch(tell);
#else
    return {};
#endif
}

void LoopWatch::say(const std::string& what, double seconds) const {
    tell_(what + " blocked the event loop for " + std::to_string(std::lround(1000 * seconds)) + " ms");
}

}  // namespace antipode::wire
