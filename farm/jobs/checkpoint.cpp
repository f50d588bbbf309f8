// The format: encoding in pieces, decoding with every number checked before it is used.
#include "farm/jobs/checkpoint.h"

#include <array>
#include <cmath>
#include <functional>

#include "farm/jobs/checkpoint_format.h"
#include "renderengine/sha256.h"
#include "proto/farm.pb.h"
#include "proto/wire/block_codec.h"
#include "proto/wire/frame.h"
#include "proto/wire/job_messages.h"
#include "proto/wire/scene_package.h"
#include "renderengine/error.h"
#include "renderengine/error_classes.h"

namespace antipode {
namespace {

constexpr std::string_view magic = "antipode checkpoint 1\n";
constexpr size_t digestBytes = 32;
constexpr uint64_t maxHeaderBytes = 64 << 20, maxChunkBytes = 1 << 20;
constexpr uint64_t maxPixels = 1 << 28;  // what an engine takes

template <class T>
std::string littleEndian(T value) {
    std::string bytes;
    for (size_t i = 0; i < sizeof(T); ++i) bytes += char(uint8_t(value >> (8 * i)));
    return bytes;
}

/// FilmSums::sha256 as 32 bytes.
std::string hashOf(const FilmSums& sums) {
    const std::string digits = sums.sha256();
    std::string bytes;
    for (size_t i = 0; i < digits.size(); i += 2) bytes += char(std::stoi(digits.substr(i, 2), nullptr, 16));
    return bytes;
}

farm::Checkpoint headerOf(const Checkpoint& checkpoint) {
    farm::Checkpoint header;
    *header.mutable_settings() = wire::toMessage(checkpoint.job.settings);
    header.set_scene_hash(checkpoint.job.sceneHash);
    header.set_kernel_hash(checkpoint.job.kernelHash);
    header.set_job_hash(checkpoint.job.hash());
    for (const std::string& deviceClass : checkpoint.deviceClasses) header.add_device_class(deviceClass);
    for (const IterationRange& range : checkpoint.committed.ranges()) {
        farm::Range* message = header.add_committed();
        message->set_first(range.first);
        message->set_count(range.count);
    }
    const bool inClasses = hasErrorClasses(checkpoint.sums.layout);
    if (inClasses)
        for (const uint64_t count : checkpoint.sums.residueIterations) header.add_error_class_iterations(count);
    // Classes have one scale.
    const FilmLayout film = inClasses ? withoutErrorClasses(checkpoint.sums.layout) : checkpoint.sums.layout;
    for (const FilmLayer& layer : film.layers) header.add_scale_exponent(layer.scaleExponent);
    *header.mutable_events() = wire::toMessage(checkpoint.sums.events);
    *header.mutable_statistics() = wire::toMessage(checkpoint.statistics);
    header.set_wall_seconds(checkpoint.wallSeconds);
    header.set_chunks(uint32_t(wire::chunkCount(checkpoint.sums.values.size(), wire::checkpointChunkValues)));
    if (!checkpoint.sums.values.empty()) header.set_sums_sha256(hashOf(checkpoint.sums));
    return header;
}

[[noreturn]] void refuse(const std::string& why) {
    throw Error(ErrorCode::Input, "This is not a whole checkpoint: " + why + ".");
}

void require(bool holds, const char* why) {
    if (!holds) refuse(why);
}

/// Takes bytes from the front.
class Reader {
public:
    explicit Reader(std::string_view bytes) : rest_(bytes) {}
    std::string_view take(uint64_t count) {
        require(count <= rest_.size(), "it ends too early");
        const std::string_view taken = rest_.substr(0, size_t(count));
        rest_.remove_prefix(size_t(count));
        return taken;
    }
    template <class T>
    T number() {
        T value = 0;
        const std::string_view bytes = take(sizeof(T));
        for (size_t i = 0; i < sizeof(T); ++i) value |= T(uint8_t(bytes[i])) << (8 * i);
        return value;
    }
    bool atEnd() const { return rest_.empty(); }

private:
    std::string_view rest_;
};

IterationSet committedOf(const farm::Checkpoint& header) {
    constexpr uint64_t most = uint64_t(1) << 62;
    std::vector<IterationRange> ranges;
    for (const farm::Range& message : header.committed()) {
        const IterationRange range{message.first(), message.count()};
        require(range.count >= 1 && range.first < most && range.count < most - range.first,
                "an iteration range is impossible");
        require(ranges.empty() || ranges.back().end() < range.first, "its iteration ranges are not in order");
        ranges.push_back(range);
    }
    return IterationSet(ranges);
}

Checkpoint checkpointOf(const farm::Checkpoint& header) {
    Checkpoint checkpoint;
    try {
        checkpoint.job.settings = wire::fromMessage(header.settings());
    } catch (const Error& error) {
        refuse(error.what());
    }
    checkpoint.job.sceneHash = header.scene_hash();
    checkpoint.job.kernelHash = header.kernel_hash();
    require(!header.job_hash().empty(), "it is of an older build, whose iterations are not the same");
    require(header.job_hash() == checkpoint.job.hash(), "it has settings that this build does not know");
    checkpoint.deviceClasses.assign(header.device_class().begin(), header.device_class().end());
    checkpoint.committed = committedOf(header);
    checkpoint.statistics = wire::fromMessage(header.statistics());
    checkpoint.wallSeconds = header.wall_seconds();
    require(std::isfinite(checkpoint.wallSeconds) && checkpoint.wallSeconds >= 0, "its render time is impossible");

    require(filmLayout(checkpoint.job.settings).pixels() <= maxPixels, "its image is too large");
    if (checkpoint.committed.empty()) {
        require(header.chunks() == 0, "it has sums of no iterations");
        return checkpoint;
    }
    FilmSums& sums = checkpoint.sums;
    sums.iterations = checkpoint.committed.count();
    try {
        sums.layout = wire::layoutOf(checkpoint.job.settings, header.scale_exponent());
        sums.events = wire::fromMessage(header.events());
    } catch (const wire::ProtocolError& error) {
        refuse(error.what());
    }
    const auto& inClasses = header.error_class_iterations();
    if (!inClasses.empty()) {
        require(inClasses.size() == errorClasses && sums.layout.residueClasses() == 1,
                "its image is in classes that this build does not know");
        uint64_t left = sums.iterations;
        for (const uint64_t count : inClasses) {
            require(count <= left, "its classes have more iterations than it has");
            left -= count;
        }
        require(left == 0, "its classes have fewer iterations than it has");
        sums.layout = withErrorClasses(sums.layout);
        sums.residueIterations.assign(inClasses.begin(), inClasses.end());
    }
    require(header.chunks() == wire::chunkCount(sums.layout.values(), wire::checkpointChunkValues),
            "its sums do not fit its image");
    if (!inClasses.empty()) return checkpoint;
    for (const IterationRange& range : checkpoint.committed.ranges()) {
        const std::vector<uint64_t> counts = sums.layout.residueCounts(range);
        sums.residueIterations.resize(counts.size());
        for (size_t k = 0; k < counts.size(); ++k) sums.residueIterations[k] += counts[k];
    }
    return checkpoint;
}

}  // namespace

void encodeCheckpoint(const Checkpoint& checkpoint, const std::function<void(std::string_view)>& append) {
    Sha256 digest;
    const auto write = [&](std::string_view bytes) {
        digest.add(bytes);
        append(bytes);
    };
    const std::string header = headerOf(checkpoint).SerializeAsString();
    if (header.size() > maxHeaderBytes)
        throw Error(ErrorCode::Output, "The job has too many scattered iterations for a checkpoint.");
    write(magic);
    write(littleEndian(uint64_t(header.size())));
    write(header);
    const std::span<const int64_t> values = checkpoint.sums.values;
    for (size_t i = 0; i < wire::chunkCount(values.size(), wire::checkpointChunkValues); ++i) {
        const std::string chunk = wire::encodeChunk(wire::chunkOf(values, i, wire::checkpointChunkValues));
        write(littleEndian(uint32_t(chunk.size())));
        write(chunk);
    }
    append(digest.finish());
}

std::string encodeCheckpoint(const Checkpoint& checkpoint) {
    std::string bytes;
    encodeCheckpoint(checkpoint, [&](std::string_view piece) { bytes += piece; });
    return bytes;
}

Checkpoint decodeCheckpoint(std::string_view bytes) {
    require(bytes.starts_with(magic), "it does not begin like one");
    require(bytes.size() >= magic.size() + digestBytes, "it ends too early");
    const std::string_view body = bytes.substr(0, bytes.size() - digestBytes);
    Sha256 digest;
    digest.add(body);
    require(digest.finish() == bytes.substr(body.size()), "its checksum is wrong");

    // From here on only a forger can be met.
    Reader reader(body.substr(magic.size()));
    const uint64_t headerBytes = reader.number<uint64_t>();
    require(headerBytes <= maxHeaderBytes, "its header is too long");
    const std::string_view headerText = reader.take(headerBytes);
    farm::Checkpoint header;
    require(header.ParseFromArray(headerText.data(), int(headerText.size())), "its header cannot be parsed");
    Checkpoint checkpoint = checkpointOf(header);

    // All chunks have to be there before memory is taken for what is in them.
    std::vector<std::string_view> chunks;
    for (uint32_t i = 0; i < header.chunks(); ++i) {
        const uint32_t chunkBytes = reader.number<uint32_t>();
        require(chunkBytes <= maxChunkBytes, "a part of its sums is too long");
        chunks.push_back(reader.take(chunkBytes));
    }
    require(reader.atEnd(), "there is something behind its sums");
    if (chunks.empty()) return checkpoint;
    checkpoint.sums.values.resize(checkpoint.sums.layout.values());
    const std::span<int64_t> values = checkpoint.sums.values;
    try {
        for (size_t i = 0; i < chunks.size(); ++i)
            wire::decodeChunk(chunks[i], wire::chunkOf(values, i, wire::checkpointChunkValues));
    } catch (const wire::ProtocolError& error) {
        refuse(error.what());
    }
    require(hashOf(checkpoint.sums) == header.sums_sha256(), "its sums do not match their hash");
    return checkpoint;
}

}  // namespace antipode
