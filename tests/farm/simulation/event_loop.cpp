#include "tests/farm/simulation/event_loop.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <utility>

namespace antipode::simulation {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

double cpuSeconds() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

}  // namespace

void EventLoop::watch(wire::LoopWatch::Tell tell) {
    if (!sanitized) watch_ = wire::LoopWatch(std::move(tell), [this] { return cpuSeconds() - elsewhere_; });
}

void EventLoop::elsewhere(const std::function<void()>& work) {
    const double start = cpuSeconds();
    work();
    elsewhere_ += cpuSeconds() - start;
}

void EventLoop::at(double time, std::function<void()> action) {
    events_.push({std::max(time, now_), order_++, std::move(action)});
}

void EventLoop::run(double end, const std::function<bool()>& done) {
    while (!events_.empty() && events_.top().time <= end && !done()) {
        // top() is const because changing an event's time would break the order; moving the action does not.
        Event event = std::move(const_cast<Event&>(events_.top()));
        events_.pop();
        now_ = event.time;
        event.action();
    }
    if (!done()) now_ = std::max(now_, end);
}

void EventLoop::log(const std::string& line) {
    if (!logging_) return;
    std::printf("%9.3f  %s\n", now_ - 1000, line.c_str());
    std::fflush(stdout);
}

void Process::after(double seconds, std::function<void()> action) {
    loop_.after(seconds, [this, life = life_, action = std::move(action)]() mutable {
        if (life != life_) return;
        if (paused_)
            delayed_.push_back(std::move(action));
        else
            action();
    });
}

void Process::every(double seconds, const std::function<void()>& action) {
    after(seconds, [this, seconds, action, life = life_] {
        action();
        if (life == life_) every(seconds, action);
    });
}

void Process::resume() {
    paused_ = false;
    for (auto& action : std::exchange(delayed_, {})) after(0, std::move(action));
}

void Process::kill() {
    ++life_;
    paused_ = false;
    delayed_.clear();
}

}  // namespace antipode::simulation
