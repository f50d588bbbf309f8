// How a job and its scene come to a server.
#include <chrono>
#include <filesystem>
#include <fstream>

#include "proto/scene_loader.h"
#include "proto/wire/frame.h"
#include "renderengine/io/text.h"
#include "tests/server/session_bench.h"

namespace antipode::test {
namespace {

using farm::Refusal;
using wire::FrameType;

class ServerSessionScene : public ::testing::Test {
protected:
    void start(BenchOptions options = {}) {
        options.renderers = [this](const Scene& assembled, const RenderSettings& settings) {
            built.push_back(sceneHash(assembled));
            return fakeRenderers()(assembled, settings);
        };
        bench.emplace(std::move(options));
    }
    farm::NeedBlobs expectNeed(Peer& peer) { return peer.expect<farm::NeedBlobs>(FrameType::NeedBlobs); }
    /// Sends one whole blob of the scene in one piece.
    void sendWhole(Peer& peer, const wire::Blob& blob) { peer.sendChunk(blob.reference, 0, *blob.bytes); }

    std::vector<std::string> built;  // hashes of the scenes that renderers were made of
    std::optional<SessionBench> bench;
    const wire::ScenePackage scene = wire::packageScene(texturedScene(3, 100));
};

TEST_F(ServerSessionScene, ComesInBlobsRootFirst) {
    start();
    Peer peer(*bench);
    peer.hello();
    peer.openJob(jobFor(scene));
    const auto root = expectNeed(peer);
    ASSERT_EQ(root.need_size(), 1);
    EXPECT_EQ(root.need(0).blob().sha256(), scene.root().sha256());
    sendWhole(peer, scene.blobs.front());
    ASSERT_FALSE(peer.port.frames.empty());
    peer.upload(scene, 33);
    EXPECT_TRUE(peer.quiet());
    bench->run();
    const auto ready = peer.expect<farm::JobReady>(FrameType::JobReady);
    EXPECT_EQ(ready.initial_radius(), 0.25);
    EXPECT_EQ(ready.light_paths_per_iteration(), 7u);
    EXPECT_EQ(ready.device_bytes(), 1000u);
    EXPECT_EQ(ready.build_seconds(), 0.5);
    EXPECT_EQ(built, std::vector{scene.sceneHash});
}

TEST_F(ServerSessionScene, IsAskedForOnce) {
    start();
    Peer first(*bench), second(*bench);
    first.openReady(jobFor(scene, 1), scene);
    second.hello();
    second.openJob(jobFor(scene, 2));
    bench->run();
    second.expect<farm::JobReady>(FrameType::JobReady);
}

TEST_F(ServerSessionScene, OfManyBlobsIsAskedForInBatches) {
    start();
    const auto many = wire::packageScene(texturedScene(2500, 1));
    ASSERT_GT(many.blobs.size(), 2048u);
    Peer peer(*bench);
    peer.openReady(jobFor(many), many);
    EXPECT_EQ(built, std::vector{many.sceneHash});
}

TEST_F(ServerSessionScene, ResumesWhatAnEarlierConnectionLeft) {
    start();
    const wire::Blob& root = scene.blobs.front();
    {
        Peer peer(*bench);
        peer.hello();
        peer.openJob(jobFor(scene));
        peer.sendChunk(root.reference, 0, root.bytes->substr(0, 10));
        peer.disconnect();
    }
    Peer peer(*bench);
    peer.hello();
    peer.openJob(jobFor(scene));
    ASSERT_EQ(peer.port.frames.size(), 1u);
    EXPECT_EQ(wire::parseMessage<farm::NeedBlobs>(peer.port.frames.front()).need(0).offset(), 10u);
    peer.upload(scene);
    bench->run();
    peer.expect<farm::JobReady>(FrameType::JobReady);
}

TEST_F(ServerSessionScene, ChunksMustComeAsAskedFor) {
    const wire::Blob& root = scene.blobs.front();
    const std::string& bytes = *root.bytes;
    const auto refuses = [&](const std::function<void(Peer&)>& act) {
        start();
        Peer peer(*bench);
        peer.hello();
        peer.openJob(jobFor(scene));
        peer.sendChunk(root.reference, 0, bytes.substr(0, 10));
        EXPECT_THROW(act(peer), wire::ProtocolError);
        EXPECT_EQ(bench->cache.available(root.reference), 10u);
    };
    refuses([&](Peer& peer) { peer.sendChunk(root.reference, 0, bytes.substr(0, 10)); });
    refuses([&](Peer& peer) { peer.sendChunk(root.reference, 11, bytes.substr(11)); });
    refuses([&](Peer& peer) { peer.sendChunk(root.reference, UINT64_MAX, "x"); });
    refuses([&](Peer& peer) { peer.sendChunk(root.reference, 10, ""); });
    refuses([&](Peer& peer) { peer.sendChunk(root.reference, 10, bytes.substr(10) + "x"); });
    refuses([&](Peer& peer) { sendWhole(peer, scene.blobs.back()); });
}

TEST_F(ServerSessionScene, OpenJobMustBeWhole) {
    const auto refuses = [&](const std::function<void(farm::OpenJob&)>& spoil) {
        start();
        Peer peer(*bench);
        peer.hello();
        farm::OpenJob job = jobFor(scene);
        spoil(job);
        EXPECT_THROW(peer.openJob(job), wire::ProtocolError);
    };
    refuses([](farm::OpenJob& job) { job.set_job("short"); });
    refuses([](farm::OpenJob& job) { job.clear_scene(); });
    refuses([](farm::OpenJob& job) { job.mutable_scene()->set_sha256("short"); });
    refuses([](farm::OpenJob& job) { job.mutable_scene()->set_size(0); });
    refuses([](farm::OpenJob& job) { job.set_scene_hash(std::string(64, 'G')); });
    refuses([](farm::OpenJob& job) { job.set_scene_hash(std::string(63, 'a')); });
}

TEST_F(ServerSessionScene, RefusesSettingsThatNoEngineTakes) {
    for (const auto& spoil : std::vector<std::function<void(farm::JobSettings&)>>{
             [](farm::JobSettings& s) { s.Clear(); }, [](farm::JobSettings& s) { s.set_width(0); },
             [](farm::JobSettings& s) { s.set_technique("magic"); }, [](farm::JobSettings& s) { s.set_alpha(-1); },
             [](farm::JobSettings& s) { s.set_initial_radius(std::numeric_limits<double>::quiet_NaN()); }}) {
        start();
        Peer peer(*bench);
        peer.hello();
        farm::OpenJob job = jobFor(scene);
        spoil(*job.mutable_settings());
        peer.openJob(job);
        peer.expectRefusal(Refusal::BAD_JOB, "");
    }
}

TEST_F(ServerSessionScene, RefusesAJobThatItReadsOtherwiseThanTheClient) {
    // A setting that this build does not know, one that was changed on the way, another scene, no hash at all.
    for (const auto& spoil : std::vector<std::function<void(farm::OpenJob&)>>{
             [](farm::OpenJob& job) { job.set_job_hash(std::string(64, 'a')); },
             [](farm::OpenJob& job) { job.mutable_settings()->set_seed(77); },
             [](farm::OpenJob& job) { job.set_scene_hash(std::string(64, 'a')); },
             [](farm::OpenJob& job) { job.clear_job_hash(); }}) {
        start();
        Peer peer(*bench);
        peer.hello();
        farm::OpenJob job = jobFor(scene);
        spoil(job);
        peer.openJob(job);
        peer.expectRefusal(Refusal::BAD_JOB, "same build");
    }
}

TEST_F(ServerSessionScene, RefusesNumbersBeyondTheLimits) {
    for (const auto& [spoil, words] : std::vector<std::pair<std::function<void(farm::JobSettings&)>, std::string>>{
             {[](farm::JobSettings& s) { s.set_connections_per_vertex(SettingsLimits::connectionsPerVertex + 1); },
              "between 1 and 16"},
             {[](farm::JobSettings& s) { s.set_max_path_length(SettingsLimits::pathLength + 1); },
              "between 1 and 65535"},
             {[](farm::JobSettings& s) { s.set_light_path_count(SettingsLimits::lightPaths + 1); },
              "between 1 and 2^28"}}) {
        start();
        Peer peer(*bench);
        peer.hello();
        farm::OpenJob job = jobFor(scene);
        spoil(*job.mutable_settings());
        peer.openJob(job);
        peer.expectRefusal(Refusal::BAD_JOB, words);
    }
}

TEST_F(ServerSessionScene, RefusesTooLargeAnImageBeforeItAsksForAnything) {
    start({.limits = {.pixels = 100}});
    Peer peer(*bench);
    peer.hello();
    peer.openJob(jobFor(scene, 1, 101, 1));
    peer.expectRefusal(Refusal::TOO_LARGE, "101 pixels");
}

TEST_F(ServerSessionScene, RefusesTooLargeARoot) {
    start();
    Peer peer(*bench);
    peer.hello();
    farm::OpenJob job = jobFor(scene);
    job.mutable_scene()->set_size(wire::maxSceneRootBytes + 1);
    peer.openJob(job);
    peer.expectRefusal(Refusal::TOO_LARGE, "root");
}

TEST_F(ServerSessionScene, RefusesTooLargeASceneOnceTheRootIsHere) {
    const auto refusedAfterRoot = [&](BenchOptions options, const std::string& words) {
        start(std::move(options));
        Peer peer(*bench);
        peer.hello();
        peer.openJob(jobFor(scene));
        expectNeed(peer);
        sendWhole(peer, scene.blobs.front());
        peer.expectRefusal(Refusal::TOO_LARGE, words);
    };
    refusedAfterRoot({.limits = {.sceneBytes = 1200}}, "scene");
    refusedAfterRoot({.limits = {.deviceBytes = estimateDeviceBytes({.pixels = 8, .lightPaths = 8})}}, "device");
    const auto large = wire::packageScene(texturedScene(3, 10000));
    start({.cacheBytes = 5 * 4096});
    Peer peer(*bench);
    peer.hello();
    peer.openJob(jobFor(large));
    expectNeed(peer);
    sendWhole(peer, large.blobs.front());
    peer.expectRefusal(Refusal::TOO_LARGE, "cache");
}

TEST_F(ServerSessionScene, IsBusyWhenJobsFillTheServer) {
    start({.limits = {.jobs = 1}});
    Peer first(*bench), second(*bench);
    first.openReady(jobFor(scene, 1), scene);
    second.hello();
    second.openJob(jobFor(scene, 2));
    second.expectRefusal(Refusal::BUSY, "1 jobs");
}

TEST_F(ServerSessionScene, IsBusyWhenTheServerFillsDuringTheUpload) {
    for (const bool rootFirst : {false, true}) {
        start({.limits = {.jobs = 1}});
        Peer first(*bench), second(*bench);
        second.hello();
        second.openJob(jobFor(scene, 2));
        if (rootFirst) {
            expectNeed(second);
            sendWhole(second, scene.blobs.front());
        }
        first.openReady(jobFor(scene, 1), scene);
        second.upload(scene);
        second.expectRefusal(Refusal::BUSY, "1 jobs");
    }
}

TEST_F(ServerSessionScene, IsBusyWhileAJobIsBuiltThatNobodyWaitsFor) {
    start({.limits = {.jobs = 1}});
    Peer first(*bench), second(*bench), third(*bench);
    first.hello();
    first.openJob(jobFor(scene, 1));
    first.upload(scene);
    first.disconnect();
    second.hello();
    second.openJob(jobFor(scene, 2));
    second.upload(scene);
    second.expectRefusal(Refusal::BUSY, "1 jobs");
    bench->run();
    third.openReady(jobFor(scene, 2), scene);
}

TEST_F(ServerSessionScene, IsBusyWhenTheCacheIsFullOfScenesInUse) {
    start({.cacheBytes = 5 * 4096});
    Peer first(*bench), second(*bench);
    const auto other = wire::packageScene(texturedScene(2, 200));
    bench->holdBackground = true;
    first.hello();
    first.openJob(jobFor(scene, 1));
    first.upload(scene);
    bench->holdBackground = false;
    bench->runBackground();
    expectNeed(first);
    for (size_t i = 1; i < 4; ++i) sendWhole(first, scene.blobs[i]);
    second.hello();
    second.openJob(jobFor(other, 2));
    second.upload(other);
    second.expectRefusal(Refusal::BUSY, "in use");
    sendWhole(first, scene.blobs[4]);
    bench->run();
    first.expect<farm::JobReady>(FrameType::JobReady);
}

TEST_F(ServerSessionScene, RefusesABlobOfAWrongHash) {
    start();
    Peer peer(*bench);
    peer.hello();
    peer.openJob(jobFor(scene));
    expectNeed(peer);
    sendWhole(peer, scene.blobs.front());
    const auto needs = expectNeed(peer);
    for (const auto& need : needs.need()) peer.sendChunk(need.blob(), 0, std::string(need.blob().size(), 'x'));
    peer.expectRefusal(Refusal::BAD_SCENE, "hash");
    EXPECT_EQ(bench->cache.available(needs.need(0).blob()), 0u);
    bench->run();
    EXPECT_TRUE(built.empty());
}

TEST_F(ServerSessionScene, RefusesARootThatIsNone) {
    start();
    wire::ScenePackage bad = scene;
    bad.blobs.resize(1);
    bad.blobs[0].bytes = std::make_shared<const std::string>("certainly no root");
    bad.blobs[0].reference.set_sha256(sha256Of(*bad.blobs[0].bytes));
    bad.blobs[0].reference.set_size(bad.blobs[0].bytes->size());
    Peer peer(*bench);
    peer.hello();
    peer.openJob(jobFor(bad));
    peer.upload(bad);
    peer.expectRefusal(Refusal::BAD_SCENE, "");
}

TEST_F(ServerSessionScene, RefusesAnotherSceneThanAnnounced) {
    start();
    Peer peer(*bench);
    peer.hello();
    farm::OpenJob job = jobFor(scene);
    job.set_scene_hash(std::string(64, 'a'));
    reseal(job);
    peer.openJob(job);
    peer.upload(scene);
    peer.expectRefusal(Refusal::BAD_SCENE, "announced");
    bench->run();
    EXPECT_TRUE(built.empty());
}

TEST_F(ServerSessionScene, TwoConnectionsMayUploadItAtTheSameTime) {
    start();
    const auto large = wire::packageScene(texturedScene(4, 1000));
    Peer a(*bench), b(*bench);
    const auto uploadNext = [&](Peer& peer, farm::NeedBlobs& needs, uint64_t& next, size_t bytes) {
        if (needs.need_size() == 0) {
            if (peer.port.frames.empty() || peer.port.frames.front().type != FrameType::NeedBlobs) return;
            needs = expectNeed(peer);
            next = needs.need(0).offset();
        }
        const farm::BlobRef blob = needs.need(0).blob();
        for (const wire::Blob& candidate : large.blobs)
            if (candidate.reference.sha256() == blob.sha256())
                peer.sendChunk(blob, next, candidate.bytes->substr(next, bytes));
        next += bytes;
        if (next < blob.size()) return;
        needs.mutable_need()->DeleteSubrange(0, 1);
        if (needs.need_size() > 0) next = needs.need(0).offset();
    };
    a.hello(), b.hello();
    a.openJob(jobFor(large, 1)), b.openJob(jobFor(large, 2));
    farm::NeedBlobs needsA, needsB;
    uint64_t nextA = 0, nextB = 0;
    for (int i = 0; i < 1000; ++i) {
        uploadNext(a, needsA, nextA, 300);
        uploadNext(b, needsB, nextB, i % 3 == 0 ? 700 : 100);
    }
    bench->run();
    a.expect<farm::JobReady>(FrameType::JobReady);
    b.expect<farm::JobReady>(FrameType::JobReady);
    EXPECT_EQ(built, (std::vector{large.sceneHash, large.sceneHash}));
}

TEST_F(ServerSessionScene, APartThatSomebodyElseSpoiltIsAskedForAgain) {
    start();
    const wire::Blob& root = scene.blobs.front();
    bench->cache.append(root.reference, 0, "spoilt");
    Peer peer(*bench);
    peer.hello();
    peer.openJob(jobFor(scene));
    const auto first = expectNeed(peer);
    EXPECT_EQ(first.need(0).offset(), 6u);
    peer.sendChunk(root.reference, 6, root.bytes->substr(6));
    ASSERT_FALSE(peer.port.frames.empty());
    EXPECT_EQ(wire::parseMessage<farm::NeedBlobs>(peer.port.frames.front()).need(0).offset(), 0u);
    peer.upload(scene);
    bench->run();
    peer.expect<farm::JobReady>(FrameType::JobReady);
}

TEST_F(ServerSessionScene, GivesUpOnAPartThatIsSpoiltAgainAndAgain) {
    start();
    const wire::Blob& root = scene.blobs.front();
    bench->cache.append(root.reference, 0, "spoilt");
    Peer peer(*bench);
    peer.hello();
    peer.openJob(jobFor(scene));
    int asked = 0;
    while (!peer.port.closed && asked < 100) {
        const uint64_t offset = expectNeed(peer).need(0).offset();
        ++asked;
        if (offset == 0) bench->cache.append(root.reference, 0, "s");
        peer.sendChunk(root.reference, offset, root.bytes->substr(offset));
    }
    EXPECT_EQ(asked, 9);
    peer.expectRefusal(Refusal::BUSY, "do not arrive whole");
}

TEST_F(ServerSessionScene, ABlobDamagedInTheCacheIsAskedForAgain) {
    for (size_t damaged = 0; damaged < scene.blobs.size(); ++damaged) {
        start();
        Peer first(*bench), second(*bench);
        first.openReady(jobFor(scene, 1), scene);
        const auto& reference = scene.blobs[damaged].reference;
        const std::string hash = hexadecimal(reference.sha256());
        std::ofstream(bench->folder.file("cache") + "/" + hash.substr(0, 2) + "/" + hash + "-" +
                      std::to_string(reference.size()))
            << std::string(reference.size(), 'x');
        second.hello();
        second.openJob(jobFor(scene, 2));
        ASSERT_EQ(second.port.frames.size(), 1u);
        const auto need = wire::parseMessage<farm::NeedBlobs>(second.port.frames.front());
        ASSERT_EQ(need.need_size(), 1);
        EXPECT_EQ(need.need(0).blob().sha256(), reference.sha256());
        second.upload(scene);
        bench->run();
        second.expect<farm::JobReady>(FrameType::JobReady);
    }
}

TEST_F(ServerSessionScene, IsPutTogetherInTheBackground) {
    start();
    bench->holdBackground = true;
    Peer peer(*bench);
    peer.hello();
    peer.openJob(jobFor(scene));
    peer.upload(scene);
    EXPECT_EQ(bench->background.size(), 1u) << "the root";
    EXPECT_TRUE(peer.quiet());
    bench->runBackground();
    peer.upload(scene);
    EXPECT_EQ(bench->background.size(), 1u) << "the scene";
    // It may take as long as it likes, as long as both sides beat.
    for (int i = 0; i < 100; ++i) {
        peer.tick(2);
        peer.send(FrameType::Heartbeat, farm::Heartbeat());
    }
    EXPECT_FALSE(peer.port.closed);
    bench->runBackground();
    bench->run();
    EXPECT_TRUE(std::ranges::any_of(peer.port.frames, [](auto& f) { return f.type == FrameType::JobReady; }));
}

TEST_F(ServerSessionScene, AClientThatLeavesDuringTheAssemblyLeavesNothing) {
    start();
    bench->holdBackground = true;
    {
        Peer peer(*bench);
        peer.hello();
        peer.openJob(jobFor(scene));
        peer.upload(scene);
        bench->runBackground();
        peer.upload(scene);
        ASSERT_EQ(bench->background.size(), 1u);
        peer.disconnect();
    }
    // Work that nobody waits for is not done: it would use the blob.
    const std::string hash = hexadecimal(scene.blobs.back().reference.sha256());
    const std::string file = bench->folder.file("cache") + "/" + hash.substr(0, 2) + "/" + hash + "-" +
                             std::to_string(scene.blobs.back().reference.size());
    const auto longAgo = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1);
    std::filesystem::last_write_time(file, longAgo);
    bench->runBackground();
    EXPECT_EQ(std::filesystem::last_write_time(file), longAgo);
    bench->run();
    EXPECT_EQ(bench->queue.totals().jobs, 0u);
    EXPECT_TRUE(built.empty());
}

TEST_F(ServerSessionScene, IsPinnedUntilItIsAssembled) {
    const auto fill = [&](SceneCache& cache) {
        const std::string bytes(8192, 'f');
        farm::BlobRef blob;
        blob.set_sha256(sha256Of(bytes));
        blob.set_size(bytes.size());
        cache.append(blob, 0, bytes);
    };
    start({.cacheBytes = 6 * 4096});
    bench->holdBackground = true;
    Peer peer(*bench);
    peer.hello();
    peer.openJob(jobFor(scene));
    peer.upload(scene);
    bench->runBackground();
    peer.upload(scene);
    EXPECT_THROW(fill(bench->cache), Error) << "all but one block is pinned";
    for (const wire::Blob& blob : scene.blobs) EXPECT_EQ(bench->cache.available(blob.reference), blob.reference.size());
    bench->runBackground();
    fill(bench->cache);
}

TEST_F(ServerSessionScene, AReconnectNeedsNoScene) {
    start();
    Peer first(*bench), second(*bench), other(*bench);
    first.openReady(jobFor(scene), scene);
    first.disconnect();
    std::filesystem::remove_all(bench->folder.file("cache"));
    second.hello();
    second.openJob(jobFor(scene));
    second.expect<farm::JobReady>(FrameType::JobReady);
    EXPECT_EQ(built.size(), 1u);

    farm::OpenJob changed = jobFor(scene);
    changed.mutable_settings()->set_seed(2);
    reseal(changed);
    other.hello();
    other.openJob(changed);
    other.expectRefusal(Refusal::BAD_JOB, "other settings");
    EXPECT_FALSE(second.port.closed);
}

TEST_F(ServerSessionScene, ABuildThatFailsIsRefusedByItsReason) {
    const std::vector<std::pair<ErrorCode, Refusal::Code>> codes = {{ErrorCode::Usage, Refusal::BAD_JOB},
                                                                    {ErrorCode::Input, Refusal::BAD_SCENE},
                                                                    {ErrorCode::Device, Refusal::DEVICE_FAILED}};
    for (const auto& [error, code] : codes) {
        start();
        Peer peer(*bench);
        peer.hello();
        peer.openJob(jobFor(scene));
        peer.upload(scene);
        bench->worker.failNext = Error(error, "It went wrong.");
        bench->run();
        peer.expectRefusal(code, "It went wrong.");
    }
}

}  // namespace
}  // namespace antipode::test
