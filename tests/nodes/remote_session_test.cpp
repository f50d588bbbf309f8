#include "farm/nodes/remote_session.h"

#include <cmath>

#include "proto/wire/job_messages.h"
#include "tests/nodes/remote_session_fixture.h"
#include "tests/support/dyadic.h"
#include "tests/support/fake_renderer.h"

using namespace antipode;
using namespace antipode::test;
using wire::FrameType;
using Phase = RemoteSession::Phase;

namespace {

IterationRange rangeOf(const farm::LeaseGrant& lease) { return {lease.first(), lease.count()}; }

/// A film of 17 chunks: one more than there is credit for at once.
class LargeFilm : public RemoteSessionTest {
protected:
    LargeFilm() : RemoteSessionTest(600, 600) {}
};

}  // namespace

TEST_F(RemoteSessionTest, SaysHelloFirst) {
    ASSERT_EQ(port->sent.size(), 1u);
    EXPECT_EQ(take<farm::Hello>(FrameType::Hello).at(0).build(), "1.0-client");
    EXPECT_EQ(session->phase(), Phase::Greeting);
}

TEST_F(RemoteSessionTest, OpensTheJobAfterWelcome) {
    reach(Phase::Building);
    EXPECT_EQ(take<farm::OpenJob>(FrameType::OpenJob).at(0).job(), std::string(16, 'j'));
    EXPECT_EQ(session->welcome().device().name(), "Fake GPU");
    EXPECT_TRUE(coordinator->nodes().empty());
}

TEST_F(RemoteSessionTest, EndsWhereKernelsDiffer) {
    farm::Welcome other = welcome();
    other.set_kernel_hash(std::string(64, 'c'));
    receive(FrameType::Welcome, other);
    EXPECT_EQ(session->phase(), Phase::Ended);
    EXPECT_EQ(session->end().refusal, farm::Refusal::INCOMPATIBLE);
    EXPECT_NE(session->end().reason.find("1.0-client"), std::string::npos);
    EXPECT_NE(session->end().reason.find("1.1-server"), std::string::npos);
    EXPECT_EQ(port->closed, session->end().reason);
    EXPECT_TRUE(take<farm::OpenJob>(FrameType::OpenJob).empty());
}

TEST_F(RemoteSessionTest, EndsWhereProtocolsDiffer) {
    farm::Welcome other = welcome();
    other.set_protocol(wire::protocolVersion + 1);
    receive(FrameType::Welcome, other);
    EXPECT_EQ(session->end().refusal, farm::Refusal::INCOMPATIBLE);
    EXPECT_NE(session->end().reason.find("protocol " + std::to_string(wire::protocolVersion + 1)), std::string::npos);
}

TEST_F(RemoteSessionTest, WaitsForWelcomeNoLongerThanAllowed) {
    for (; now <= start + context->liveness.helloSeconds; ++now) {
        receive(FrameType::Heartbeat, farm::Heartbeat());
        session->tick(now);
        ASSERT_EQ(session->phase(), Phase::Greeting);
    }
    session->tick(now);
    EXPECT_EQ(session->phase(), Phase::Ended);
    EXPECT_EQ(port->closed, "The server has not answered within 10 s.");
}

TEST_F(RemoteSessionTest, EndsAfterSilence) {
    reach(Phase::Ready);
    now += context->liveness.silenceSeconds;
    session->tick(now);
    ASSERT_EQ(session->phase(), Phase::Ready);
    session->tick(now += 0.6);
    EXPECT_EQ(session->phase(), Phase::Ended);
    EXPECT_EQ(port->closed, "The server has been silent for 11 s.");
    EXPECT_EQ(coordinator->nodes().at(0).state, NodeStatus::State::Gone);
}

