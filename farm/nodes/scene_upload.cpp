#include "farm/nodes/scene_upload.h"

#include <algorithm>

namespace antipode {
namespace {

/// Eight seconds of a line of 64 kbit/s.
constexpr size_t chunkBytes = 64 << 10;
constexpr int maxNeeds = 1024;
/// A blob may be wanted again where another client's upload of it broke off, or where it fell out of the cache.
constexpr uint32_t maxRequests = 8;

}  // namespace

SceneUpload::SceneUpload(const wire::ScenePackage& scene) {
    for (const wire::Blob& blob : scene.blobs) sources_.try_emplace(blob.reference.sha256(), Source{blob.bytes});
}

void SceneUpload::need(const farm::NeedBlobs& request) {
    if (request.need_size() == 0 || request.need_size() > maxNeeds)
        throw wire::ProtocolError("a request for blobs names none or more than 1024");
    for (const farm::NeedBlobs::Need& need : request.need()) {
        const auto found = sources_.find(need.blob().sha256());
        if (found == sources_.end()) throw wire::ProtocolError("the server asks for a blob that is not of this scene");
        Source& source = found->second;
        const uint64_t size = source.bytes->size();
        if (need.blob().size() != size || need.offset() >= size)
            throw wire::ProtocolError("the server asks for bytes that a blob does not have");
        if (source.queued) throw wire::ProtocolError("the server asks twice for a blob");
        if (++source.requests > maxRequests) throw wire::ProtocolError("the server asks for a blob again and again");
        source.queued = true;
        queue_.push_back({found->first, &source, need.offset()});
        neededBytes_ += size - need.offset();
    }
}

void SceneUpload::advance(wire::FramePort& port) {
    while (!queue_.empty() && port.queuedBytes() < wire::shortQueueBytes) {
        Part& part = queue_.front();
        const std::string& bytes = *part.source->bytes;
        const size_t count = std::min<size_t>(bytes.size() - part.offset, chunkBytes);
        farm::BlobChunk chunk;
        chunk.set_sha256(std::string(part.sha256));
        chunk.set_offset(part.offset);
        port.send(wire::makeFrame(wire::FrameType::BlobChunk, chunk, bytes.substr(part.offset, count)));
        part.offset += count;
        sentBytes_ += count;
        if (part.offset < bytes.size()) continue;
        part.source->queued = false;
        queue_.pop_front();
    }
}

}  // namespace antipode
