#include "proto/wire/block_codec.h"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <vector>

#include "proto/wire/frame.h"

namespace antipode::wire {
namespace {

constexpr size_t bytesPerValue = sizeof(int64_t);
constexpr int compressionLevel = 1;

template <class Value>
std::span<Value> part(std::span<Value> values, size_t index, size_t perChunk) {
    const size_t begin = std::min(index * perChunk, values.size());
    return values.subspan(begin, std::min(perChunk, values.size() - begin));
}

/// What a thread keeps from chunk to chunk: contexts and planes are costlier to make than to use.
struct Workspace {
    std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> compressor{ZSTD_createCCtx(), ZSTD_freeCCtx};
    std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> decompressor{ZSTD_createDCtx(), ZSTD_freeDCtx};
    std::vector<uint8_t> planes;

    Workspace() {
        if (!compressor || !decompressor) throw std::bad_alloc();
    }
};

Workspace& workspace() {
    thread_local Workspace own;
    return own;
}

/// Byte b of value i goes to plane b, place i. Noise fills the low planes, which zstd then stores as they are; the high
/// ones hold little but zeros. Differences or exclusive ors of neighbours, tried before this, made both longer.
void shuffle(std::span<const int64_t> values, uint8_t* planes) {
    for (size_t byte = 0; byte < bytesPerValue; ++byte) {
        uint8_t* const plane = planes + byte * values.size();
        for (size_t i = 0; i < values.size(); ++i) plane[i] = uint8_t(uint64_t(values[i]) >> (8 * byte));
    }
}

void unshuffle(const uint8_t* planes, std::span<int64_t> values) {
    std::array<const uint8_t*, bytesPerValue> plane;
    for (size_t byte = 0; byte < bytesPerValue; ++byte) plane[byte] = planes + byte * values.size();
    for (size_t i = 0; i < values.size(); ++i) {
        uint64_t value = 0;
        for (size_t byte = 0; byte < bytesPerValue; ++byte) value |= uint64_t(plane[byte][i]) << (8 * byte);
        values[i] = std::bit_cast<int64_t>(value);
    }
}

[[noreturn]] void refuse(const std::string& what) { throw ProtocolError("a chunk of film sums " + what); }

}  // namespace

std::span<int64_t> chunkOf(std::span<int64_t> values, size_t index, size_t perChunk) {
    return part(values, index, perChunk);
}
std::span<const int64_t> chunkOf(std::span<const int64_t> values, size_t index, size_t perChunk) {
    return part(values, index, perChunk);
}

std::string encodeChunk(std::span<const int64_t> values) {
    Workspace& w = workspace();
    w.planes.resize(values.size_bytes());
    shuffle(values, w.planes.data());
    std::string bytes(ZSTD_compressBound(w.planes.size()), '\0');
    const size_t size = ZSTD_compressCCtx(w.compressor.get(), bytes.data(), bytes.size(), w.planes.data(),
                                          w.planes.size(), compressionLevel);
    if (ZSTD_isError(size)) throw std::runtime_error(std::string("zstd: ") + ZSTD_getErrorName(size));
    bytes.resize(size);
    return bytes;
}

void decodeChunk(std::string_view bytes, std::span<int64_t> values) {
    // A frame that tells no size, or a skippable one that yields nothing, ends here.
    const uint64_t announced = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
    if (announced == ZSTD_CONTENTSIZE_ERROR || announced == ZSTD_CONTENTSIZE_UNKNOWN ||
        announced != values.size_bytes() || announced == 0)
        refuse("does not announce the size that its place in the film has");
    if (ZSTD_getDictID_fromFrame(bytes.data(), bytes.size()) != 0) refuse("asks for a dictionary");
    if (ZSTD_findFrameCompressedSize(bytes.data(), bytes.size()) != bytes.size())
        refuse("does not consist of one whole frame");
    // One-shot decompression needs no window of its own and writes nothing beyond the planes.
    Workspace& w = workspace();
    w.planes.resize(values.size_bytes());
    const size_t size =
        ZSTD_decompressDCtx(w.decompressor.get(), w.planes.data(), w.planes.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(size)) refuse(std::string("cannot be decompressed: ") + ZSTD_getErrorName(size));
    if (size != values.size_bytes()) refuse("holds fewer values than it announces");
    unshuffle(w.planes.data(), values);
}

}  // namespace antipode::wire
