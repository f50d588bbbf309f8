// Virtual time: what happens when, on one thread, the same way each time.
#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <string>
#include <vector>

#include "proto/wire/loop_watch.h"

namespace antipode::simulation {

/// Actions of equal time run in the order in which they were scheduled.
class EventLoop {
public:
    double now() const { return now_; }
    void at(double time, std::function<void()> action);
    void after(double seconds, std::function<void()> action) { at(now_ + seconds, std::move(action)); }
    /// Runs actions until `done` or until virtual time `end`.
    void run(double end, const std::function<bool()>& done);

    /// Tells who blocks a process's event loop: by this thread's CPU time, less what another thread would have done.
    /// Not with sanitizers, which slow down everything.
    void watch(wire::LoopWatch::Tell tell);
    const wire::LoopWatch& watched() const { return watch_; }
    /// Runs what another thread of a process would do.
    void elsewhere(const std::function<void()>& work);

    /// Keeps the lines that log() is given.
    void keepLog() { logging_ = true; }
    void log(const std::string& line);
    bool logging() const { return logging_; }

private:
    struct Event {
        double time;
        uint64_t order;
        std::function<void()> action;
        bool operator<(const Event& other) const {
            return time != other.time ? time > other.time : order > other.order;
        }
    };
    std::priority_queue<Event> events_;
    double now_ = 1000;
    uint64_t order_ = 0;
    wire::LoopWatch watch_;
    double elsewhere_ = 0;  ///< CPU seconds
    bool logging_ = false;
};

/// What an operating system can do to a process. Lives as long as the loop; killed and started again it is another life
/// of the same process.
class Process {
public:
    explicit Process(EventLoop& loop) : loop_(loop) {}

    EventLoop& loop() { return loop_; }
    double now() const { return loop_.now(); }
    /// Runs the action in this process, unless it is killed before; later, if it is paused then.
    void after(double seconds, std::function<void()> action);
    /// The same, again and again from now on.
    void every(double seconds, const std::function<void()>& action);

    void pause() { paused_ = true; }
    void resume();
    /// Nothing that was to happen in this process will.
    void kill();
    bool paused() const { return paused_; }
    uint64_t life() const { return life_; }

private:
    EventLoop& loop_;
    uint64_t life_ = 0;
    bool paused_ = false;
    std::vector<std::function<void()>> delayed_;
};

}  // namespace antipode::simulation
