// A client's session with a server that the test plays.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "farm/nodes/remote_session.h"

namespace antipode::test {

/// Keeps what is sent.
class FakePort final : public wire::FramePort {
public:
    void send(wire::Frame frame) override { sent.push_back(std::move(frame)); }
    size_t queuedBytes() const override { return queued; }
    void close(const std::string& reason) override { closed = reason; }

    std::vector<wire::Frame> sent;
    size_t queued = 0;
    std::optional<std::string> closed;
};

class RemoteSessionTest : public testing::Test {
protected:
    static constexpr double start = 100;

    explicit RemoteSessionTest(uint32_t width = 4, uint32_t height = 2);

    /// Begins a conversation, the earlier one being over.
    void connect();
    void receive(const wire::Frame& frame);
    template <class Message>
    void receive(wire::FrameType type, const Message& message, std::string payload = {}) {
        receive(wire::makeFrame(type, message, std::move(payload)));
    }
    /// Has everything said that comes before a phase.
    void reach(RemoteSession::Phase phase);
    void disconnect();

    farm::Welcome welcome() const;
    farm::NeedBlobs need(size_t blob, uint64_t offset = 0) const;
    farm::JobReady jobReady() const;
    farm::ResultOffer offer(uint64_t lease, IterationRange range) const;
    /// Chunk `index` of the sums that `offer` is of.
    wire::Frame chunk(const farm::ResultOffer& offer, uint32_t index, uint64_t lease) const;
    /// The offer and all its chunks.
    void deliver(const farm::ResultOffer& offer);

    /// The messages of a type that have been sent and not been taken yet.
    template <class Message>
    std::vector<Message> take(wire::FrameType type) {
        std::vector<Message> taken;
        std::erase_if(port->sent, [&](const wire::Frame& frame) {
            if (frame.type != type) return false;
            taken.push_back(wire::parseMessage<Message>(frame));
            return true;
        });
        return taken;
    }
    /// Lets the coordinator lease, and says what came of it.
    std::vector<farm::LeaseGrant> leases();
    /// The one verdict that has been sent.
    farm::ResultVerdict::Verdict verdict();

    double now = start;
    RenderSettings settings;
    wire::ScenePackage scene;
    std::unique_ptr<Coordinator> coordinator;
    ReassemblyBudget budget;
    std::unique_ptr<RemoteContext> context;
    std::unique_ptr<FakePort> port;
    std::unique_ptr<RemoteSession> session;
};

}  // namespace antipode::test
