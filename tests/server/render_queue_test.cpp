#include "server/render_queue.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "proto/wire/frame.h"
#include "proto/wire/job_messages.h"
#include "tests/server/stepped_worker.h"
#include "tests/support/fake_renderer.h"

namespace antipode::test {
namespace {

using Log = std::vector<std::string>;

/// A connection of a job that writes down what it hears, progress apart.
struct Listener : JobListener {
    void jobReady(const JobReady&) override { log.push_back("ready"); }
    void jobFailed(const Error& error) override { log.push_back(std::string("failed: ") + error.what()); }
    void progress(uint64_t lease, uint64_t done) override { lastProgress = {lease, done}; }
    void resultReady(uint64_t lease) override { log.push_back("result " + std::to_string(lease)); }
    void leaseReturned(uint64_t lease, const std::string& reason) override {
        log.push_back("returned " + std::to_string(lease) + (reason.empty() ? "" : ": " + reason));
    }
    void widthChanged(uint32_t width) override { log.push_back("width " + std::to_string(width)); }
    void jobTaken() override { log.push_back("taken"); }
    Log take() { return std::exchange(log, {}); }

    Log log;
    std::pair<uint64_t, uint64_t> lastProgress;
};

farm::JobSettings settingsOf(uint64_t seed, uint32_t width = 4, uint32_t height = 2) {
    RenderSettings settings;
    settings.width = width;
    settings.height = height;
    settings.seed = seed;
    settings.initialRadius = 0.25;
    return wire::toMessage(settings);
}

constexpr uint64_t jobBytes = 1000;

class RenderQueueTest : public ::testing::Test {
protected:
    void start(RenderQueueLimits limits = {}) { queue.emplace(worker, limits, loop.post()); }

    static constexpr uint64_t sceneBytes = 1000;

    void open(uint64_t seed, Listener& listener) {
        EXPECT_FALSE(queue->open(name(seed), settingsOf(seed), "hash", scene, jobBytes, sceneBytes, listener));
    }
    /// UNKNOWN where the job was opened.
    farm::Refusal::Code refusalOf(uint64_t seed, Listener& listener, const farm::JobSettings& settings,
                                  const std::string& sceneHash = "hash") {
        const auto refused = queue->open(name(seed), settings, sceneHash, scene, jobBytes, sceneBytes, listener);
        return refused ? refused->code() : farm::Refusal::UNKNOWN;
    }
    /// Opens the job and builds it.
    void openReady(uint64_t seed, Listener& listener) {
        open(seed, listener);
        run();
        listener.log.clear();
    }
    void run() {
        do loop.run();
        while (worker.step());
    }
    void step(int steps = 1) {
        for (int i = 0; i < steps; ++i) {
            worker.step();
            loop.run();
        }
    }
    static std::string name(uint64_t seed) { return "job" + std::to_string(seed); }

