// A session on a socket: frames in and out, a clock, and bounds on all of it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <asio/awaitable.hpp>

#include "proto/wire/loop_watch.h"
#include "proto/wire/session.h"
#include "proto/wire/stream.h"

namespace antipode::wire {

struct ConnectionLimits {
    size_t queuedBytes = 64 << 20;  ///< beyond it the connection ends: sessions stay far below
    double flushSeconds = 2;        ///< from close() to the end
    double stallSeconds = 30;       ///< that the network may take for 16 KiB of the queue
};

/// Runs a session on a stream until one of them ends it: a reader, a writer and a ticker, on the caller's strand.
class Connection final : public FramePort {
public:
    explicit Connection(Stream stream, const ConnectionLimits& limits = {}, LoopWatch watch = {});
    ~Connection() override;

    void send(Frame frame) override;
    size_t queuedBytes() const override;
    void close(const std::string& reason) override;

    /// Returns after session.disconnected(). The session must outlive it. Cancelling it ends the connection.
    asio::awaitable<void> run(Session& session);

    uint64_t bytesReceived() const;
    uint64_t bytesSent() const;
    std::string peer() const;
    bool rejected() const;  ///< see Stream

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace antipode::wire
