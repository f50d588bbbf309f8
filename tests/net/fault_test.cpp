// Connections through a network that breaks them. Every fault follows from the seeds below.
#include <gtest/gtest.h>

#include <random>

#include "support/fault_proxy.h"
#include "tests/net/credentials.h"
#include "tests/net/loopback.h"

namespace antipode::test {
namespace {

using wire::Connection;
using wire::Frame;
using wire::FrameType;
using wire::Security;
using Role = Security::Role;

/// The `index`-th frame that a client sends: no two are alike.
Frame frameOf(uint64_t index) {
    std::mt19937_64 random(index);
    const size_t bytes = index % 50 == 0 ? random() % 200000 : random() % 3000;
    std::string payload(bytes, char('a' + random() % 26));
    return {FrameType::BlobChunk, std::to_string(index), payload};
}

/// Sends frames in order, as fast as they leave.
struct Sender {
    uint64_t frames;
    uint64_t sent = 0;
    void operator()(TestSession& session, Connection& connection) {
        session.onTick = [this, &connection] { push(connection); };
        push(connection);
    }
    void push(Connection& connection) {
        while (sent < frames && connection.queuedBytes() < wire::maxPayloadBytes) connection.send(frameOf(sent++));
    }
};

/// Counts frames that come in order, and wrong ones.
struct Receiver {
    uint64_t right = 0, wrong = 0;
    void operator()(TestSession& session, Connection&) {
        session.onFrame = [this](const Frame& frame) { equal(frame, frameOf(right)) ? ++right : ++wrong; };
    }
};

struct Outcome {
    uint64_t right, wrong;
    std::string clientReason, serverReason;
    FaultCounters faults;
};

/// Sends `frames` frames through a proxy with these faults until they are there or the connection ends.
Outcome transfer(const FaultOptions& options, uint64_t frames, bool tls) {
    const wire::SecurityOptions secret = tls ? credentials().secret("9c1f04e7ab52d836") : wire::SecurityOptions{};
    const Security serverSide(secret, Role::Server), clientSide(secret, Role::Client);
    Sender sender{frames};
    Receiver receiver;
    asio::io_context context;
    LoopbackServer server(context, serverSide, std::ref(receiver));
    FaultProxy proxy(server.port(), options);
    LoopbackClient client(context, proxy.port(), clientSide, std::ref(sender));
    runUntil(context, 10, [&] {
        return receiver.right == frames ||
               (client.session.ended() && !server.sessions.empty() && server.sessions[0]->ended());
    });
    const std::string serverReason = server.sessions.empty() ? "never met" : server.sessions[0]->reason;
    return {receiver.right, receiver.wrong, client.session.reason, serverReason, proxy.counters()};
}

TEST(Faults, LoseNothingWhereTheyOnlyHinder) {
    for (const bool tls : {false, true})
        for (const uint64_t seed : {1, 2, 3}) {
            SCOPED_TRACE(seed);
            FaultOptions options;
            options.seed = seed;
            options.split = 0.1;
            options.coalesce = 0.02;
            options.delay = 0.02;
            options.meanSegmentBytes = 8192;
            const Outcome outcome = transfer(options, 3000, tls);
            EXPECT_EQ(outcome.right, 3000u) << outcome.serverReason;
            EXPECT_EQ(outcome.wrong, 0u);
            EXPECT_GT(outcome.faults.split, 20u);
            EXPECT_GT(outcome.faults.coalesce, 3u);
            EXPECT_GT(outcome.faults.delay, 3u);
        }
}

TEST(Faults, LetNoWrongFrameThrough) {
    uint64_t flips = 0, duplicates = 0, drops = 0;
    for (const bool tls : {false, true})
        for (uint64_t seed = 1; seed <= 20; ++seed) {
            SCOPED_TRACE(seed);
            FaultOptions options;
            options.seed = seed;
            options.meanSegmentBytes = 16384;
            options.unharmedBytes = 4096;  // the handshake of TLS is not the point here
            options.flip = options.duplicate = options.drop = 0.03;
            const Outcome outcome = transfer(options, 3000, tls);
            EXPECT_EQ(outcome.wrong, 0u);
            EXPECT_LT(outcome.right, 3000u);
            EXPECT_GT(outcome.faults.flip + outcome.faults.duplicate + outcome.faults.drop, 0u);
            const std::string words = tls ? "TLS with the client failed" : "protocol error";
            EXPECT_NE(outcome.serverReason.find(words), std::string::npos) << outcome.serverReason;
            EXPECT_FALSE(outcome.clientReason.empty());
            flips += outcome.faults.flip;
            duplicates += outcome.faults.duplicate;
            drops += outcome.faults.drop;
        }
    EXPECT_GT(std::min({flips, duplicates, drops}), 3u);
}

TEST(Faults, EndBothSidesWhereTheConnectionIsCut) {
    uint64_t truncations = 0, resets = 0;
    for (const bool tls : {false, true})
        for (uint64_t seed = 1; seed <= 20; ++seed) {
            SCOPED_TRACE(seed);
            FaultOptions options;
            options.seed = seed;
            options.truncate = options.reset = 0.02;
            const Outcome outcome = transfer(options, 3000, tls);
            EXPECT_EQ(outcome.wrong, 0u);
            EXPECT_LT(outcome.right, 3000u);
            EXPECT_FALSE(outcome.clientReason.empty());
            EXPECT_FALSE(outcome.serverReason.empty());
            truncations += outcome.faults.truncate;
            resets += outcome.faults.reset;
        }
    EXPECT_GT(std::min(truncations, resets), 3u);
}

TEST(Faults, AreWaitedOutWhereTheCableIsPutBack) {
    const Security serverSide({}, Role::Server), clientSide({}, Role::Client);
    // 60 MB: more than sockets hold.
    constexpr uint64_t frames = 20000;
    Sender sender{frames};
    Receiver receiver;
    asio::io_context context;
    LoopbackServer server(context, serverSide, std::ref(receiver));
    FaultProxy proxy(server.port(), {});
    LoopbackClient client(context, proxy.port(), clientSide, std::ref(sender));
    EXPECT_TRUE(runUntil(context, 3, [&] { return receiver.right >= 10; }));
    proxy.blackHole();
    runUntil(context, 0.1, [] { return false; });
    const uint64_t before = receiver.right;
    runUntil(context, 0.3, [] { return false; });
    EXPECT_LT(before, frames);
    EXPECT_EQ(receiver.right, before);
    EXPECT_LT(client.connection->queuedBytes(), 2 * wire::maxPayloadBytes);
    proxy.restore();
    EXPECT_TRUE(runUntil(context, 8, [&] { return receiver.right == frames; }));
    EXPECT_EQ(receiver.wrong, 0u);

    proxy.cutAll();
    EXPECT_TRUE(runUntil(context, 1, [&] { return client.session.ended() && server.sessions[0]->ended(); }));
    EXPECT_EQ(client.session.endings, 1);
    EXPECT_EQ(server.sessions[0]->endings, 1);
}

TEST(FaultProxy, HoldsOneWayAndLetsTheOtherPass) {
    const Security serverSide({}, Role::Server), clientSide({}, Role::Client);
    asio::io_context context;
    // A frame every other tick, because each frame that has left ticks once more.
    const auto chat = [](TestSession& session, Connection& connection) {
        session.onTick = [&session, &connection] {
            if (session.ticks % 2 == 0) connection.send({FrameType::Heartbeat, "", ""});
        };
    };
    LoopbackServer server(context, serverSide, chat);
    FaultProxy proxy(server.port(), {});
    LoopbackClient client(context, proxy.port(), clientSide, chat);
    EXPECT_TRUE(runUntil(context, 3, [&] { return server.received() > 0 && client.session.received > 0; }));
    proxy.blackHoleOneWay();
    runUntil(context, 0.1, [] { return false; });
    const uint64_t toServer = server.received(), toClient = client.session.received;
    EXPECT_TRUE(runUntil(context, 3, [&] { return client.session.received > toClient + 1; }));
    EXPECT_EQ(server.received(), toServer);
}

TEST(FaultProxy, DoesTheSameForTheSameSeed) {
    FaultOptions options;
    options.seed = 7;
    options.split = options.flip = options.duplicate = 0.02;
    options.unharmedBytes = 4096;
    options.meanSegmentBytes = 16384;
    const Outcome first = transfer(options, 3000, false), second = transfer(options, 3000, false);
    EXPECT_EQ(first.right, second.right);
    EXPECT_EQ(first.serverReason, second.serverReason);
    options.seed = 8;
    EXPECT_NE(first.right, transfer(options, 3000, false).right);
}

}  // namespace
}  // namespace antipode::test