    CallLoop loop;
    SteppedWorker worker{fakeRenderers()};
    std::shared_ptr<const Scene> scene = std::make_shared<const Scene>(tinyScene());
    std::optional<RenderQueue> queue;
    Listener a, b, c;
};

TEST_F(RenderQueueTest, RendersALeaseAndKeepsItsResultUntilItIsSettled) {
    start();
    open(1, a);
    EXPECT_TRUE(a.log.empty());
    run();
    EXPECT_EQ(a.take(), Log{"ready"});
    queue->lease(name(1), 5, {8, 4});
    EXPECT_FALSE(queue->settled(name(1)));
    run();
    EXPECT_EQ(a.take(), Log{"result 5"});
    EXPECT_EQ(a.lastProgress, std::pair(uint64_t(5), uint64_t(4)));
    const auto result = queue->result(name(1), 5);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->range, (IterationRange{8, 4}));
    EXPECT_EQ(result->sums.values, fakeSums(wire::fromMessage(settingsOf(1)), {{8, 4}}).values);
    EXPECT_FALSE(queue->idle());
    EXPECT_EQ(queue->totals().waitingResults, 1u);
    queue->settle(name(1), 5);
    EXPECT_FALSE(queue->result(name(1), 5));
    EXPECT_TRUE(queue->settled(name(1)));
    EXPECT_TRUE(queue->idle());
    EXPECT_EQ(queue->totals().iterations, 4u);
    EXPECT_EQ(queue->totals().blocks, 1u);
    EXPECT_EQ(queue->totals().busySeconds, 4.5);
}

TEST_F(RenderQueueTest, AClientThatKeepsLeaseDepthUnansweredLeasesNeverWaits) {
    start();
    openReady(1, a);
    uint64_t next = 1;
    for (; next <= 2; ++next) queue->lease(name(1), next, {next, 1});
    for (int i = 0; i < 20; ++i) {
        worker.step();
        loop.run();
        ASSERT_EQ(a.take().size(), 1u);
        EXPECT_EQ(worker.pending(), 1u) << "the device is idle";
        queue->lease(name(1), next, {next, 1});  // the answer makes room, before the result is fetched
        queue->settle(name(1), next - 2);
        ++next;
    }
}

TEST_F(RenderQueueTest, RefusesImpossibleLeases) {
    start();
    open(1, a);
    EXPECT_THROW(queue->lease(name(1), 1, {0, 1}), wire::ProtocolError);  // not ready
    EXPECT_THROW(queue->lease(name(2), 1, {0, 1}), wire::ProtocolError);  // no job
    run();
    const uint64_t most = 1ull << 40;
    for (const IterationRange& range :
         {IterationRange{0, 0}, {most, 1}, {0, most + 1}, {1, most}, {UINT64_MAX, 2}, {2, UINT64_MAX}})
        EXPECT_THROW(queue->lease(name(1), 1, range), wire::ProtocolError) << range.first << " " << range.count;
    EXPECT_THROW(queue->lease(name(1), UINT64_MAX, {0, 1}), wire::ProtocolError);
    queue->lease(name(1), 7, {most - 1, 1});
    EXPECT_THROW(queue->lease(name(1), 7, {0, 1}), wire::ProtocolError);
    EXPECT_THROW(queue->lease(name(1), 6, {0, 1}), wire::ProtocolError);
    queue->lease(name(1), 8, {0, 1});
    EXPECT_THROW(queue->lease(name(1), 9, {0, 1}), wire::ProtocolError);  // too many
}

TEST_F(RenderQueueTest, ASlowClientStopsOnlyItself) {
    start();
    openReady(1, a);
    openReady(2, b);
    uint64_t lease = 0;
    for (int i = 0; i < 20; ++i) {
        ++lease;
        // The first job grants whenever it is answered, and never settles.
        if (i < 4) queue->lease(name(1), lease, {lease, 1});
        queue->lease(name(2), lease, {lease, 1});
        run();
        queue->settle(name(2), lease);
    }
    EXPECT_EQ(worker.secondsOf(1), 2);
    EXPECT_EQ(worker.secondsOf(2), 20);
    EXPECT_EQ(queue->totals().waitingResults, 2u);
    queue->settle(name(1), 1);
    run();
    EXPECT_EQ(worker.secondsOf(1), 3);
}

/// Runs jobs that always have leaseDepth leases for so many steps and settles at once.
void serve(RenderQueue& queue, SteppedWorker& worker, CallLoop& loop, std::vector<Listener*> listeners,
           const std::vector<uint64_t>& blockSizes, int steps, uint64_t firstLease = 1) {
    std::vector<uint64_t> next(listeners.size(), firstLease);
    const auto grant = [&](size_t i) {
        queue.lease("job" + std::to_string(i + 1), next[i], {next[i] * 64, blockSizes[i]});
        ++next[i];
    };
    for (size_t i = 0; i < listeners.size(); ++i) grant(i), grant(i);
    for (int step = 0; step < steps; ++step) {
        worker.step();
        loop.run();
        for (size_t i = 0; i < listeners.size(); ++i)
            for (const std::string& event : listeners[i]->take()) {
                queue.settle("job" + std::to_string(i + 1), std::stoull(event.substr(7)));
                grant(i);
            }
    }
}

TEST_F(RenderQueueTest, TwoClientsGetEqualShares) {
    start();
    openReady(1, a);
    openReady(2, b);
    serve(*queue, worker, loop, {&a, &b}, {8, 8}, 1000);
    EXPECT_NEAR(worker.secondsOf(1), worker.secondsOf(2), 8);
    EXPECT_NEAR(worker.secondsOf(1), 500, 8);
}

TEST_F(RenderQueueTest, ThreeClientsOfDifferentBlocksAndSpeedsGetEqualShares) {
    start();
    worker.secondsPerIteration = {{2, 3.0}, {3, 0.25}};
    openReady(1, a);
    openReady(2, b);
    openReady(3, c);
    serve(*queue, worker, loop, {&a, &b, &c}, {8, 2, 32}, 3000);
    EXPECT_NEAR(worker.secondsOf(1), worker.secondsOf(2), 8);
    EXPECT_NEAR(worker.secondsOf(1), worker.secondsOf(3), 8);
    EXPECT_GT(worker.secondsOf(1), 100);
}

TEST_F(RenderQueueTest, AJobThatComesNewOrWasAwayClaimsNothingForThePast) {
    start();
    openReady(1, a);
    openReady(2, b);
    // The second job renders one block and is away; the first renders for long.
    queue->lease(name(2), 1, {0, 1});
    run();
    queue->settle(name(2), 1);
    for (uint64_t lease = 1; lease <= 50; ++lease) {
        queue->lease(name(1), lease, {lease * 4, 4});
        run();
        queue->settle(name(1), lease);
    }
    openReady(3, c);
    worker.blocks.clear();
    a.take(), b.take(), c.take();
    serve(*queue, worker, loop, {&a, &b, &c}, {4, 4, 4}, 90, 100);
    EXPECT_NEAR(worker.secondsOf(1), 30, 4);
    EXPECT_NEAR(worker.secondsOf(2), 30, 4);
    EXPECT_NEAR(worker.secondsOf(3), 30, 4);
}

TEST_F(RenderQueueTest, CutsALongBlockShortOnlyWhenAnotherJobWaits) {
    start({.blockSeconds = 30});
    openReady(1, a);
    openReady(2, b);
    queue->lease(name(1), 1, {0, 1 << 20});
    step(3);
    queue->tick(100);
    queue->tick(1000);
    step(3);
    EXPECT_TRUE(a.take().empty());
    queue->lease(name(2), 1, {0, 1});
    queue->tick(1001);
    run();
    EXPECT_EQ(a.take(), Log{"result 1"});
    EXPECT_EQ(b.take(), Log{"result 1"});
    EXPECT_EQ(queue->result(name(1), 1)->range, (IterationRange{0, 6}));
}

TEST_F(RenderQueueTest, TruncatesTheBlockInHandOrReturnsWhatWaits) {
    start();
    openReady(1, a);
    queue->lease(name(1), 1, {0, 8});
    queue->lease(name(1), 2, {8, 8});
    step(3);
    queue->truncate(name(1), 2);
    EXPECT_EQ(a.take(), Log{"returned 2"});
    queue->truncate(name(1), 1);
    queue->truncate(name(1), 1);
    queue->truncate(name(1), 99);
    queue->truncate("other", 1);
    run();
    EXPECT_EQ(a.take(), Log{"result 1"});
    EXPECT_EQ(queue->result(name(1), 1)->range, (IterationRange{0, 3}));
    queue->lease(name(1), 3, {8, 8});
    queue->truncate(name(1), 3);  // before its first iteration
    run();
    EXPECT_EQ(a.take(), Log{"returned 3"});
}

TEST_F(RenderQueueTest, AReconnectFindsResultsAndTheBlockInHand) {
    start();
    openReady(1, a);
    queue->lease(name(1), 1, {0, 4});
    run();
    queue->lease(name(1), 2, {4, 4});
    queue->lease(name(1), 3, {8, 4});
    step(2);
    a.take();
    queue->detach(name(1), a, 10);
    EXPECT_TRUE(queue->knows(name(1)));
    open(1, b);
    EXPECT_EQ(b.take(), (Log{"ready", "result 1"}));
    // Two more are granted before any of the old ones is answered; rendering pauses at two unsettled results.
    queue->lease(name(1), 4, {12, 1});
    queue->lease(name(1), 5, {13, 1});
    EXPECT_THROW(queue->lease(name(1), 6, {14, 1}), wire::ProtocolError);
    run();
    EXPECT_EQ(b.take(), Log{"result 2"});
    EXPECT_EQ(queue->result(name(1), 2)->range, (IterationRange{4, 4}));
    EXPECT_FALSE(queue->result(name(1), 3)) << "leases that waited are forgotten";
    queue->settle(name(1), 1);
    queue->settle(name(1), 2);
    run();
    EXPECT_EQ(b.take(), (Log{"result 4", "result 5"}));
    EXPECT_TRUE(a.log.empty());
}

TEST_F(RenderQueueTest, ATakeoverSilencesTheOlderConnection) {
    start();
    openReady(1, a);
    queue->lease(name(1), 1, {0, 4});
    queue->lease(name(1), 2, {4, 4});
    open(1, b);
    EXPECT_EQ(a.take(), Log{"taken"});
    queue->detach(name(1), a, 0);  // too late to matter
    run();
    EXPECT_TRUE(a.log.empty());
    EXPECT_EQ(b.take(), (Log{"ready", "result 1"}));
}

TEST_F(RenderQueueTest, AKnownJobMustHaveTheSameSettingsAndScene) {
    start();
    openReady(1, a);
    EXPECT_EQ(refusalOf(1, b, settingsOf(2)), farm::Refusal::BAD_JOB);
    EXPECT_EQ(refusalOf(1, b, settingsOf(1), "hash2"), farm::Refusal::BAD_JOB);
    EXPECT_EQ(refusalOf(2, b, settingsOf(2, 0)), farm::Refusal::BAD_JOB) << "no engine takes it";
    EXPECT_TRUE(a.log.empty());
    EXPECT_TRUE(b.log.empty());
}

TEST_F(RenderQueueTest, OrphansAreClosedWhenTheirTimeIsUp) {
    start({.orphanSeconds = 120});
    openReady(1, a);
    queue->lease(name(1), 1, {0, 1});
    run();
    queue->lease(name(1), 2, {4, 4});
    queue->detach(name(1), a, 1000);
    queue->tick(1119);
    EXPECT_TRUE(queue->knows(name(1)));
    queue->tick(1120);
    EXPECT_FALSE(queue->knows(name(1)));
    run();
    EXPECT_EQ(worker.openJobs(), 0u);
    EXPECT_TRUE(queue->idle());
    EXPECT_EQ(queue->totals().waitingResults, 0u);
    // The same name is a new job then, and old blocks are not mistaken for its own.
    openReady(1, b);
    queue->lease(name(1), 1, {0, 1});
    run();
    EXPECT_EQ(b.take(), Log{"result 1"});
}

TEST_F(RenderQueueTest, ABlockOfAClosedJobIsNotMistakenForOneOfItsSuccessor) {
    start();
    openReady(1, a);
    queue->lease(name(1), 1, {0, 100});
    step(3);
    queue->close(name(1));
    open(1, b);
    run();
    EXPECT_EQ(b.take(), Log{"ready"});
    EXPECT_EQ(worker.openJobs(), 1u);
}

TEST_F(RenderQueueTest, ADeviceLostInMidBlockEndsAllJobs) {
    start();
    openReady(1, a);
    openReady(2, b);
    queue->lease(name(1), 1, {0, 4});
    queue->lease(name(1), 2, {4, 4});
    queue->lease(name(2), 1, {0, 1});
    step();
    worker.failNext = Error(ErrorCode::Device, "It burns.");
    run();
    const std::string why = "The server's device failed in the middle of a block: It burns.";
    EXPECT_EQ(a.take(), (Log{"returned 1: " + why, "returned 2: " + why, "failed: " + why}));
    EXPECT_EQ(b.take(), (Log{"returned 1: " + why, "failed: " + why}));
    EXPECT_FALSE(queue->knows(name(1)) || queue->knows(name(2)));
    EXPECT_EQ(queue->deviceLoss(), why);
    EXPECT_EQ(worker.openJobs(), 0u);
    const auto refused = queue->admission({.pixels = 8, .lightPaths = 8}, 1000);
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->code(), farm::Refusal::DEVICE_FAILED);
    EXPECT_EQ(refused->sentence(), why);
}

