// A server's sessions without sockets: fake connections, a worker that is stepped, a background that can be held up.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "proto/wire/scene_package.h"
#include "server/server_session.h"
#include "tests/film/temporary_folder.h"
#include "tests/server/stepped_worker.h"
#include "tests/support/fake_renderer.h"

namespace antipode::test {

/// Keeps what is sent. While `stalled`, nothing leaves its queue.
class FakePort final : public wire::FramePort {
public:
    void send(wire::Frame frame) override {
        EXPECT_FALSE(closed) << "a frame after close()";
        if (stalled) queued += frame.message.size() + frame.payload.size() + wire::frameHeaderBytes;
        frames.push_back(std::move(frame));
    }
    size_t queuedBytes() const override { return queued; }
    void close(const std::string& reason) override {
        EXPECT_FALSE(closed) << "closed twice";
        closed = reason;
    }

    std::deque<wire::Frame> frames{};
    bool stalled = false;
    size_t queued = 0;
    std::optional<std::string> closed{};
};

struct BenchOptions {
    RenderQueueLimits limits{};
    uint64_t cacheBytes = 1 << 30;
    RendererFactory renderers = fakeRenderers();
};

/// What a server is, one thread and no clock.
struct SessionBench {
    explicit SessionBench(BenchOptions options = {});

    /// Lets the worker and all calls go on until nothing is left to do.
    void run();
    void step(int steps = 1);
    /// What was held up in the background, the oldest first.
    void runBackground();

    TemporaryFolder folder;
    CallLoop loop;
    SteppedWorker worker;
    RenderQueue queue;
    SceneCache cache;
    ServerContext context;
    bool holdBackground = false;
    std::deque<std::pair<std::function<void()>, std::function<void()>>> background;
    double now = 1000;
};

/// A client's end of a connection, as well-behaved as the test wants it.
class Peer {
public:
    explicit Peer(SessionBench& bench) : bench_(bench), session_(bench.context, port, bench.now) {}

    void send(wire::FrameType type, const google::protobuf::MessageLite& message, std::string payload = {}) {
        receive(wire::makeFrame(type, message, std::move(payload)));
    }
    /// The server receives any frame.
    void receive(const wire::Frame& frame) {
        session_.heard(bench_.now);
        session_.receive(frame, bench_.now);
    }
    void tick(double seconds = 0) {
        bench_.now += seconds;
        session_.tick(bench_.now);
    }
    void disconnect() { session_.disconnected("cut", bench_.now); }

    void hello();
    void openJob(const farm::OpenJob& job);
    /// Sends what the server asks for, in chunks, until it asks for nothing more.
    void upload(const wire::ScenePackage& scene, size_t chunkBytes = wire::maxPayloadBytes);
    void sendChunk(const farm::BlobRef& blob, uint64_t offset, std::string bytes);
    /// Hello to JobReady.
    void openReady(const farm::OpenJob& job, const wire::ScenePackage& scene);
    void grant(uint64_t lease, IterationRange range);
    void credit(uint64_t lease, uint32_t chunks);
    void verdict(uint64_t lease, farm::ResultVerdict::Verdict verdict = farm::ResultVerdict::COMMITTED);

    /// The next frame, which must be of this type; heartbeats are passed over.
    template <class Message>
    Message expect(wire::FrameType type, std::string* payload = nullptr);
    /// Expects a refusal with these words, and the end.
    void expectRefusal(farm::Refusal::Code code, const std::string& words);
    /// No frame has come but heartbeats.
    bool quiet();
    const ServerSession& session() const { return session_; }

    FakePort port;

private:
    SessionBench& bench_;
    ServerSession session_;
};

/// Makes the job's hash fit what else was changed in it.
void reseal(farm::OpenJob& job);

farm::OpenJob jobFor(const wire::ScenePackage& scene, uint64_t seed = 1, uint32_t width = 4, uint32_t height = 2);
/// tinyScene() with so many textures, all different, of this many texels each.
Scene texturedScene(int textures, uint32_t texels);

template <class Message>
Message Peer::expect(wire::FrameType type, std::string* payload) {
    while (!port.frames.empty() && port.frames.front().type == wire::FrameType::Heartbeat) port.frames.pop_front();
    if (port.frames.empty()) {
        ADD_FAILURE() << "no frame came, type " << int(type) << " was expected";
        return {};
    }
    const wire::Frame frame = std::move(port.frames.front());
    port.frames.pop_front();
    EXPECT_EQ(frame.type, type);
    if (frame.type != type) return {};
    if (payload) *payload = frame.payload;
    return wire::parseMessage<Message>(frame);
}

}  // namespace antipode::test
