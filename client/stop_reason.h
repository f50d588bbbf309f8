// Why a render ended.
#pragma once

namespace antipode {

enum class StopReason { Iterations, Time, TargetError, Signal, Page, NoServer, Failure };

/// What programs read: "iterations", "time", "target-error", "signal", "page", "no-server", "failure".
constexpr const char* key(StopReason reason) {
    constexpr const char* keys[] = {"iterations", "time", "target-error", "signal", "page", "no-server", "failure"};
    return keys[int(reason)];
}

/// Ends the sentence "stopped because …".
constexpr const char* clause(StopReason reason) {
    constexpr const char* clauses[] = {"all iterations that were asked for are rendered",
                                       "the time is over (--time)",
                                       "the error is what was asked for (--target-error)",
                                       "a signal came",
                                       "its page asked for it (--view)",
                                       "no server has been at work for too long (--wait)",
                                       "it could not go on"};
    return clauses[int(reason)];
}

}  // namespace antipode
