#include "tests/nodes/remote_session_fixture.h"

#include "proto/wire/block_codec.h"
#include "proto/wire/job_messages.h"
#include "tests/support/fake_renderer.h"

namespace antipode::test {
namespace {

wire::Blob blobOf(size_t size, char fill) {
    wire::Blob blob;
    blob.bytes = std::make_shared<const std::string>(size, fill);
    blob.reference.set_sha256(sha256Of(*blob.bytes));
    blob.reference.set_size(size);
    return blob;
}

std::string bytesOf(const std::string& hexadecimal) {
    std::string bytes;
    for (size_t i = 0; i < hexadecimal.size(); i += 2) bytes += char(std::stoi(hexadecimal.substr(i, 2), nullptr, 16));
    return bytes;
}

FilmSums sumsOf(const farm::ResultOffer& offer, const RenderSettings& settings) {
    return fakeSums(settings, {{offer.first(), offer.count()}});
}

}  // namespace

RemoteSessionTest::RemoteSessionTest(uint32_t width, uint32_t height) : budget(uint64_t(width) * height * 24) {
    settings.width = width;
    settings.height = height;
    settings.initialRadius = 0.1;
    settings.maxPathLength = 8;
    scene.sceneHash = std::string(64, 'a');
    scene.blobs = {blobOf(100, 'r'), blobOf((5 << 20) + 7, 'm')};

    CoordinatorOptions options;
    options.iterations = 64;
    coordinator =
        std::make_unique<Coordinator>(JobDefinition{settings, scene.sceneHash, std::string(64, 'b')}, options);

    const farm::OpenJob open =
        wire::makeOpenJob(std::string(16, 'j'), settings, scene.root(), scene.sceneHash, std::string(64, 'b'));
    farm::Hello hello;
    hello.set_oldest_protocol(wire::protocolVersion);
    hello.set_newest_protocol(wire::protocolVersion);
    hello.set_build("1.0-client");
    hello.set_kernel_hash(std::string(64, 'b'));
    context = std::make_unique<RemoteContext>(RemoteContext{*coordinator, scene, open, hello, budget, {}});
    connect();
}

void RemoteSessionTest::connect() {
    session.reset();
    port = std::make_unique<FakePort>();
    session = std::make_unique<RemoteSession>(*context, *port, "server:1", now);
}

void RemoteSessionTest::receive(const wire::Frame& frame) {
    session->heard(now);
    session->receive(frame, now);
}

void RemoteSessionTest::reach(RemoteSession::Phase phase) {
    using Phase = RemoteSession::Phase;
    if (phase == Phase::Greeting) return;
    receive(wire::FrameType::Welcome, welcome());
    if (phase == Phase::Uploading) {
        port->queued = 100 << 20;
        receive(wire::FrameType::NeedBlobs, need(1));
        port->queued = 0;
    }
    if (phase == Phase::Ready) receive(wire::FrameType::JobReady, jobReady());
    if (phase == Phase::Ended) session->finish();
    ASSERT_EQ(session->phase(), phase);
}

void RemoteSessionTest::disconnect() { session->disconnected("connection reset by peer", now); }

farm::Welcome RemoteSessionTest::welcome() const {
    farm::Welcome message;
    message.set_protocol(wire::protocolVersion);
    message.set_build("1.1-server");
    message.set_kernel_hash(std::string(64, 'b'));
    message.mutable_device()->set_name("Fake GPU");
    message.mutable_device()->set_device_class("fake");
    message.set_lease_depth(2);
    return message;
}

farm::NeedBlobs RemoteSessionTest::need(size_t blob, uint64_t offset) const {
    farm::NeedBlobs message;
    farm::NeedBlobs::Need* need = message.add_need();
    *need->mutable_blob() = scene.blobs.at(blob).reference;
    need->set_offset(offset);
    return message;
}

farm::JobReady RemoteSessionTest::jobReady() const {
    farm::JobReady message;
    message.set_initial_radius(*settings.initialRadius);
    message.set_light_paths_per_iteration(uint64_t(settings.width) * settings.height);
    message.set_width(1);
    return message;
}

farm::ResultOffer RemoteSessionTest::offer(uint64_t lease, IterationRange range) const {
    farm::ResultOffer message;
    message.set_lease(lease);
    message.set_first(range.first);
    message.set_count(range.count);
    const FilmSums sums = sumsOf(message, settings);
    message.set_sha256(bytesOf(sums.sha256()));
    message.set_width(sums.layout.width);
    message.set_height(sums.layout.height);
    for (const FilmLayer& layer : sums.layout.layers) message.add_scale_exponent(layer.scaleExponent);
    message.set_seconds(1);
    message.set_chunks(uint32_t(wire::chunkCount(sums.values.size())));
    return message;
}

wire::Frame RemoteSessionTest::chunk(const farm::ResultOffer& offer, uint32_t index, uint64_t lease) const {
    const FilmSums sums = sumsOf(offer, settings);
    farm::ResultChunk message;
    message.set_lease(lease);
    message.set_index(index);
    return wire::makeFrame(wire::FrameType::ResultChunk, message, wire::encodeChunk(wire::chunkOf(sums.values, index)));
}

void RemoteSessionTest::deliver(const farm::ResultOffer& offer) {
    receive(wire::FrameType::ResultOffer, offer);
    for (uint32_t i = 0; i < offer.chunks(); ++i) receive(chunk(offer, i, offer.lease()));
}

std::vector<farm::LeaseGrant> RemoteSessionTest::leases() {
    coordinator->tick(now);
    return take<farm::LeaseGrant>(wire::FrameType::LeaseGrant);
}

farm::ResultVerdict::Verdict RemoteSessionTest::verdict() {
    const auto verdicts = take<farm::ResultVerdict>(wire::FrameType::ResultVerdict);
    EXPECT_EQ(verdicts.size(), 1u);
    return verdicts.empty() ? farm::ResultVerdict::UNKNOWN : verdicts.front().verdict();
}

}  // namespace antipode::test
