// A side of the protocol without sockets and clocks, so that simulations can run it like a connection does.
#pragma once

#include <cstddef>
#include <string>

#include "proto/wire/frame.h"

namespace antipode::wire {

/// How a session reaches its peer. A Connection, or a simulated link.
class FramePort {
public:
    virtual ~FramePort() = default;
    /// Queues a frame. Sessions bound what they queue by the protocol's credits, needs and lease depths.
    virtual void send(Frame frame) = 0;
    /// Bytes queued and not yet handed to the network; a session with bulk to send waits until they are few.
    virtual size_t queuedBytes() const = 0;
    /// Ends the connection once what is queued has been sent, or after two seconds. `reason` is for the log. Nothing is
    /// received any more.
    virtual void close(const std::string& reason) = 0;
};

/// The protocol of one side, without sockets and clocks: all that it knows comes through these calls, on one thread.
class Session {
public:
    virtual ~Session() = default;
    /// Bytes came, though perhaps no whole frame: the peer is there. Called before what they complete is received.
    virtual void heard(double now) = 0;
    /// A frame came. Throws ProtocolError where it must not have come; the connection then ends with a
    /// Refusal(PROTOCOL) that carries the sentence.
    virtual void receive(const Frame& frame, double now) = 0;
    /// Called a few times a second, and whenever the queue has drained below a chunk. `now`: monotonic seconds.
    virtual void tick(double now) = 0;
    /// The connection is gone; `reason` says how. The last call.
    virtual void disconnected(const std::string& reason, double now) = 0;
};

/// Monotonic seconds, from an arbitrary origin.
double monotonicSeconds();

/// Of both sides: silence after which a peer is given up, and the pause after which a heartbeat is sent. A byte of a
/// frame is no silence, however long the rest takes.
struct Liveness {
    double silenceSeconds = 10, heartbeatSeconds = 2;
    /// From accept to the end of authentication and Hello, which takes one way and back: of three seconds each, or
    /// more.
    double helloSeconds = 10;
};

/// Bytes that a session with bulk to send lets wait in its port's queue: half a minute of a line of 64 kbit/s, so that
/// what it says next does not come too late, and enough for the fastest one, because a port asks for more in time.
constexpr size_t shortQueueBytes = 256 << 10;

}  // namespace antipode::wire
