// What a BlockWorker called back, in order.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

#include "renderengine/block_worker.h"

namespace antipode::test {

struct BlockEvent {
    enum Kind { Ready, Finished, Failed } kind;
    std::string job;
    JobReady ready{};
    std::optional<BlockResult> result{};
    ErrorCode code{};         ///< of a failure
    std::string message{};    ///< of a failure
    uint64_t iterations = 0;  ///< that the block's progress had told when it ended
};

/// Thread-safe. Must outlive the worker.
class BlockLog {
public:
    std::function<void(const JobReady&)> ready(const std::string& job) {
        return [this, job](const JobReady& ready) { add({.kind = BlockEvent::Ready, .job = job, .ready = ready}); };
    }

    std::function<void(const Error&)> failed(const std::string& job) { return callbacks(job).failed; }

    BlockCallbacks callbacks(const std::string& job) {
        const auto iterations = std::make_shared<uint64_t>(0);
        return {.progress =
                    [iterations](uint64_t done) {
                        if (done != ++*iterations) throw std::logic_error("progress skips or repeats an iteration");
                    },
                .finished =
                    [this, job, iterations](std::optional<BlockResult> result) {
                        add({.kind = BlockEvent::Finished,
                             .job = job,
                             .result = std::move(result),
                             .iterations = *iterations});
                    },
                .failed =
                    [this, job, iterations](const Error& error) {
                        add({.kind = BlockEvent::Failed,
                             .job = job,
                             .code = error.code(),
                             .message = error.what(),
                             .iterations = *iterations});
                    }};
    }

    /// The oldest event that has not been taken. Throws where none comes within ten seconds.
    BlockEvent next() {
        std::unique_lock lock(mutex_);
        if (!added_.wait_for(lock, std::chrono::seconds(10), [this] { return !events_.empty(); }))
            throw std::runtime_error("the worker called nothing back");
        BlockEvent event = std::move(events_.front());
        events_.pop_front();
        return event;
    }

    bool empty() {
        const std::lock_guard lock(mutex_);
        return events_.empty();
    }

private:
    void add(BlockEvent event) {
        const std::lock_guard lock(mutex_);
        events_.push_back(std::move(event));
        added_.notify_one();
    }

    std::mutex mutex_;
    std::condition_variable added_;
    std::deque<BlockEvent> events_;
};

}  // namespace antipode::test
