// Who keeps an event loop from everything else.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "proto/wire/session.h"

namespace antipode::wire {

/// Times what an event loop runs and tells of what took longer than 50 ms: for so long nobody's heartbeat goes out and
/// nobody's lease is granted. Only for builds that are not optimised for users, and for simulations.
class LoopWatch {
public:
    static constexpr double mostSeconds = 0.05;
    using Tell = std::function<void(const std::string& sentence)>;

    /// Watches nothing.
    LoopWatch() = default;
    explicit LoopWatch(Tell tell, std::function<double()> clock = monotonicSeconds)
        : tell_(std::move(tell)), clock_(std::move(clock)) {}
    /// Watches in builds of the types Debug and RelWithDebInfo, and nothing in others.
    static LoopWatch ofThisBuild(const Tell& tell);

    /// Runs the call, whatever it throws. `what()` says what it is, for the sentence "… blocked the event loop for N
    /// ms".
    template <class What, class Call>
    void run(const What& what, const Call& call) const {
        if (!tell_) return call();
        struct Turn {
            ~Turn() { watch.ended(start, what); }
            const LoopWatch& watch;
            const What& what;
            const double start = watch.clock_();
        };
        const Turn turn{*this, what};
        call();
    }

private:
    template <class What>
    void ended(double start, const What& what) const {
        const double seconds = clock_() - start;
        if (seconds > mostSeconds) say(what(), seconds);
    }
    void say(const std::string& what, double seconds) const;

    Tell tell_;
    std::function<double()> clock_;
};

}  // namespace antipode::wire