TEST_F(RemoteSessionTest, HeartbeatsGoOutWhileNothingIsQueued) {
    reach(Phase::Building);
    for (int i = 0; i < 40; ++i, now += 0.25) session->tick(now);
    EXPECT_EQ(take<farm::Heartbeat>(FrameType::Heartbeat).size(), 4u);
    port->queued = 1;
    receive(FrameType::Heartbeat, farm::Heartbeat());
    for (int i = 0; i < 39; ++i, now += 0.25) session->tick(now);
    EXPECT_TRUE(take<farm::Heartbeat>(FrameType::Heartbeat).empty());
}

TEST_F(RemoteSessionTest, EndsWhereTheServerDoesNotRead) {
    reach(Phase::Ready);
    port->queued = (8 << 20) + 1;
    session->tick(now);
    EXPECT_EQ(port->closed, "The server does not read what it is sent.");
}

// ---- Upload

TEST_F(RemoteSessionTest, UploadsWhatIsNeededFromItsOffset) {
    reach(Phase::Building);
    const uint64_t offset = 12345, size = scene.blobs[1].reference.size();
    receive(FrameType::NeedBlobs, need(1, offset));
    EXPECT_EQ(session->phase(), Phase::Building);
    EXPECT_EQ(session->uploadBytes(), size - offset);
    EXPECT_EQ(session->uploadedBytes(), size - offset);
    uint64_t next = offset;
    for (const wire::Frame& frame : port->sent) {
        if (frame.type != FrameType::BlobChunk) continue;
        const auto chunk = wire::parseMessage<farm::BlobChunk>(frame);
        EXPECT_EQ(chunk.sha256(), scene.blobs[1].reference.sha256());
        EXPECT_EQ(chunk.offset(), next);
        EXPECT_LE(frame.payload.size(), 64u << 10);
        EXPECT_EQ(frame.payload, scene.blobs[1].bytes->substr(next, frame.payload.size()));
        next += frame.payload.size();
    }
    EXPECT_EQ(next, size);
}

TEST_F(RemoteSessionTest, UploadsOnlyWhileTheQueueIsShort) {
    reach(Phase::Uploading);
    EXPECT_EQ(session->uploadedBytes(), 0u);
    port->queued = 4 << 20;
    session->tick(now);
    EXPECT_EQ(session->uploadedBytes(), 0u);
    port->queued = 0;
    session->tick(now);
    EXPECT_EQ(session->uploadedBytes(), session->uploadBytes());
    EXPECT_EQ(session->phase(), Phase::Building);
}

TEST_F(RemoteSessionTest, UploadEndsWhereTheServerIsReadyWithoutIt) {
    reach(Phase::Uploading);
    receive(FrameType::JobReady, jobReady());
    session->tick(now);
    EXPECT_EQ(session->phase(), Phase::Ready);
    EXPECT_EQ(session->uploadedBytes(), 0u);
}

TEST_F(RemoteSessionTest, ABlobMayBeNeededAgainButNotForEver) {
    reach(Phase::Building);
    for (int i = 0; i < 8; ++i) receive(FrameType::NeedBlobs, need(0));
    EXPECT_THROW(receive(FrameType::NeedBlobs, need(0)), wire::ProtocolError);
}

// ---- The job

TEST_F(RemoteSessionTest, EndsWhereTheMergeRadiusDiffersInItsLastBit) {
    reach(Phase::Building);
    farm::JobReady ready = jobReady();
    ready.set_initial_radius(std::nextafter(*settings.initialRadius, 1.0));
    receive(FrameType::JobReady, ready);
    EXPECT_EQ(session->end().refusal, farm::Refusal::INCOMPATIBLE);
    EXPECT_FALSE(session->end().wasReady);
    EXPECT_TRUE(coordinator->nodes().empty());
}