TEST_F(RenderQueueTest, AFailedBuildIsToldAndForgotten) {
    start();
    worker.failNext = Error(ErrorCode::Input, "No light.");
    open(1, a);
    run();
    EXPECT_EQ(a.take(), Log{"failed: No light."});
    EXPECT_FALSE(queue->knows(name(1)));
}

TEST_F(RenderQueueTest, TheScenesOfAllJobsHaveOneBound) {
    start({.sceneBytes = 2 * sceneBytes + 1});
    openReady(1, a);
    openReady(2, b);
    const auto refused = queue->open(name(3), settingsOf(3), "hash", scene, jobBytes, sceneBytes, c);
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->code(), farm::Refusal::BUSY);
    EXPECT_NE(refused->sentence().find("memory for scenes"), std::string::npos) << refused->sentence();
    queue->close(name(1));
    run();
    openReady(3, c);
}

TEST_F(RenderQueueTest, DrainsWithResultsStillToBeFetched) {
    start();
    openReady(1, a);
    queue->lease(name(1), 1, {0, 8});
    queue->lease(name(1), 2, {8, 8});
    step(2);
    queue->drain();
    EXPECT_EQ(a.take(), Log{"returned 2: The server is going down."});
    EXPECT_FALSE(queue->idle());
    run();
    EXPECT_EQ(a.take(), Log{"result 1"});
    queue->lease(name(1), 3, {16, 1});  // was on its way
    EXPECT_EQ(a.take(), Log{"returned 3: The server is going down."});
    EXPECT_EQ(queue->admission({}, 0)->code(), farm::Refusal::DRAINING);
    EXPECT_FALSE(queue->idle());
    queue->settle(name(1), 1);
    EXPECT_TRUE(queue->idle());
}

