#include "tests/server/session_bench.h"

#include <algorithm>

#include "proto/wire/job_messages.h"

namespace antipode::test {
namespace {

const std::string kernelsOfAll(64, 'c');

}  // namespace

using wire::FrameType;

SessionBench::SessionBench(BenchOptions options)
    : worker(std::move(options.renderers)),
      queue(worker, options.limits, loop.post()),
      cache(folder.file("cache"), options.cacheBytes),
      context{queue, cache, {}, {}} {
    context.welcome.set_build("1.2.3");
    context.welcome.set_kernel_hash(kernelsOfAll);
    context.welcome.set_lease_depth(options.limits.leaseDepth);
    context.background = [this](std::function<void()> work, std::function<void()> done) {
        if (holdBackground)
            background.emplace_back(std::move(work), std::move(done));
        else
            runAtOnce(std::move(work), std::move(done));
    };
}

void SessionBench::run() {
    do loop.run();
    while (worker.step());
}

void SessionBench::step(int steps) {
    for (int i = 0; i < steps; ++i) {
        worker.step();
        loop.run();
    }
}

void SessionBench::runBackground() {
    while (!background.empty()) {
        const auto task = std::move(background.front());
        background.pop_front();
        task.first();
        task.second();
    }
}

void Peer::hello() {
    farm::Hello hello;
    hello.set_oldest_protocol(wire::protocolVersion);
    hello.set_newest_protocol(wire::protocolVersion);
    hello.set_build("1.2.3");
    hello.set_kernel_hash(kernelsOfAll);
    hello.set_client("host/1");
    send(FrameType::Hello, hello);
    expect<farm::Welcome>(FrameType::Welcome);
}

void Peer::openJob(const farm::OpenJob& job) { send(FrameType::OpenJob, job); }

void Peer::sendChunk(const farm::BlobRef& blob, uint64_t offset, std::string bytes) {
    farm::BlobChunk chunk;
    chunk.set_sha256(blob.sha256());
    chunk.set_offset(offset);
    send(FrameType::BlobChunk, chunk, std::move(bytes));
}

void Peer::upload(const wire::ScenePackage& scene, size_t chunkBytes) {
    while (!port.frames.empty() && port.frames.front().type == FrameType::NeedBlobs) {
        const auto needs = expect<farm::NeedBlobs>(FrameType::NeedBlobs);
        EXPECT_LE(needs.need_size(), 1024);
        for (const auto& need : needs.need()) {
            const auto blob = std::ranges::find_if(
                scene.blobs, [&](const wire::Blob& b) { return b.reference.sha256() == need.blob().sha256(); });
            ASSERT_NE(blob, scene.blobs.end());
            for (uint64_t at = need.offset(); at < need.blob().size(); at += chunkBytes)
                sendChunk(need.blob(), at, blob->bytes->substr(at, chunkBytes));
        }
    }
}

void Peer::openReady(const farm::OpenJob& job, const wire::ScenePackage& scene) {
    hello();
    openJob(job);
    upload(scene);
    bench_.run();
    expect<farm::JobReady>(FrameType::JobReady);
}

void Peer::grant(uint64_t lease, IterationRange range) {
    farm::LeaseGrant message;
    message.set_lease(lease);
    message.set_first(range.first);
    message.set_count(range.count);
    send(FrameType::LeaseGrant, message);
}

void Peer::credit(uint64_t lease, uint32_t chunks) {
    farm::ResultCredit message;
    message.set_lease(lease);
    message.set_chunks(chunks);
    send(FrameType::ResultCredit, message);
}

void Peer::verdict(uint64_t lease, farm::ResultVerdict::Verdict verdict) {
    farm::ResultVerdict message;
    message.set_lease(lease);
    message.set_verdict(verdict);
    send(FrameType::ResultVerdict, message);
}

void Peer::expectRefusal(farm::Refusal::Code code, const std::string& words) {
    const auto refusal = expect<farm::Refusal>(FrameType::Refusal);
    EXPECT_EQ(refusal.code(), code) << refusal.sentence();
    EXPECT_NE(refusal.sentence().find(words), std::string::npos) << refusal.sentence();
    EXPECT_TRUE(port.closed);
    EXPECT_TRUE(port.frames.empty());
}

bool Peer::quiet() {
    std::erase_if(port.frames, [](const wire::Frame& frame) { return frame.type == FrameType::Heartbeat; });
    return port.frames.empty();
}

void reseal(farm::OpenJob& job) {
    job.set_job_hash(wire::jobHash(wire::fromMessage(job.settings()), job.scene_hash(), kernelsOfAll));
}

farm::OpenJob jobFor(const wire::ScenePackage& scene, uint64_t seed, uint32_t width, uint32_t height) {
    RenderSettings settings;
    settings.width = width;
    settings.height = height;
    settings.seed = seed;
    settings.initialRadius = 0.25;
    return wire::makeOpenJob(std::string(15, 'j') + char('0' + seed % 64), settings, scene.root(), scene.sceneHash,
                             kernelsOfAll);
}

Scene texturedScene(int textures, uint32_t texels) {
    Scene scene = tinyScene();
    for (int i = 0; i < textures; ++i) {
        Texture texture;
        texture.width = texels;
        texture.height = 1;
        texture.rgba.assign(size_t(texels) * 4, uint8_t(i));
        texture.rgba[1] = uint8_t(i >> 8);
        scene.textures.push_back(std::move(texture));
    }
    return scene;
}

}  // namespace antipode::test
