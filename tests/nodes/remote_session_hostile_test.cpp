// What a server must not say: each message ends the connection, whatever the phase, and costs nothing else.
#include <functional>
#include <limits>
#include <set>

#include "tests/nodes/remote_session_fixture.h"

using namespace antipode;
using namespace antipode::test;
using wire::FrameType;
using Phase = RemoteSession::Phase;

namespace {

constexpr uint64_t most = std::numeric_limits<uint64_t>::max();

}  // namespace

class HostileServer : public RemoteSessionTest {
protected:
    void expectRefused(const std::string& what, const wire::Frame& frame) {
        EXPECT_THROW(receive(frame), wire::ProtocolError) << what;
        disconnect();
        EXPECT_EQ(budget.taken(), 0u) << what;
        EXPECT_TRUE(coordinator->committed().empty()) << what;
        connect();
    }

    /// Every change of a valid message, each on a connection of its own that has reached the phase.
    template <class Message>
    void expectRefused(Phase phase, FrameType type, const std::function<Message()>& valid,
                       const std::vector<std::pair<const char*, void (*)(Message&)>>& changes) {
        for (const auto& [name, change] : changes) {
            reach(phase);
            Message message = valid();
            change(message);
            expectRefused(name, wire::makeFrame(type, message));
        }
        reach(phase);
        EXPECT_NO_THROW(receive(type, valid()));
    }

    farm::LeaseGrant leased() { return leases().at(0); }
};

TEST_F(HostileServer, MessagesThatDoNotBelongToThePhase) {
    const std::map<Phase, std::set<FrameType>> expected = {
        {Phase::Greeting, {FrameType::Welcome}},
        {Phase::Uploading, {FrameType::NeedBlobs, FrameType::JobReady, FrameType::Draining}},
        {Phase::Building, {FrameType::NeedBlobs, FrameType::JobReady, FrameType::Draining}},
        {Phase::Ready,
         {FrameType::Progress, FrameType::LeaseReturned, FrameType::ResultOffer, FrameType::ResultChunk,
          FrameType::Draining, FrameType::Capacity}},
    };
    for (const auto& [phase, types] : expected)
        for (int type = int(FrameType::Hello); type <= int(FrameType::Capacity); ++type) {
            const FrameType frameType{uint16_t(type)};
            if (types.contains(frameType) || frameType == FrameType::Heartbeat || frameType == FrameType::Refusal)
                continue;
            reach(phase);
            expectRefused("type " + std::to_string(type) + " in phase " + std::to_string(int(phase)),
                          {frameType, "", ""});
        }
}

TEST_F(HostileServer, BytesThatAreNoMessage) {
    const std::map<Phase, FrameType> types = {{Phase::Greeting, FrameType::Welcome},
                                              {Phase::Building, FrameType::NeedBlobs},
                                              {Phase::Uploading, FrameType::JobReady},
                                              {Phase::Ready, FrameType::ResultOffer}};
    for (const auto& [phase, type] : types) {
        reach(phase);
        expectRefused("garbage in phase " + std::to_string(int(phase)), {type, "\xff\xff\xff garbage", ""});
        reach(phase);
        expectRefused("refusal with a payload", {FrameType::Refusal, "", "payload"});
        reach(phase);
        expectRefused("heartbeat of garbage", {FrameType::Heartbeat, "\xff", ""});
    }
}

TEST_F(HostileServer, ClassesOfARelayThatNobodyCanRead) {
    for (const std::string& renderings : {std::string(257, 'x'), std::string("GPU\x1b[2J")}) {
        reach(Phase::Building);
        farm::JobReady ready = jobReady();
        ready.set_renderings(renderings);
        expectRefused(renderings.substr(0, 10), wire::makeFrame(FrameType::JobReady, ready));
    }
}