TEST_F(RenderQueueTest, DrainIsIdleWhereOnlyOrphansHaveResults) {
    start();
    openReady(1, a);
    queue->lease(name(1), 1, {0, 1});
    run();
    queue->detach(name(1), a, 0);
    queue->drain();
    EXPECT_TRUE(queue->idle());
}

farm::Refusal::Code admissionCode(const RenderQueue& queue, const JobSize& size, uint64_t sceneBytes = 0) {
    const auto refused = queue.admission(size, sceneBytes);
    return refused ? refused->code() : farm::Refusal::UNKNOWN;
}

TEST_F(RenderQueueTest, RefusesWhatIsTooLarge) {
    const JobSize ordinary{.pixels = 1000, .lightPaths = 1000};
    start({.pixels = 1000, .sceneBytes = 5000});
    EXPECT_EQ(admissionCode(*queue, ordinary, 5000), farm::Refusal::UNKNOWN);
    EXPECT_EQ(admissionCode(*queue, {.pixels = 1001}), farm::Refusal::TOO_LARGE);
    EXPECT_EQ(admissionCode(*queue, {.pixels = UINT64_MAX}), farm::Refusal::TOO_LARGE);
    EXPECT_EQ(admissionCode(*queue, {.lightPaths = 1001}), farm::Refusal::TOO_LARGE);
    EXPECT_EQ(admissionCode(*queue, ordinary, 5001), farm::Refusal::TOO_LARGE);
    start({.deviceBytes = estimateDeviceBytes(ordinary) - 1});
    EXPECT_EQ(admissionCode(*queue, ordinary), farm::Refusal::TOO_LARGE);
    RenderQueueLimits limits;
    limits.resultBytes = resultBytesOf(limits, ordinary);
    EXPECT_EQ(limits.resultBytes, 2u * 1000 * 24);
    start(limits);
    EXPECT_EQ(admissionCode(*queue, ordinary), farm::Refusal::UNKNOWN);
    EXPECT_EQ(admissionCode(*queue, {.pixels = 1001}), farm::Refusal::TOO_LARGE);
}

