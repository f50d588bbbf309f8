// The blobs that a server lacks, on their way to it.
#pragma once

#include <deque>
#include <map>
#include <string_view>

#include "proto/wire/scene_package.h"
#include "proto/wire/session.h"

namespace antipode {

class SceneUpload {
public:
    /// The package outlives the upload.
    explicit SceneUpload(const wire::ScenePackage& scene);

    /// Queues what the server asks for. Throws ProtocolError for blobs and offsets that the scene does not have, for
    /// blobs that are queued already, and for those asked for again and again.
    void need(const farm::NeedBlobs& request);
    /// Sends chunks for as long as the port's queue is short.
    void advance(wire::FramePort& port);
    /// Forgets what is still to be sent: the server has it from elsewhere.
    void cancel() { queue_.clear(); }

    bool done() const { return queue_.empty(); }
    uint64_t sentBytes() const { return sentBytes_; }
    uint64_t neededBytes() const { return neededBytes_; }  ///< all that was ever asked for

private:
    struct Source {
        std::shared_ptr<const std::string> bytes;
        uint32_t requests = 0;
        bool queued = false;
    };
    struct Part {
        std::string_view sha256;  ///< a key of `sources_`
        Source* source;
        uint64_t offset;
    };

    std::map<std::string, Source, std::less<>> sources_;
    std::deque<Part> queue_;
    uint64_t sentBytes_ = 0, neededBytes_ = 0;
};

}  // namespace antipode
