// A connection between two simulated processes: a wire::Connection without sockets.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "proto/wire/session.h"
#include "tests/farm/simulation/event_loop.h"

namespace antipode::simulation {

constexpr double never = std::numeric_limits<double>::infinity();

/// What several links have in common: the line of an office, to which all of its servers are connected.
struct Line {
    double bytesPerSecond;                  ///< of all links together, each way
    std::array<double, 2> freeAt = {0, 0};  ///< when it has sent what was given to it, each way
};

struct LinkQuality {
    double latency = 0.01;           ///< seconds, one way
    double bytesPerSecond = 100e6;   ///< each way
    size_t windowBytes = 256 << 10;  ///< on the way or not read by the receiver, before the sender has to wait
    std::shared_ptr<Line> line{};    ///< that all bytes have to pass, too
};

class Link;

/// One side. Frames are encoded, travel in segments, are put together again and handed to the session as a Connection
/// does it.
class LinkEnd final : public wire::FramePort {
public:
    void send(wire::Frame frame) override;
    size_t queuedBytes() const override { return queued_; }
    void close(const std::string& reason) override;

    /// `ended` is called after session.disconnected() and may destroy the session.
    void attach(wire::Session& session, std::function<void()> ended);
    /// Called after each frame that the session has received.
    std::function<void()> afterReceive;

    // ---- Faults

    /// What this side sends from now on is held up until then.
    void hold(double until) { holdUntil_ = until; }
    /// One bit of the next bytes that this side sends is another.
    void corruptNext() { corruptNext_ = true; }
    /// Bytes that this side's session has not sent.
    void inject(std::string bytes);
    /// Its process is gone: nobody learns of what comes to this side.
    void abandon();
    /// This side's system notices that the connection is gone.
    void lose(double afterSeconds, const std::string& reason);

    bool open() const { return state_ == State::Open; }
    /// The last result that this side's session has offered.
    const std::string& lastOffer() const { return lastOffer_; }

private:
    friend class Link;
    enum class State { Open, Closing, Ended };

    void transmit();
    void transmitted(size_t bytes);
    /// When the next `bytes` have left, if nothing holds them up.
    double departure(size_t bytes);
    void arrive(const std::string& bytes);
    void finishClose();
    void end(const std::string& reason);
    void tickLater();
    void tick();
    /// Runs a call of the session; what it throws ends the connection.
    void guarded(const std::function<void()>& call);

    Link* link_ = nullptr;
    LinkEnd* peer_ = nullptr;
    Process* process_ = nullptr;
    wire::Session* session_ = nullptr;
    std::function<void()> ended_;
    State state_ = State::Open;
    wire::FrameReader reader_;
    std::deque<std::string> queue_;
    size_t frontSent_ = 0;  ///< of the first
    size_t queued_ = 0, unread_ = 0, largestQueue_ = 0;
    bool transmitting_ = false, corruptNext_ = false;
    double holdUntil_ = 0;
    std::string closeReason_, lastOffer_;
};

class Link {
public:
    Link(std::string name, LinkQuality quality, Process& client, Process& server);

    LinkEnd& client() { return ends_[0]; }
    LinkEnd& server() { return ends_[1]; }
    const std::string& name() const { return name_; }
    const LinkQuality& quality() const { return quality_; }
    /// The network between the two is gone; each side notices after so many seconds, or never.
    void cut(double clientNotices, double serverNotices);
    size_t largestClientQueue() const { return ends_[0].largestQueue_; }
    size_t largestServerQueue() const { return ends_[1].largestQueue_; }
    /// Bytes were corrupted or injected: errors of the protocol are to be expected.
    bool tainted = false;
    /// Called with what a session threw.
    std::function<void(const std::string&)> onError;

private:
    friend class LinkEnd;
    const std::string name_;
    const LinkQuality quality_;
    EventLoop& loop_;
    std::array<LinkEnd, 2> ends_;
};

}  // namespace antipode::simulation