TEST_F(RenderQueueTest, RefusesWhatDoesNotFitBesideOthersAndEvictsOrphansForIt) {
    const JobSize size{.pixels = 8};
    const uint64_t need = estimateDeviceBytes(size);
    start({.deviceBytes = need + 2 * jobBytes - 1});
    openReady(1, a);
    EXPECT_EQ(admissionCode(*queue, size), farm::Refusal::UNKNOWN);
    openReady(2, b);
    EXPECT_EQ(admissionCode(*queue, size), farm::Refusal::BUSY);
    queue->detach(name(2), b, 5);
    queue->detach(name(1), a, 6);
    EXPECT_EQ(admissionCode(*queue, size), farm::Refusal::UNKNOWN);
    EXPECT_FALSE(queue->open(name(3), settingsOf(3), "hash", scene, need, sceneBytes, c));
    EXPECT_FALSE(queue->knows(name(2))) << "the oldest orphan goes";
    EXPECT_TRUE(queue->knows(name(1)));
    run();
    EXPECT_EQ(worker.openJobs(), 2u);
}

TEST_F(RenderQueueTest, OrphansWithResultsOrABlockInHandAreNotEvicted) {
    start({.jobs = 1});
    openReady(1, a);
    queue->lease(name(1), 1, {0, 4});
    queue->detach(name(1), a, 0);
    EXPECT_EQ(admissionCode(*queue, {}), farm::Refusal::BUSY);
    run();
    EXPECT_EQ(admissionCode(*queue, {}), farm::Refusal::BUSY);
    queue->settle(name(1), 1);
    EXPECT_EQ(admissionCode(*queue, {}), farm::Refusal::UNKNOWN);
    open(2, b);
    EXPECT_EQ(refusalOf(3, c, settingsOf(3)), farm::Refusal::BUSY) << "unasked";
    EXPECT_TRUE(queue->knows(name(2)));
}