TEST_F(HostileServer, Welcome) {
    expectRefused<farm::Welcome>(
        Phase::Greeting, FrameType::Welcome, [this] { return welcome(); },
        {{"long build", [](farm::Welcome& m) { m.set_build(std::string(257, 'x')); }},
         {"long kernel hash", [](farm::Welcome& m) { m.set_kernel_hash(std::string(1000, 'x')); }},
         {"long device", [](farm::Welcome& m) { m.mutable_device()->set_name(std::string(500000, 'x')); }},
         {"escape sequence", [](farm::Welcome& m) { m.mutable_device()->set_name("GPU\x1b[2J"); }},
         {"line break", [](farm::Welcome& m) { m.mutable_device()->set_driver("a\nb"); }},
         {"long kind", [](farm::Welcome& m) { m.mutable_device()->set_kind(std::string(257, 'x')); }},
         {"long class", [](farm::Welcome& m) { m.mutable_device()->set_device_class(std::string(257, 'x')); }},
         {"no class", [](farm::Welcome& m) { m.mutable_device()->clear_device_class(); }},
         {"no leases", [](farm::Welcome& m) { m.set_lease_depth(0); }}});
}

TEST_F(HostileServer, NeedBlobs) {
    expectRefused<farm::NeedBlobs>(
        Phase::Building, FrameType::NeedBlobs, [this] { return need(1, 5); },
        {{"nothing", [](farm::NeedBlobs& m) { m.clear_need(); }},
         {"another blob",
          [](farm::NeedBlobs& m) { m.mutable_need(0)->mutable_blob()->set_sha256(std::string(32, 'x')); }},
         {"no hash", [](farm::NeedBlobs& m) { m.mutable_need(0)->mutable_blob()->clear_sha256(); }},
         {"another size", [](farm::NeedBlobs& m) { m.mutable_need(0)->mutable_blob()->set_size(6); }},
         {"offset at the end", [](farm::NeedBlobs& m) { m.mutable_need(0)->set_offset(m.need(0).blob().size()); }},
         {"offset beyond", [](farm::NeedBlobs& m) { m.mutable_need(0)->set_offset(most); }},
         {"twice", [](farm::NeedBlobs& m) { m.add_need()->CopyFrom(m.need(0)); }},
         {"too many", [](farm::NeedBlobs& m) {
              while (m.need_size() <= 1024) m.add_need()->CopyFrom(m.need(0));
          }}});
}

TEST_F(HostileServer, ProgressBeyondTheLease) {
    reach(Phase::Ready);
    const farm::LeaseGrant lease = leased();
    farm::Progress progress;
    progress.set_lease(lease.lease());
    progress.set_done(lease.count() + 1);
    expectRefused("progress", wire::makeFrame(FrameType::Progress, progress));
}

TEST_F(HostileServer, ProgressAndReturnOfLeasesThatNeverWereChangeNothing) {
    reach(Phase::Ready);
    leased();
    const uint32_t outstanding = coordinator->outstanding();
    farm::Progress progress;
    progress.set_lease(4711);
    progress.set_done(most);
    receive(FrameType::Progress, progress);
    farm::LeaseReturned returned;
    returned.set_lease(4711);
    receive(FrameType::LeaseReturned, returned);
    EXPECT_EQ(coordinator->outstanding(), outstanding);
}

TEST_F(HostileServer, ResultOffer) {
    const auto valid = [this] {
        const farm::LeaseGrant lease = leased();
        return offer(lease.lease(), {lease.first(), lease.count()});
    };
    using Offer = farm::ResultOffer;
    expectRefused<Offer>(
        Phase::Ready, FrameType::ResultOffer, valid,
        {{"other iterations", [](Offer& m) { m.set_first(m.first() + 1); }},
         {"more iterations", [](Offer& m) { m.set_count(m.count() + 1); }},
         {"no iteration", [](Offer& m) { m.set_count(0); }},
         {"all iterations", [](Offer& m) { m.set_count(most); }},
         {"iterations that overflow", [](Offer& m) { m.set_lease(4711), m.set_first(most), m.set_count(2); }},
         {"short hash", [](Offer& m) { m.set_sha256(std::string(31, 'x')); }},
         {"long hash", [](Offer& m) { m.set_sha256(std::string(33, 'x')); }},
         {"another width", [](Offer& m) { m.set_width(m.width() * 1000); }},
         {"another height", [](Offer& m) { m.set_height(0); }},
         {"scale", [](Offer& m) { m.set_scale_exponent(0, std::numeric_limits<int32_t>::min()); }},
         {"no chunks", [](Offer& m) { m.set_chunks(0); }},
         {"more chunks", [](Offer& m) { m.set_chunks(m.chunks() + 1); }},
         {"negative time", [](Offer& m) { m.set_seconds(-1); }},
         {"time that is none", [](Offer& m) { m.set_seconds(std::numeric_limits<double>::quiet_NaN()); }},
         {"infinite time", [](Offer& m) { m.set_seconds(std::numeric_limits<double>::infinity()); }},
         {"infinite stage",
          [](Offer& m) { m.mutable_statistics()->add_stage()->set_seconds(std::numeric_limits<double>::infinity()); }},
         {"escape sequence", [](Offer& m) { m.mutable_statistics()->add_stage()->set_stage("\x1b[2J"); }},
         {"events from nowhere",
          [](Offer& m) {
              m.mutable_events()->add_entry()->set_source(eventSources);
              m.mutable_events()->mutable_entry(0)->set_count(1);
          }},
         {"events that did not happen", [](Offer& m) { m.mutable_events()->add_entry(); }},
         {"events counted twice",
          [](Offer& m) {
              for (int i = 0; i < 2; ++i) m.mutable_events()->add_entry()->set_count(1);
          }},
         {"stages without end", [](Offer& m) {
              while (m.statistics().stage_size() <= 64) m.mutable_statistics()->add_stage();
          }}});
}

