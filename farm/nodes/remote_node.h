// A server of the farm as the client keeps it: connected, or trying to.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <asio/io_context.hpp>

#include "farm/nodes/remote_session.h"
#include "proto/wire/stream.h"

namespace antipode {

struct RemoteStatus {
    std::string name;
    std::string state;   ///< one or two words: "connecting", "uploading 40 %", "ready", "lost", "refused"
    std::string detail;  ///< why it is lost or refused
    std::string device;  ///< "" before the first Welcome
    uint64_t bytesReceived = 0, bytesSent = 0;  ///< over all connections
    uint32_t connections = 0;                   ///< made so far
    bool refusedForGood = false;  ///< waiting will not help: incompatible, or the job is none that it takes, or its
                                  ///< secret or certificate has not fitted three times in a row and never before, or
                                  ///< its device has failed three times
    bool atWork = false;          ///< it has the job, or is getting it
};

/// Connects, runs sessions, and connects again with growing, jittered pauses (0.5 … 30 s) until stopped. All calls on
/// the io_context's thread, whose coroutines must be destroyed before the node.
class RemoteNode {
public:
    /// The coroutines keep `context` and `security`.
    RemoteNode(asio::io_context& io, wire::Endpoint endpoint, std::shared_ptr<const wire::Security> security,
               std::shared_ptr<RemoteContext> context);
    ~RemoteNode();
    RemoteNode(const RemoteNode&) = delete;
    RemoteNode& operator=(const RemoteNode&) = delete;

    void start();
    /// Says goodbye, and connects no more.
    void stop();
    /// No connection is open or being made after stop().
    bool stopped() const;
    RemoteStatus status() const;

private:
    struct Impl;
    std::shared_ptr<Impl> impl_;
};

}  // namespace antipode