TEST_F(RenderQueueTest, AnOrphanThatIsBeingBuiltMakesNoRoomYet) {
    start({.jobs = 1});
    open(1, a);
    queue->detach(name(1), a, 0);
    EXPECT_EQ(admissionCode(*queue, {}), farm::Refusal::BUSY) << "the worker has its scene";
    EXPECT_EQ(refusalOf(2, b, settingsOf(2)), farm::Refusal::BUSY);
    EXPECT_TRUE(queue->knows(name(1))) << "a refusal changes nothing";
    run();
    EXPECT_EQ(admissionCode(*queue, {}), farm::Refusal::UNKNOWN);
    open(2, b);
    EXPECT_FALSE(queue->knows(name(1)));
}

TEST_F(RenderQueueTest, BuildsThatNobodyWaitsForCount) {
    start({.jobs = 2});
    for (uint64_t seed = 1; seed <= 2; ++seed) {
        open(seed, a);
        queue->close(name(seed));
    }
    EXPECT_EQ(admissionCode(*queue, {}), farm::Refusal::BUSY);
    run();
    EXPECT_EQ(admissionCode(*queue, {}), farm::Refusal::UNKNOWN);
    EXPECT_EQ(worker.openJobs(), 0u);
    EXPECT_TRUE(a.log.empty());
}

TEST_F(RenderQueueTest, CallbacksAfterTheQueueIsGoneDoNothing) {
    start();
    openReady(1, a);
    queue->lease(name(1), 1, {0, 4});
    worker.step();
    queue.reset();
    run();
    EXPECT_TRUE(a.log.empty());
}

}  // namespace

// ---- Workers that have several blocks in hand

namespace {

/// Ends blocks as the test says.
class WideWorker final : public BlockWorker {
public:
    void openJob(const JobKey& job, std::shared_ptr<const Scene>, const RenderSettings&,
                 std::function<void(const JobReady&)> ready, std::function<void(const Error&)> failed) override {
        fail[job] = std::move(failed);
        ready({});
    }
    void renderBlock(const JobKey& job, IterationRange range, BlockCallbacks callbacks) override {
        blocks[{job, range.first}] = std::move(callbacks);
    }
    void truncateBlock(const JobKey& job, uint64_t first) override { truncated.emplace_back(job, first); }
    void closeJob(const JobKey&) override {}
    BlocksAtOnce blocksAtOnce() const override { return {SIZE_MAX, 2}; }
    void tellWidth(const std::function<void(const JobKey&, uint32_t)>& told) override { widthTold = told; }

    void finish(const JobKey& job, IterationRange range) {
        const auto block = blocks.extract({job, range.first});
        BlockResult result;
        result.range = range;
        block.mapped().finished(std::move(result));
    }

