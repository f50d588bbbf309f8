// The results of one connection on their way to the client: offered, then sent in chunks as credits allow.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>

#include "proto/wire/session.h"
#include "renderengine/block_worker.h"

namespace antipode {

/// Chunks are encoded as they are sent, and only while the port's queue is short. Leases that are not in it are
/// ignored: messages about them were on their way when they were settled.
class ResultOutbox {
public:
    /// `send` queues frames on `port`.
    ResultOutbox(const wire::FramePort& port, std::function<void(wire::Frame)> send);

    /// Offers a result. It is kept until it is settled.
    void offer(uint64_t lease, std::shared_ptr<const BlockResult> result);
    /// So many more chunks may be sent.
    void credit(uint64_t lease, uint32_t chunks);
    void settle(uint64_t lease);
    /// Sends what may be sent now, the oldest lease first.
    void pump();

private:
    struct Item {
        std::shared_ptr<const BlockResult> result;
        uint32_t chunks = 0, sent = 0, credits = 0;  // credits: including those that are used up; ≤ chunks
    };

    const wire::FramePort& port_;
    std::function<void(wire::Frame)> send_;
    std::map<uint64_t, Item> items_;
};

}  // namespace antipode
