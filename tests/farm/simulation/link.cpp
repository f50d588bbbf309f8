#include "tests/farm/simulation/link.h"

#include <algorithm>
#include <utility>

#include "proto/farm.pb.h"

namespace antipode::simulation {
namespace {

constexpr double flushSeconds = 2, tickSeconds = 0.25;
/// A packet of the internet, or what goes out in a hundredth of a second: less would only cost time.
constexpr double leastSegmentBytes = 1460, segmentSeconds = 0.01;

}  // namespace

Link::Link(std::string name, LinkQuality quality, Process& client, Process& server)
    : name_(std::move(name)), quality_(quality), loop_(client.loop()) {
    for (LinkEnd& end : ends_) end.link_ = this;
    ends_[0].process_ = &client;
    ends_[1].process_ = &server;
    ends_[0].peer_ = &ends_[1];
    ends_[1].peer_ = &ends_[0];
}

void Link::cut(double clientNotices, double serverNotices) {
    for (LinkEnd& end : ends_) end.hold(never);
    if (clientNotices != never) client().lose(clientNotices, "connection reset");
    if (serverNotices != never) server().lose(serverNotices, "connection reset");
}

void LinkEnd::attach(wire::Session& session, std::function<void()> ended) {
    session_ = &session;
    ended_ = std::move(ended);
    tickLater();
}

void LinkEnd::tickLater() {
    process_->after(tickSeconds, [this] {
        tick();
        if (state_ == State::Open) tickLater();
    });
}

void LinkEnd::tick() {
    if (state_ != State::Open || !session_) return;
    guarded([this] {
        link_->loop_.watched().run([this] { return "the tick of " + link_->name_; },
                                   [this] { session_->tick(process_->now()); });
    });
}

void LinkEnd::send(wire::Frame frame) {
    if (state_ != State::Open) return;
    std::string bytes = wire::encodeFrame(frame);
    if (frame.type == wire::FrameType::ResultOffer) lastOffer_ = bytes;
    inject(std::move(bytes));
}

void LinkEnd::inject(std::string bytes) {
    queued_ += bytes.size();
    largestQueue_ = std::max(largestQueue_, queued_);
    queue_.push_back(std::move(bytes));
    transmit();
}

void LinkEnd::transmit() {
    if (transmitting_ || queue_.empty() || holdUntil_ == never || peer_->unread_ > link_->quality_.windowBytes) return;
    transmitting_ = true;
    const double segment = std::max(leastSegmentBytes, segmentSeconds * link_->quality_.bytesPerSecond);
    const size_t bytes = std::min(queue_.front().size() - frontSent_, size_t(segment));
    link_->loop_.at(departure(bytes), [this, bytes] { transmitted(bytes); });
}

double LinkEnd::departure(size_t bytes) {
    double start = std::max(link_->loop_.now(), holdUntil_);
    if (const auto& line = link_->quality_.line) {
        double& freeAt = line->freeAt[this == &link_->client() ? 0 : 1];
        start = std::max(start, freeAt);
        freeAt = start + double(bytes) / line->bytesPerSecond;
    }
    return start + double(bytes) / link_->quality_.bytesPerSecond;
}

void LinkEnd::transmitted(size_t count) {
    transmitting_ = false;
    if (state_ == State::Ended || queue_.empty()) return;
    if (holdUntil_ > link_->loop_.now()) return transmit();
    std::string bytes = queue_.front().substr(frontSent_, count);
    frontSent_ += count;
    if (frontSent_ == queue_.front().size()) {
        queue_.pop_front();
        frontSent_ = 0;
    }
    queued_ -= count;
    if (std::exchange(corruptNext_, false)) bytes[bytes.size() * 2 / 3] ^= 0x10;
    peer_->unread_ += bytes.size();
    link_->loop_.after(link_->quality_.latency, [peer = peer_, bytes = std::move(bytes)] { peer->arrive(bytes); });
    transmit();
    if (queue_.empty() && state_ == State::Closing) return process_->after(0, [this] { finishClose(); });
    if (queued_ < wire::maxPayloadBytes) process_->after(0, [this] { tick(); });
}

void LinkEnd::arrive(const std::string& bytes) {
    process_->after(0, [this, bytes] {
        unread_ -= bytes.size();
        peer_->transmit();
        if (state_ != State::Open || !session_) return;
        guarded([&] {
            session_->heard(process_->now());
            reader_.feed(bytes);
            while (state_ == State::Open) {
                const auto frame = reader_.next();
                if (!frame) break;
                link_->loop_.watched().run(
                    [&] { return "frame " + std::to_string(int(frame->type)) + " of " + link_->name_; },
                    [&] { session_->receive(*frame, process_->now()); });
                if (afterReceive) afterReceive();
            }
        });
    });
}

void LinkEnd::guarded(const std::function<void()>& call) {
    try {
        call();
    } catch (const wire::ProtocolError& error) {
        if (!link_->tainted) link_->onError(error.what());
        farm::Refusal refusal;
        refusal.set_code(farm::Refusal::PROTOCOL);
        refusal.set_sentence(error.what());
        send(wire::makeFrame(wire::FrameType::Refusal, refusal));
        close(error.what());
    } catch (const std::exception& error) {
        link_->onError(error.what());
        close(error.what());
    }
}

void LinkEnd::close(const std::string& reason) {
    if (state_ != State::Open) return;
    state_ = State::Closing;
    closeReason_ = reason;
    process_->after(queue_.empty() ? 0 : flushSeconds, [this] { finishClose(); });
}

void LinkEnd::finishClose() {
    if (state_ == State::Ended) return;
    if (holdUntil_ != never) {
        const double delay = std::max(0.0, holdUntil_ - link_->loop_.now()) + link_->quality_.latency;
        peer_->lose(delay, "closed by the peer: " + closeReason_);
    }
    end(closeReason_);
}

void LinkEnd::lose(double afterSeconds, const std::string& reason) {
    process_->after(afterSeconds, [this, reason] { end(reason); });
}

void LinkEnd::end(const std::string& reason) {
    if (state_ == State::Ended) return;
    link_->loop_.log(link_->name_ + (this == &link_->client() ? " client" : " server") + " end: " + reason);
    state_ = State::Ended;
    queue_.clear();
    queued_ = frontSent_ = 0;
    if (!session_) return;
    std::exchange(session_, nullptr)->disconnected(reason, process_->now());
    ended_();
}

void LinkEnd::abandon() {
    state_ = State::Ended;
    session_ = nullptr;
    hold(never);
    queue_.clear();
    queued_ = frontSent_ = 0;
}

}  // namespace antipode::simulation