    std::map<JobKey, std::function<void(const Error&)>> fail;
    std::map<std::pair<JobKey, uint64_t>, BlockCallbacks> blocks;
    std::vector<std::pair<JobKey, uint64_t>> truncated;
    std::function<void(const JobKey&, uint32_t)> widthTold;
};

class WideQueueTest : public RenderQueueTest {
protected:
    void SetUp() override {
        queue.emplace(wide, RenderQueueLimits{.leaseDepth = 4}, loop.post());
        open(1, a), open(2, b);
        loop.run();
        a.take(), b.take();
    }
    WideWorker wide;
};

}  // namespace

TEST_F(WideQueueTest, BlocksOfAJobAreRenderedSideBySideAndAnswerInAnyOrder) {
    for (uint64_t i = 0; i < 3; ++i) queue->lease(name(1), i, {16 * i, 16});
    EXPECT_EQ(wide.blocks.size(), 2u);
    wide.blocks.at({"1", 16}).progress(5);
    loop.run();
    EXPECT_EQ(a.lastProgress, (std::pair<uint64_t, uint64_t>{1, 5}));
    wide.finish("1", {16, 16});
    loop.run();
    EXPECT_EQ(a.take(), Log{"result 1"});
    EXPECT_TRUE(wide.blocks.contains({"1", 32})) << "its place is taken by the next one";
    wide.finish("1", {0, 16});
    loop.run();
    EXPECT_EQ(a.take(), Log{"result 0"});
}

TEST_F(WideQueueTest, JobsDoNotWaitForEachOther) {
    for (uint64_t i = 0; i < 2; ++i) queue->lease(name(1), i, {16 * i, 16}), queue->lease(name(2), i, {16 * i, 16});
    EXPECT_EQ(wide.blocks.size(), 4u);
}

TEST_F(WideQueueTest, ABlockThatOverlapsOneInHandWaits) {
    queue->lease(name(1), 1, {0, 16});
    queue->lease(name(1), 2, {8, 8});
    EXPECT_EQ(wide.blocks.size(), 1u);
    wide.finish("1", {0, 16});
    loop.run();
    EXPECT_TRUE(wide.blocks.contains({"1", 8}));
}

TEST_F(WideQueueTest, EachBlockIsTruncatedByItself) {
    for (uint64_t i = 0; i < 2; ++i) queue->lease(name(1), i, {16 * i, 16});
    queue->truncate(name(1), 1);
    EXPECT_EQ(wide.truncated, (std::vector<std::pair<std::string, uint64_t>>{{"1", 16}}));
    queue->drain();
    EXPECT_EQ(wide.truncated.size(), 2u);
    EXPECT_FALSE(queue->idle());
}

TEST_F(WideQueueTest, ResultsAndBlocksInHandTogetherAreBounded) {
    uint64_t lease = 0;
    for (; lease < 4; ++lease) queue->lease(name(1), lease, {16 * lease, 16});
    for (uint64_t i = 0; i < 4; ++i) wide.finish("1", {16 * i, 16}), loop.run();
    for (; lease < 6; ++lease) queue->lease(name(1), lease, {16 * lease, 16});
    EXPECT_TRUE(wide.blocks.empty()) << "a fifth result would wait";
    queue->settle(name(1), 0);
    EXPECT_EQ(wide.blocks.size(), 1u);
}

TEST_F(WideQueueTest, WidthsAreToldAndKeptForTheNextConnection) {
    wide.widthTold("1", 7);
    loop.run();
    EXPECT_EQ(a.take(), Log{"width 7"});
    EXPECT_TRUE(b.take().empty());
}

TEST_F(WideQueueTest, AJobCanFailAloneAfterItWasReady) {
    wide.fail.at("1")(Error(ErrorCode::Device, "not verified"));
    loop.run();
    EXPECT_EQ(a.take(), Log{"failed: not verified"});
    EXPECT_FALSE(queue->knows(name(1)));
    EXPECT_TRUE(queue->deviceLoss().empty());
    queue->lease(name(2), 1, {0, 4});
    EXPECT_EQ(wide.blocks.size(), 1u) << "the other job goes on";
}

}  // namespace antipode::test
