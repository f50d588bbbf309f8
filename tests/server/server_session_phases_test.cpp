// Which message may come when, and what happens when it comes at another time.
#include <array>
#include <string_view>

#include "proto/wire/frame.h"
#include "tests/server/session_bench.h"
#include "tests/support/random.h"

namespace antipode::test {
namespace {

using farm::Refusal;
using wire::Frame;
using wire::FrameType;

enum class Phase { Greeting, Introduced, Loading, Uploading, Building, Ready, Ended };
constexpr std::array phases = {Phase::Greeting, Phase::Introduced, Phase::Loading, Phase::Uploading,
                               Phase::Building, Phase::Ready,      Phase::Ended};

const wire::ScenePackage& tinyPackage() {
    static const wire::ScenePackage package = wire::packageScene(tinyScene());
    return package;
}

/// Brings a session there.
void enter(Phase phase, SessionBench& bench, Peer& peer) {
    if (phase == Phase::Greeting) return;
    peer.hello();
    if (phase == Phase::Introduced) return;
    bench.holdBackground = phase == Phase::Loading;
    peer.openJob(jobFor(tinyPackage()));
    if (phase == Phase::Uploading) return;
    peer.upload(tinyPackage());
    if (phase == Phase::Loading || phase == Phase::Building) return;
    bench.run();
    peer.expect<farm::JobReady>(FrameType::JobReady);
    if (phase == Phase::Ended) peer.send(FrameType::CloseJob, farm::CloseJob());
}

/// A message of this type that is right where the type is.
Frame validFrame(FrameType type) {
    switch (type) {
        case FrameType::Hello: {
            farm::Hello hello;
            hello.set_oldest_protocol(wire::protocolVersion);
            hello.set_newest_protocol(wire::protocolVersion);
            hello.set_kernel_hash(std::string(64, 'c'));
            return wire::makeFrame(type, hello);
        }
        case FrameType::OpenJob: return wire::makeFrame(type, jobFor(tinyPackage()));
        case FrameType::BlobChunk: {
            farm::BlobChunk chunk;
            chunk.set_sha256(tinyPackage().root().sha256());
            return wire::makeFrame(type, chunk, tinyPackage().blobs.front().bytes->substr(0, 3));
        }
        case FrameType::LeaseGrant: {
            farm::LeaseGrant lease;
            lease.set_lease(1);
            lease.set_count(1);
            return wire::makeFrame(type, lease);
        }
        case FrameType::ResultVerdict: {
            farm::ResultVerdict verdict;
            verdict.set_verdict(farm::ResultVerdict::COMMITTED);
            return wire::makeFrame(type, verdict);
        }
        default: return {type, "", ""};
    }
}

/// What becomes of a frame: 'p' a ProtocolError, 'c' the connection is closed, '.' it goes on.
char outcome(Peer& peer, const Frame& frame) {
    const bool wasClosed = peer.port.closed.has_value();
    try {
        peer.receive(frame);
    } catch (const wire::ProtocolError& error) {
        EXPECT_GT(std::string_view(error.what()).size(), 10u);
        return 'p';
    }
    return peer.port.closed && !wasClosed ? 'c' : '.';
}

TEST(ServerSessionPhases, EveryMessageInEveryPhase) {
    // Greeting, introduced, loading, uploading, building, ready, ended.
    const std::vector<std::pair<FrameType, const char*>> table = {
        {FrameType::Hello, ".ppppp."},       {FrameType::Welcome, "pppppp."},
        {FrameType::Refusal, "pccccc."},     {FrameType::Heartbeat, "p......"},
        {FrameType::Draining, "pppppp."},    {FrameType::OpenJob, "p.pppp."},
        {FrameType::NeedBlobs, "pppppp."},   {FrameType::BlobChunk, "ppp.pp."},
        {FrameType::JobReady, "pppppp."},    {FrameType::CloseJob, "pccccc."},
        {FrameType::LeaseGrant, "ppppp.."},  {FrameType::Progress, "pppppp."},
        {FrameType::Truncate, "ppppp.."},    {FrameType::LeaseReturned, "pppppp."},
        {FrameType::ResultOffer, "pppppp."}, {FrameType::ResultCredit, "ppppp.."},
        {FrameType::ResultChunk, "pppppp."}, {FrameType::ResultVerdict, "ppppp.."},
        {FrameType::Capacity, "pppppp."},    {FrameType(0), "pppppp."},
        {FrameType(999), "pppppp."},
    };
    for (const auto& [type, expected] : table)
        for (size_t i = 0; i < phases.size(); ++i) {
            SessionBench bench;
            Peer peer(bench);
            enter(phases[i], bench, peer);
            EXPECT_EQ(outcome(peer, validFrame(type)), expected[i]) << "type " << int(type) << ", phase " << i;
            peer.disconnect();
            bench.runBackground();
            bench.run();
        }
}

TEST(ServerSessionPhases, GarbageInEveryPhaseIsAProtocolErrorAtMost) {
    Random random(20);
    for (int type = 1; type <= 19; ++type)
        for (const Phase phase : phases) {
            SessionBench bench;
            Peer peer(bench);
            enter(phase, bench, peer);
            for (int i = 0; i < 20; ++i) {
                Frame frame{FrameType(type), "", ""};
                for (uint32_t n = random.index(40); n > 0; --n) frame.message.push_back(char(random.index(256)));
                if (random.index(2)) frame.payload.assign(random.index(5), 'x');
                outcome(peer, frame);
            }
            peer.disconnect();
        }
}

/// Clients that say anything at any time, several at once, with the server's own steps between: nobody else suffers.
TEST(ServerSessionPhases, RandomConversationsLeaveTheServerSound) {
    for (uint64_t seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        SessionBench bench;
        std::vector<std::unique_ptr<Peer>> peers;
        std::vector<bool> gone;
        for (int i = 0; i < 3; ++i) {
            peers.push_back(std::make_unique<Peer>(bench));
            gone.push_back(false);
            enter(phases[random.index(phases.size())], bench, *peers.back());
        }
        bench.holdBackground = random.index(2);
        for (int i = 0; i < 60; ++i) {
            const size_t who = random.index(3);
            Peer& peer = *peers[who];
            Frame frame = validFrame(FrameType(1 + random.index(19)));
            if (frame.type == FrameType::LeaseGrant) {
                farm::LeaseGrant lease;
                lease.set_lease(random.index(60));
                lease.set_count(random.index(4));
                frame = wire::makeFrame(frame.type, lease);
            }
            if (!gone[who] && random.index(4) == 0) {
                if (outcome(peer, frame) == 'p') gone[who] = true, peer.disconnect();
            }
            const uint32_t what = random.index(6);
            if (what == 0) bench.step();
            if (what == 1) bench.runBackground();
            if (what == 2 && !gone[who]) peer.tick(random.uniform());
            if (what == 3) bench.queue.tick(bench.now);
        }
        for (size_t i = 0; i < peers.size(); ++i)
            if (!gone[i]) peers[i]->disconnect();
        peers.clear();
        bench.holdBackground = false;
        bench.runBackground();
        bench.run();
        bench.queue.tick(bench.now + 1000);
        bench.run();
        EXPECT_EQ(bench.queue.totals().jobs, 0u);
        EXPECT_EQ(bench.worker.openJobs(), 0u);
        Peer decent(bench);
        decent.openReady(jobFor(tinyPackage()), tinyPackage());
        decent.grant(1, {0, 2});
        bench.run();
        EXPECT_EQ(decent.expect<farm::ResultOffer>(FrameType::ResultOffer).count(), 2u) << "seed " << seed;
    }
}

TEST(ServerSessionPhases, WelcomesACompatibleClient) {
    SessionBench bench;
    Peer peer(bench);
    EXPECT_FALSE(peer.session().introduced());
    EXPECT_EQ(peer.session().client(), "");
    farm::Hello hello;
    hello.set_oldest_protocol(0);
    hello.set_newest_protocol(7);
    hello.set_kernel_hash(std::string(64, 'c'));
    hello.set_client("host/\x1b[2J" + std::string(1000, 'x'));
    peer.send(FrameType::Hello, hello);
    const auto welcome = peer.expect<farm::Welcome>(FrameType::Welcome);
    EXPECT_EQ(welcome.protocol(), wire::protocolVersion);
    EXPECT_EQ(welcome.build(), "1.2.3");
    EXPECT_EQ(welcome.lease_depth(), 2u);
    EXPECT_TRUE(peer.session().introduced());
    EXPECT_EQ(peer.session().client().substr(0, 9), "host/?[2J");
    EXPECT_LE(peer.session().client().size(), 200u);
}

TEST(ServerSessionPhases, RefusesOtherProtocolsAndKernels) {
    constexpr uint32_t own = wire::protocolVersion;
    for (const auto& [oldest, newest] : {std::pair(own + 1, own + 2), {0u, own - 1}, {own + 3, own - 1}}) {
        SessionBench bench;
        Peer peer(bench);
        farm::Hello hello;
        hello.set_build("9.9.9");
        hello.set_oldest_protocol(oldest);
        hello.set_newest_protocol(newest);
        hello.set_kernel_hash(std::string(64, 'c'));
        peer.send(FrameType::Hello, hello);
        peer.expectRefusal(Refusal::INCOMPATIBLE, "build 9.9.9, the server 1.2.3");
    }
    SessionBench bench;
    Peer peer(bench);
    farm::Hello hello;
    hello.set_oldest_protocol(wire::protocolVersion);
    hello.set_newest_protocol(wire::protocolVersion);
    hello.set_kernel_hash(std::string(64, 'd'));
    peer.send(FrameType::Hello, hello);
    peer.expectRefusal(Refusal::INCOMPATIBLE, "kernels differ (dddddddddddd and cccccccccccc)");
}

TEST(ServerSessionPhases, ClosesWithoutHelloInTime) {
    SessionBench bench;
    Peer peer(bench);
    peer.tick(wire::Liveness{}.helloSeconds);
    EXPECT_FALSE(peer.port.closed);
    peer.tick(0.1);
    EXPECT_EQ(peer.port.closed, "no Hello in time");
    EXPECT_TRUE(peer.port.frames.empty()) << "strangers are told nothing";
}

TEST(ServerSessionPhases, ClosesOnSilenceAndKeepsAClientThatBeats) {
    SessionBench bench;
    Peer peer(bench);
    peer.openReady(jobFor(tinyPackage()), tinyPackage());
    for (int i = 0; i < 100; ++i) {
        peer.tick(5);
        peer.send(FrameType::Heartbeat, farm::Heartbeat());
    }
    EXPECT_FALSE(peer.port.closed);
    peer.tick(10);
    EXPECT_FALSE(peer.port.closed);
    peer.tick(0.1);
    EXPECT_EQ(peer.port.closed, "the client has fallen silent");
}

TEST(ServerSessionPhases, ClosesOnAClientThatBeatsButDoesNotGoOn) {
    for (const Phase phase : {Phase::Introduced, Phase::Uploading}) {
        SessionBench bench;
        Peer peer(bench);
        enter(phase, bench, peer);
        for (int i = 0; i < 60; ++i) {
            EXPECT_FALSE(peer.port.closed);
            peer.tick(1);
            peer.send(FrameType::Heartbeat, farm::Heartbeat());
        }
        peer.tick(1);
        EXPECT_EQ(peer.port.closed, "the client does not go on");
    }
}

TEST(ServerSessionPhases, SendsHeartbeatsWhereNothingElseGoes) {
    SessionBench bench;
    Peer peer(bench);
    enter(Phase::Building, bench, peer);
    peer.port.frames.clear();
    for (int i = 0; i < 40; ++i) peer.tick(0.2);
    EXPECT_EQ(peer.port.frames.size(), 4u);
    for (const Frame& frame : peer.port.frames) EXPECT_EQ(frame.type, FrameType::Heartbeat);
}

TEST(ServerSessionPhases, CloseJobForgetsTheJob) {
    SessionBench bench;
    Peer peer(bench);
    enter(Phase::Ready, bench, peer);
    EXPECT_EQ(bench.queue.totals().jobs, 1u);
    peer.send(FrameType::CloseJob, farm::CloseJob());
    EXPECT_TRUE(peer.port.closed);
    EXPECT_EQ(bench.queue.totals().jobs, 0u);
    bench.run();
    EXPECT_EQ(bench.worker.openJobs(), 0u);
}

TEST(ServerSessionPhases, ADrainingServerTakesNoNewJob) {
    for (const Phase phase : {Phase::Introduced, Phase::Loading, Phase::Uploading, Phase::Building, Phase::Ready}) {
        SessionBench bench;
        Peer peer(bench);
        enter(phase, bench, peer);
        peer.port.frames.clear();
        bench.context.draining = true;
        bench.queue.drain();
        peer.tick();
        peer.expect<farm::Draining>(FrameType::Draining);
        peer.expectRefusal(Refusal::DRAINING, "going down");
        bench.runBackground();
        bench.run();
        EXPECT_TRUE(peer.port.frames.empty());
    }
    SessionBench bench;
    Peer peer(bench);
    peer.hello();
    bench.context.draining = true;
    peer.openJob(jobFor(tinyPackage()));
    peer.expectRefusal(Refusal::DRAINING, "going down");
}

TEST(ServerSessionClients, AreCountedWhereTheyAreLetIn) {
    SessionBench bench;
    bench.context.maxClients = 2;
    // Strangers take no place, however many there are, and those who greet at once find no more than there are.
    std::vector<std::unique_ptr<Peer>> peers;
    for (int i = 0; i < 5; ++i) peers.push_back(std::make_unique<Peer>(bench));
    EXPECT_EQ(bench.context.clients, 0u);
    peers[4]->hello();
    peers[2]->hello();
    for (const int late : {0, 1, 3}) {
        peers[size_t(late)]->receive(validFrame(FrameType::Hello));
        peers[size_t(late)]->expectRefusal(Refusal::BUSY, "2 clients");
        EXPECT_FALSE(peers[size_t(late)]->session().introduced());
    }
    EXPECT_EQ(bench.context.clients, 2u);
    peers[2]->disconnect();
    peers.erase(peers.begin() + 2);
    Peer next(bench);
    next.hello();
    EXPECT_EQ(bench.context.clients, 2u);
    peers.clear();
    EXPECT_EQ(bench.context.clients, 1u);
}

}  // namespace
}  // namespace antipode::test
