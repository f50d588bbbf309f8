// Leases and results of one connection.
#include <algorithm>

#include "proto/wire/block_codec.h"
#include "proto/wire/job_messages.h"
#include "renderengine/io/text.h"
#include "tests/server/session_bench.h"
#include "tests/support/random.h"

namespace antipode::test {
namespace {

using farm::Refusal;
using wire::FrameType;

const wire::ScenePackage& tinyPackage() {
    static const wire::ScenePackage package = wire::packageScene(tinyScene());
    return package;
}

/// Sums that do not compress: random values from seed 7. Each iteration counts an event.
class NoiseRenderer final : public Renderer {
public:
    explicit NoiseRenderer(const RenderSettings& settings) {
        sums_.layout = filmLayout(settings);
        sums_.values.resize(sums_.layout.values());
        std::mt19937_64 random(7);
        for (int64_t& value : sums_.values) value = int64_t(random());
    }
    void render(uint64_t) override {
        ++sums_.iterations;
        ++sums_.events.at(EventSource::LightTrace, EventKind::StackOverflow);
    }
    FilmSums sums() const override { return sums_; }
    void reset() override { sums_.iterations = 0, sums_.events = {}; }
    EngineStatistics statistics() const override { return {}; }

private:
    FilmSums sums_;
};

BenchOptions noise() {
    return {.renderers = [](const Scene&, const RenderSettings& s) { return std::make_unique<NoiseRenderer>(s); }};
}

size_t count(const FakePort& port, FrameType type) {
    return size_t(std::ranges::count_if(port.frames, [type](const wire::Frame& f) { return f.type == type; }));
}

TEST(ServerSessionResults, AreOfferedSentUnderCreditsAndSettled) {
    SessionBench bench;
    Peer peer(bench);
    const farm::OpenJob job = jobFor(tinyPackage(), 1, 256, 256);
    peer.openReady(job, tinyPackage());
    peer.grant(3, {16, 4});
    bench.run();
    const auto offer = peer.expect<farm::ResultOffer>(FrameType::ResultOffer);
    const FilmSums expected = fakeSums(wire::fromMessage(job.settings()), {{16, 4}});
    EXPECT_EQ(offer.lease(), 3u);
    EXPECT_EQ(offer.first(), 16u);
    EXPECT_EQ(offer.count(), 4u);
    EXPECT_EQ(hexadecimal(offer.sha256()), expected.sha256());
    EXPECT_EQ(offer.width(), 256u);
    EXPECT_EQ(offer.height(), 256u);
    EXPECT_EQ(wire::layoutOf(wire::fromMessage(job.settings()), offer.scale_exponent()), expected.layout);
    EXPECT_EQ(offer.seconds(), 4);
    EXPECT_EQ(offer.chunks(), 12u);
    EXPECT_GT(offer.statistics().rays(), 0u);
    peer.tick(1);
    EXPECT_TRUE(peer.quiet()) << "no chunk without a credit";

    std::vector<int64_t> values(expected.values.size());
    peer.credit(3, 1);
    for (uint32_t i = 0; i < offer.chunks(); ++i) {
        std::string payload;
        const auto chunk = peer.expect<farm::ResultChunk>(FrameType::ResultChunk, &payload);
        EXPECT_EQ(chunk.lease(), 3u);
        EXPECT_EQ(chunk.index(), i);
        wire::decodeChunk(payload, wire::chunkOf(std::span(values), i));
        if (i == 0) {
            EXPECT_TRUE(peer.quiet());
            peer.credit(3, UINT32_MAX);
            peer.credit(3, UINT32_MAX);
        }
    }
    EXPECT_EQ(values, expected.values);
    EXPECT_TRUE(peer.quiet());
    EXPECT_EQ(bench.queue.totals().waitingResults, 1u);
    peer.verdict(3);
    EXPECT_EQ(bench.queue.totals().waitingResults, 0u);
}

TEST(ServerSessionResults, AreOfferedWithTheirEvents) {
    SessionBench bench(noise());
    Peer peer(bench);
    peer.openReady(jobFor(tinyPackage()), tinyPackage());
    for (const uint64_t iterations : {3, 2}) {
        peer.grant(iterations == 3 ? 1 : 2, {8, iterations});
        bench.run();
        EventCounts expected;
        expected.at(EventSource::LightTrace, EventKind::StackOverflow) = iterations;
        EXPECT_EQ(wire::fromMessage(peer.expect<farm::ResultOffer>(FrameType::ResultOffer).events()), expected);
    }
}

TEST(ServerSessionResults, AnyVerdictThatExistsSettles) {
    SessionBench bench;
    Peer peer(bench);
    peer.openReady(jobFor(tinyPackage()), tinyPackage());
    uint64_t lease = 0;
    for (const auto verdict :
         {farm::ResultVerdict::COMMITTED, farm::ResultVerdict::NOT_NEEDED, farm::ResultVerdict::REJECTED}) {
        peer.grant(++lease, {0, 1});
        bench.run();
        peer.verdict(lease, verdict);
        EXPECT_EQ(bench.queue.totals().waitingResults, 0u);
    }
    EXPECT_THROW(peer.verdict(lease, farm::ResultVerdict::UNKNOWN), wire::ProtocolError);
    EXPECT_THROW(peer.verdict(lease, farm::ResultVerdict::Verdict(77)), wire::ProtocolError);
}

TEST(ServerSessionResults, MessagesThatCrossedAreIgnored) {
    SessionBench bench;
    Peer peer(bench);
    peer.openReady(jobFor(tinyPackage()), tinyPackage());
    peer.grant(1, {0, 1});
    bench.run();
    peer.expect<farm::ResultOffer>(FrameType::ResultOffer);
    farm::Truncate truncate;
    truncate.set_lease(1);
    peer.send(FrameType::Truncate, truncate);  // the offer was on its way
    EXPECT_TRUE(bench.queue.result(jobFor(tinyPackage()).job(), 1));
    peer.verdict(1);
    peer.send(FrameType::Truncate, truncate);
    peer.credit(1, 5);
    peer.verdict(1);
    peer.credit(99, 5);
    EXPECT_TRUE(peer.quiet());
    EXPECT_FALSE(peer.port.closed);
}

TEST(ServerSessionResults, ATruncatedLeaseGivesWhatWasDoneOrComesBack) {
    SessionBench bench;
    Peer peer(bench);
    peer.openReady(jobFor(tinyPackage()), tinyPackage());
    peer.grant(1, {8, 8});
    peer.grant(2, {16, 8});
    bench.step(3);
    farm::Truncate truncate;
    truncate.set_lease(2);
    peer.send(FrameType::Truncate, truncate);
    const auto returned = peer.expect<farm::LeaseReturned>(FrameType::LeaseReturned);
    EXPECT_EQ(returned.lease(), 2u);
    EXPECT_EQ(returned.reason(), "");
    truncate.set_lease(1);
    peer.send(FrameType::Truncate, truncate);
    bench.run();
    const auto offer = peer.expect<farm::ResultOffer>(FrameType::ResultOffer);
    EXPECT_EQ(offer.first(), 8u);
    EXPECT_EQ(offer.count(), 3u);
}

TEST(ServerSessionResults, ProgressIsSaidAtMostTwiceASecond) {
    SessionBench bench;
    Peer peer(bench);
    peer.openReady(jobFor(tinyPackage()), tinyPackage());
    peer.grant(1, {0, 1000});
    std::vector<uint64_t> said;
    for (int i = 0; i < 100; ++i) {
        bench.step();
        peer.tick(0.1);
        while (!peer.port.frames.empty()) {
            const auto progress = peer.expect<farm::Progress>(FrameType::Progress);
            EXPECT_EQ(progress.lease(), 1u);
            said.push_back(progress.done());
        }
    }
    EXPECT_GE(said.size(), 16u);
    EXPECT_LE(said.size(), 20u);
    EXPECT_TRUE(std::ranges::is_sorted(said));
    EXPECT_GE(said.back(), 94u);
}

TEST(ServerSessionResults, ChunksWaitUntilThePortsQueueIsShort) {
    SessionBench bench(noise());
    Peer peer(bench);
    peer.openReady(jobFor(tinyPackage(), 1, 512, 512), tinyPackage());
    peer.grant(1, {0, 1});
    bench.run();
    ASSERT_EQ(peer.expect<farm::ResultOffer>(FrameType::ResultOffer).chunks(), 48u);
    peer.port.stalled = true;
    peer.credit(1, 48);
    EXPECT_EQ(count(peer.port, FrameType::ResultChunk), 2u);
    EXPECT_LT(peer.port.queued, 2 * wire::shortQueueBytes);
    peer.tick();
    EXPECT_EQ(count(peer.port, FrameType::ResultChunk), 2u);
    for (size_t sent = 4; sent <= 48; sent += 2) {
        peer.port.queued = 0;
        peer.tick();
        EXPECT_EQ(count(peer.port, FrameType::ResultChunk), sent);
    }
}

TEST(ServerSessionResults, AClientThatDoesNotFetchCostsNoMoreThanLeaseDepthResults) {
    SessionBench bench;
    Peer slow(bench), quick(bench);
    slow.openReady(jobFor(tinyPackage(), 1), tinyPackage());
    quick.openReady(jobFor(tinyPackage(), 2), tinyPackage());
    slow.grant(1, {0, 1});
    slow.grant(2, {1, 1});
    bench.run();
    slow.grant(3, {2, 1});
    slow.grant(4, {3, 1});
    for (uint64_t lease = 1; lease <= 20; ++lease) {
        quick.grant(lease, {lease, 1});
        bench.run();
        EXPECT_EQ(quick.expect<farm::ResultOffer>(FrameType::ResultOffer).lease(), lease);
        quick.verdict(lease);
        EXPECT_EQ(bench.queue.totals().waitingResults, 2u);
    }
    EXPECT_THROW(slow.grant(5, {4, 1}), wire::ProtocolError);
}

TEST(ServerSessionResults, AClientThatAsksOnWithoutReadingIsCutOff) {
    SessionBench bench;
    Peer peer(bench);
    peer.openReady(jobFor(tinyPackage()), tinyPackage());
    peer.grant(1, {0, 1000000});
    peer.port.stalled = true;
    uint64_t lease = 2;
    for (; lease < 10000000 && !peer.port.closed; ++lease) {
        peer.grant(lease, {0, 1});
        farm::Truncate truncate;
        truncate.set_lease(lease);
        peer.send(FrameType::Truncate, truncate);
    }
    EXPECT_EQ(peer.port.closed, "the client does not read");
    EXPECT_LT(peer.port.queued, 17u << 20);
}

TEST(ServerSessionResults, AReconnectIsOfferedThemAgain) {
    SessionBench bench;
    Peer first(bench), second(bench);
    const farm::OpenJob job = jobFor(tinyPackage());
    first.openReady(job, tinyPackage());
    first.grant(1, {0, 4});
    first.grant(2, {4, 4});
    bench.step(4);
    first.credit(1, 1);
    bench.step(1);
    first.disconnect();
    bench.run();
    second.hello();
    second.openJob(job);
    second.expect<farm::JobReady>(FrameType::JobReady);
    EXPECT_EQ(second.expect<farm::ResultOffer>(FrameType::ResultOffer).lease(), 1u);
    EXPECT_EQ(second.expect<farm::ResultOffer>(FrameType::ResultOffer).lease(), 2u);
    EXPECT_TRUE(second.quiet()) << "credits of the old connection are gone";
    second.credit(1, 1);
    EXPECT_EQ(second.expect<farm::ResultChunk>(FrameType::ResultChunk).index(), 0u);
    EXPECT_THROW(second.grant(2, {8, 4}), wire::ProtocolError);
}

TEST(ServerSessionResults, AnotherConnectionOfTheJobEndsTheOlder) {
    SessionBench bench;
    Peer first(bench), second(bench);
    first.openReady(jobFor(tinyPackage()), tinyPackage());
    second.hello();
    second.openJob(jobFor(tinyPackage()));
    second.expect<farm::JobReady>(FrameType::JobReady);
    EXPECT_EQ(first.port.closed, "the client has opened the job on another connection");
    first.grant(1, {0, 1});  // was on its way
    first.disconnect();
    second.grant(1, {0, 1});
    bench.run();
    second.expect<farm::ResultOffer>(FrameType::ResultOffer);
}

TEST(ServerSessionResults, OrphansLastForAWhile) {
    SessionBench bench({.limits = {.orphanSeconds = 120}});
    Peer first(bench), second(bench);
    first.openReady(jobFor(tinyPackage()), tinyPackage());
    first.disconnect();
    bench.queue.tick(bench.now + 121);
    EXPECT_EQ(bench.queue.totals().jobs, 0u);
    second.hello();
    second.openJob(jobFor(tinyPackage()));
    EXPECT_TRUE(second.quiet()) << "it is built again";
    bench.run();
    second.expect<farm::JobReady>(FrameType::JobReady);
}

TEST(ServerSessionResults, ADeviceThatFailsReturnsTheLeasesAndRefuses) {
    SessionBench bench;
    Peer peer(bench);
    peer.openReady(jobFor(tinyPackage()), tinyPackage());
    peer.grant(1, {0, 4});
    peer.grant(2, {4, 4});
    bench.worker.failNext = Error(ErrorCode::Device, "The device is lost.");
    bench.run();
    for (const uint64_t lease : {1, 2}) {
        const auto returned = peer.expect<farm::LeaseReturned>(FrameType::LeaseReturned);
        EXPECT_EQ(returned.lease(), lease);
        EXPECT_EQ(returned.reason(), "The server's device failed in the middle of a block: The device is lost.");
    }
    peer.expectRefusal(Refusal::DEVICE_FAILED, "The device is lost.");
}

TEST(ServerSessionResults, ADrainLetsThemBeFetched) {
    SessionBench bench;
    Peer peer(bench);
    peer.openReady(jobFor(tinyPackage()), tinyPackage());
    peer.grant(1, {0, 8});
    bench.step(3);
    bench.context.draining = true;
    bench.queue.drain();
    peer.tick();
    peer.expect<farm::Draining>(FrameType::Draining);
    peer.tick(0.2);
    bench.run();
    peer.tick(0.2);
    EXPECT_EQ(peer.expect<farm::ResultOffer>(FrameType::ResultOffer).count(), 3u);
    peer.grant(2, {8, 8});  // was on its way
    EXPECT_EQ(peer.expect<farm::LeaseReturned>(FrameType::LeaseReturned).lease(), 2u);
    peer.credit(1, 1);
    peer.expect<farm::ResultChunk>(FrameType::ResultChunk);
    peer.tick(0.2);
    EXPECT_FALSE(peer.port.closed);
    EXPECT_FALSE(bench.queue.idle());
    peer.verdict(1);
    EXPECT_TRUE(bench.queue.idle());
    peer.tick(0.2);
    peer.expectRefusal(Refusal::DRAINING, "going down");
}

TEST(ServerSessionResults, ADrainingServerStillGivesThemToAReconnect) {
    SessionBench bench;
    Peer first(bench), second(bench);
    first.openReady(jobFor(tinyPackage()), tinyPackage());
    first.grant(1, {0, 1});
    bench.run();
    first.disconnect();
    bench.context.draining = true;
    bench.queue.drain();
    second.hello();
    second.openJob(jobFor(tinyPackage()));
    second.expect<farm::JobReady>(FrameType::JobReady);
    second.expect<farm::ResultOffer>(FrameType::ResultOffer);
}

}  // namespace
}  // namespace antipode::test