TEST_F(RemoteSessionTest, BecomesANodeWhenTheJobIsReady) {
    reach(Phase::Ready);
    ASSERT_EQ(coordinator->nodes().size(), 1u);
    const NodeDescription node = coordinator->nodes()[0].description;
    EXPECT_EQ(node.name, "server:1");
    EXPECT_EQ(node.deviceName, "Fake GPU");
    EXPECT_EQ(node.deviceClass, "fake");
    EXPECT_EQ(node.leaseDepth, 2u);
    EXPECT_TRUE(session->end().wasReady);
}

TEST_F(RemoteSessionTest, LeaseDepthIsBounded) {
    farm::Welcome deep = welcome();
    deep.set_lease_depth(1000000);
    receive(FrameType::Welcome, deep);
    receive(FrameType::JobReady, jobReady());
    EXPECT_EQ(coordinator->nodes().at(0).description.leaseDepth, 8u);
}

TEST_F(RemoteSessionTest, ARelayRendersAsItsServersDoAndSaysHowManyItHas) {
    reach(Phase::Building);
    farm::JobReady ready = jobReady();
    ready.set_renderings("GPU of its servers");
    ready.set_width(0);
    receive(FrameType::JobReady, ready);
    EXPECT_EQ(coordinator->nodes().at(0).description.deviceClass, "GPU of its servers");
    EXPECT_TRUE(leases().empty()) << "it has no server for now";
    farm::Capacity capacity;
    capacity.set_width(8);
    receive(FrameType::Capacity, capacity);
    const auto granted = leases();
    ASSERT_FALSE(granted.empty());
    EXPECT_EQ(granted.front().count(), 8u);
}

TEST_F(RemoteSessionTest, LeasesAsManyAsTheServerHolds) {
    reach(Phase::Ready);
    const auto granted = leases();
    ASSERT_EQ(granted.size(), 2u);
    EXPECT_NE(granted[0].lease(), granted[1].lease());
    EXPECT_TRUE(test::isDyadic(rangeOf(granted[0])));
    coordinator->stop(now);
    EXPECT_FALSE(take<farm::Truncate>(FrameType::Truncate).empty());
}

TEST_F(RemoteSessionTest, ReturnedLeasesGoToThePool) {
    reach(Phase::Ready);
    const auto granted = leases();
    farm::LeaseReturned returned;
    returned.set_lease(granted.at(0).lease());
    receive(FrameType::LeaseReturned, returned);
    EXPECT_EQ(coordinator->outstanding(), granted.size() - 1);
}

// ---- Results

TEST_F(RemoteSessionTest, ResultsAreCommitted) {
    reach(Phase::Ready);
    const auto granted = leases();
    deliver(offer(granted.at(0).lease(), rangeOf(granted[0])));
    EXPECT_EQ(verdict(), farm::ResultVerdict::COMMITTED);
    EXPECT_EQ(coordinator->sums().sha256(), fakeSums(settings, {rangeOf(granted[0])}).sha256());
    EXPECT_EQ(budget.taken(), 0u);
}

TEST_F(RemoteSessionTest, ResultsBringTheirEvents) {
    reach(Phase::Ready);
    const auto granted = leases();
    EventCounts events;
    events.at(EventSource::Connection, EventKind::NonFinite) = 5;
    farm::ResultOffer counted = offer(granted.at(0).lease(), rangeOf(granted[0]));
    *counted.mutable_events() = wire::toMessage(events);
    deliver(counted);
    EXPECT_EQ(verdict(), farm::ResultVerdict::COMMITTED);
    EXPECT_EQ(coordinator->sums().events, events);
}

TEST_F(RemoteSessionTest, ResultsAreNotFetchedWhereTheyAreNotNeeded) {
    reach(Phase::Ready);
    leases();
    receive(FrameType::ResultOffer, offer(4711, {0, 1}));
    EXPECT_EQ(verdict(), farm::ResultVerdict::NOT_NEEDED);
    EXPECT_TRUE(take<farm::ResultCredit>(FrameType::ResultCredit).empty());
}

