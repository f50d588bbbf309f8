// All that a peer can send: a stream of bytes, each type of message, a scene's root.
//
// The first byte of an input chooses: 0, the rest is a stream as it comes from a socket; a frame type, the rest is a
// message of that type, which gets a valid frame; 255, the rest is a scene's root.
#include <algorithm>
#include <cstdint>
#include <string_view>

#include "proto/farm.pb.h"
#include "proto/scene_loader.h"
#include "proto/wire/frame.h"
#include "proto/wire/job_messages.h"
#include "proto/wire/scene_package.h"
#include "renderengine/error.h"
#include "tests/fuzz/quiet.h"
#include "tests/fuzz/require.h"

namespace antipode::wire {
namespace {

constexpr uint8_t sceneRoot = 255;
constexpr size_t maxBlobBytes = 1 << 20;

/// A root's scene, from blobs of zeros or from none.
void tryRoot(std::string_view bytes) {
    const farm::SceneRoot root = parseSceneRoot(bytes);
    uint64_t total = root.skeleton().ByteSizeLong();
    for (const farm::BlobRef& blob : blobsOf(root)) require(blob.size() > 0, "no blob is empty");
    require(sceneBytes(root) >= total, "a scene has its skeleton's bytes");
    RenderSettings settings;
    settings.initialRadius = 1;
    jobSize(root, toMessage(settings));
    const Scene scene = assembleScene(root, [&](const farm::BlobRef& blob) -> std::shared_ptr<const std::string> {
        total += blob.size();
        return total > maxBlobBytes ? nullptr : std::make_shared<const std::string>(blob.size(), '\0');
    });
    const ScenePackage package = packageScene(scene);
    require(package.sceneHash == sceneHash(scene), "an assembled scene can be packaged again");
}

void tryMessage(const Frame& frame) {
    switch (frame.type) {
        case FrameType::Hello: parseMessage<farm::Hello>(frame); break;
        case FrameType::Welcome: parseMessage<farm::Welcome>(frame); break;
        case FrameType::Refusal: parseMessage<farm::Refusal>(frame); break;
        case FrameType::Heartbeat: parseMessage<farm::Heartbeat>(frame); break;
        case FrameType::Draining: parseMessage<farm::Draining>(frame); break;
        case FrameType::OpenJob: {
            const RenderSettings settings = fromMessage(parseMessage<farm::OpenJob>(frame).settings());
            require(fromMessage(toMessage(settings)).seed == settings.seed, "valid settings survive");
            break;
        }
        case FrameType::NeedBlobs: parseMessage<farm::NeedBlobs>(frame); break;
        case FrameType::BlobChunk: parseMessage<farm::BlobChunk>(frame); break;
        case FrameType::JobReady: parseMessage<farm::JobReady>(frame); break;
        case FrameType::Capacity: parseMessage<farm::Capacity>(frame); break;
        case FrameType::CloseJob: parseMessage<farm::CloseJob>(frame); break;
        case FrameType::LeaseGrant: parseMessage<farm::LeaseGrant>(frame); break;
        case FrameType::Progress: parseMessage<farm::Progress>(frame); break;
        case FrameType::Truncate: parseMessage<farm::Truncate>(frame); break;
        case FrameType::LeaseReturned: parseMessage<farm::LeaseReturned>(frame); break;
        case FrameType::ResultOffer: {
            const auto offer = parseMessage<farm::ResultOffer>(frame);
            const EventCounts events = fromMessage(offer.events());
            require(fromMessage(toMessage(events)) == events, "valid events survive");
            EngineStatistics total;
            accumulate(total, fromMessage(offer.statistics()));
            for (const StageTime& stage : total.stages) require(stage.seconds >= 0, "times are no less than 0");
            break;
        }
        case FrameType::ResultCredit: parseMessage<farm::ResultCredit>(frame); break;
        case FrameType::ResultChunk: parseMessage<farm::ResultChunk>(frame); break;
        case FrameType::ResultVerdict: parseMessage<farm::ResultVerdict>(frame); break;
    }
}

/// Reads a stream in pieces whose sizes follow from its bytes.
size_t tryStream(std::string_view stream) {
    FrameReader reader;
    size_t frames = 0;
    while (!stream.empty()) {
        const size_t size = std::min<size_t>(stream.size(), uint8_t(stream[stream.size() / 2]) % 61 + 1);
        reader.feed(stream.substr(0, size));
        stream.remove_prefix(size);
        for (; const auto frame = reader.next(); ++frames) tryMessage(*frame);
    }
    return frames;
}

}  // namespace
}  // namespace antipode::wire

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace antipode;
    if (size == 0) return 0;
    const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
    try {
        if (data[0] == wire::sceneRoot) {
            wire::tryRoot(rest);
        } else if (data[0] == 0) {
            wire::tryStream(rest);
        } else {
            const std::string frame = wire::encodeFrame({wire::FrameType(data[0]), std::string(rest), ""});
            require(wire::tryStream(frame + frame) == 2, "what was encoded is read");
        }
    } catch (const Error&) {
    } catch (const wire::ProtocolError&) {
    }
    return 0;
}