TEST_F(HostileServer, EventsAreCheckedBeforeTheResultHasToWait) {
    reach(Phase::Ready);
    const farm::LeaseGrant lease = leased();
    farm::ResultOffer wrong = offer(lease.lease(), {lease.first(), lease.count()});
    wrong.mutable_events()->add_entry();
    ASSERT_TRUE(budget.tryTake(1)) << "so that the result cannot be fetched yet";
    EXPECT_THROW(receive(FrameType::ResultOffer, wrong), wire::ProtocolError);
}

TEST_F(HostileServer, ResultChunk) {
    const std::vector<std::pair<const char*, std::function<void(wire::Frame&, farm::ResultChunk&)>>> changes = {
        {"another lease", [](wire::Frame&, farm::ResultChunk& m) { m.set_lease(m.lease() + 4711); }},
        {"out of order", [](wire::Frame&, farm::ResultChunk& m) { m.set_index(1); }},
        {"far out of order", [](wire::Frame&, farm::ResultChunk& m) { m.set_index(0xffffffff); }},
        {"no payload", [](wire::Frame& f, farm::ResultChunk&) { f.payload.clear(); }},
        {"garbage", [](wire::Frame& f, farm::ResultChunk&) { f.payload = std::string(1 << 20, 'x'); }},
        {"truncated", [](wire::Frame& f, farm::ResultChunk&) { f.payload.pop_back(); }},
    };
    for (const auto& [name, change] : changes) {
        reach(Phase::Ready);
        const farm::LeaseGrant lease = leased();
        const farm::ResultOffer valid = offer(lease.lease(), {lease.first(), lease.count()});
        receive(FrameType::ResultOffer, valid);
        wire::Frame frame = chunk(valid, 0, valid.lease());
        auto message = wire::parseMessage<farm::ResultChunk>(frame);
        change(frame, message);
        expectRefused(name, wire::makeFrame(FrameType::ResultChunk, message, frame.payload));
    }
}

TEST_F(HostileServer, ChunkOfAResultThatWasNeverOffered) {
    reach(Phase::Ready);
    const farm::LeaseGrant lease = leased();
    expectRefused("chunk", chunk(offer(lease.lease(), {lease.first(), 1}), 0, lease.lease()));
}

TEST_F(HostileServer, OfferTwice) {
    reach(Phase::Ready);
    const farm::LeaseGrant lease = leased();
    const farm::ResultOffer valid = offer(lease.lease(), {lease.first(), lease.count()});
    receive(FrameType::ResultOffer, valid);
    expectRefused("offer", wire::makeFrame(FrameType::ResultOffer, valid));
}

TEST_F(HostileServer, ReturnOfAnOfferedLease) {
    reach(Phase::Ready);
    const farm::LeaseGrant lease = leased();
    receive(FrameType::ResultOffer, offer(lease.lease(), {lease.first(), lease.count()}));
    farm::LeaseReturned returned;
    returned.set_lease(lease.lease());
    expectRefused("return", wire::makeFrame(FrameType::LeaseReturned, returned));
}