TEST_F(RemoteSessionTest, ResultsThatDoNotMatchTheirHashAreRejected) {
    reach(Phase::Ready);
    const auto granted = leases();
    farm::ResultOffer wrong = offer(granted.at(0).lease(), rangeOf(granted[0]));
    wrong.set_sha256(std::string(32, 'x'));
    deliver(wrong);
    EXPECT_EQ(verdict(), farm::ResultVerdict::REJECTED);
    EXPECT_TRUE(coordinator->committed().empty());
    EXPECT_EQ(budget.taken(), 0u);
}

TEST_F(RemoteSessionTest, ResultsOfAnEarlierConnectionAreCommitted) {
    reach(Phase::Ready);
    const auto granted = leases();
    disconnect();
    connect();
    reach(Phase::Ready);
    deliver(offer(granted.at(0).lease(), rangeOf(granted[0])));
    EXPECT_EQ(verdict(), farm::ResultVerdict::COMMITTED);
}

TEST_F(RemoteSessionTest, ResultsWaitForTheirShareOfTheBudget) {
    reach(Phase::Ready);
    const auto granted = leases();
    ASSERT_TRUE(budget.tryTake(1));
    receive(FrameType::ResultOffer, offer(granted.at(0).lease(), rangeOf(granted[0])));
    session->tick(now);
    EXPECT_TRUE(take<farm::ResultCredit>(FrameType::ResultCredit).empty());
    budget.give(1);
    session->tick(now);
    EXPECT_EQ(take<farm::ResultCredit>(FrameType::ResultCredit).size(), 1u);
    EXPECT_EQ(budget.taken(), uint64_t(settings.width) * settings.height * 24);
}

TEST_F(RemoteSessionTest, ResultsAreFetchedOneAfterTheOther) {
    reach(Phase::Ready);
    const auto granted = leases();
    const farm::ResultOffer first = offer(granted.at(0).lease(), rangeOf(granted[0]));
    const farm::ResultOffer second = offer(granted.at(1).lease(), rangeOf(granted[1]));
    receive(FrameType::ResultOffer, first);
    receive(FrameType::ResultOffer, second);
    auto credits = take<farm::ResultCredit>(FrameType::ResultCredit);
    ASSERT_EQ(credits.size(), 1u);
    EXPECT_EQ(credits[0].lease(), first.lease());
    receive(chunk(first, 0, first.lease()));
    EXPECT_EQ(verdict(), farm::ResultVerdict::COMMITTED);
    credits = take<farm::ResultCredit>(FrameType::ResultCredit);
    ASSERT_EQ(credits.size(), 1u);
    EXPECT_EQ(credits[0].lease(), second.lease());
}

TEST_F(RemoteSessionTest, DisconnectionGivesTheBudgetAndTheLeasesBack) {
    reach(Phase::Ready);
    const auto granted = leases();
    receive(FrameType::ResultOffer, offer(granted.at(0).lease(), rangeOf(granted[0])));
    EXPECT_GT(budget.taken(), 0u);
    disconnect();
    EXPECT_EQ(budget.taken(), 0u);
    EXPECT_EQ(session->end().reason, "connection reset by peer");
    EXPECT_EQ(coordinator->nodes().at(0).state, NodeStatus::State::Gone);
}

TEST_F(RemoteSessionTest, ResultsThatAreOfferedButNeverSentEndTheConnection) {
    reach(Phase::Ready);
    const auto granted = leases();
    receive(FrameType::ResultOffer, offer(granted.at(0).lease(), rangeOf(granted[0])));
    for (; now < start + 60 && session->phase() == Phase::Ready; ++now) {
        receive(FrameType::Heartbeat, farm::Heartbeat());
        session->tick(now);
    }
    EXPECT_EQ(session->phase(), Phase::Ended);
    EXPECT_EQ(now, start + 32);
    EXPECT_EQ(budget.taken(), 0u);
}

TEST_F(LargeFilm, CreditsAreReplenishedWithinTheirWindow) {
    reach(Phase::Ready);
    const auto granted = leases();
    const farm::ResultOffer large = offer(granted.at(0).lease(), rangeOf(granted[0]));
    ASSERT_EQ(large.chunks(), 66u);
    receive(FrameType::ResultOffer, large);
    uint32_t credited = 0;
    for (uint32_t i = 0; i < large.chunks(); ++i) {
        for (const auto& credit : take<farm::ResultCredit>(FrameType::ResultCredit)) credited += credit.chunks();
        EXPECT_GT(credited, i);
        EXPECT_LE(credited, std::min(i + 64, large.chunks()));
        receive(chunk(large, i, large.lease()));
    }
    EXPECT_EQ(verdict(), farm::ResultVerdict::COMMITTED);
}

TEST_F(LargeFilm, ChunksWithoutCreditAreAnError) {
    reach(Phase::Ready);
    const auto granted = leases();
    const farm::ResultOffer large = offer(granted.at(0).lease(), rangeOf(granted[0]));
    ASSERT_TRUE(budget.tryTake(1));
    receive(FrameType::ResultOffer, large);
    EXPECT_THROW(receive(chunk(large, 0, large.lease())), wire::ProtocolError);
}

// ---- The end

TEST_F(RemoteSessionTest, DrainingServersGetNoLeasesButTheirResultsAreFetched) {
    reach(Phase::Ready);
    const auto granted = leases();
    receive(FrameType::Draining, farm::Draining());
    deliver(offer(granted.at(0).lease(), {granted[0].first(), 1}));
    EXPECT_EQ(verdict(), farm::ResultVerdict::COMMITTED);
    farm::LeaseReturned returned;
    returned.set_lease(granted.at(1).lease());
    receive(FrameType::LeaseReturned, returned);
    EXPECT_TRUE(leases().empty());
    EXPECT_EQ(session->phase(), Phase::Ready);
}

TEST_F(RemoteSessionTest, ServersThatDrainBeforeTheyAreReadyGetNoLeases) {
    reach(Phase::Building);
    receive(FrameType::Draining, farm::Draining());
    receive(FrameType::JobReady, jobReady());
    EXPECT_TRUE(leases().empty());
}

TEST_F(RemoteSessionTest, RefusalsEndInEveryPhase) {
    for (const Phase phase : {Phase::Greeting, Phase::Uploading, Phase::Building, Phase::Ready}) {
        connect();
        reach(phase);
        farm::Refusal refusal;
        refusal.set_code(farm::Refusal::BUSY);
        refusal.set_sentence("Too many jobs;\x1b[2J come back later.");
        receive(FrameType::Refusal, refusal);
        EXPECT_EQ(session->phase(), Phase::Ended);
        EXPECT_EQ(session->end().refusal, farm::Refusal::BUSY);
        EXPECT_EQ(session->end().reason, "Too many jobs;?[2J come back later.");
        EXPECT_EQ(session->end().wasReady, phase == Phase::Ready);
        EXPECT_TRUE(port->closed);
    }
}

TEST_F(RemoteSessionTest, FinishClosesTheJobThenTheConnection) {
    reach(Phase::Ready);
    session->finish();
    EXPECT_EQ(port->sent.back().type, FrameType::CloseJob);
    EXPECT_TRUE(port->closed);
    EXPECT_EQ(session->phase(), Phase::Ended);
}

TEST_F(RemoteSessionTest, NothingIsHeardAfterTheEnd) {
    reach(Phase::Ready);
    const auto granted = leases();
    session->finish();
    port->sent.clear();
    EXPECT_NO_THROW(deliver(offer(granted.at(0).lease(), rangeOf(granted[0]))));
    session->tick(now + 100);
    disconnect();
    EXPECT_TRUE(port->sent.empty());
    EXPECT_TRUE(coordinator->committed().empty());
    EXPECT_EQ(session->end().reason, "The job is finished.");
}
