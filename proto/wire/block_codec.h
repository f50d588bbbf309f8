// Film sums in chunks, as they travel in results and lie in checkpoints.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace antipode::wire {

/// Values per chunk of a result; the last chunk of a film has the rest. 128 KiB, which a line of 64 kbit/s carries in
/// 16 seconds where they cannot be compressed.
constexpr size_t chunkValues = 16384;
/// Of a checkpoint, which is not waited for: longer ones are a little smaller together.
constexpr size_t checkpointChunkValues = 65536;

constexpr size_t chunkCount(size_t values, size_t perChunk = chunkValues) { return (values + perChunk - 1) / perChunk; }
/// The `index`-th chunk's part of all values.
std::span<int64_t> chunkOf(std::span<int64_t> values, size_t index, size_t perChunk = chunkValues);
std::span<const int64_t> chunkOf(std::span<const int64_t> values, size_t index, size_t perChunk = chunkValues);

/// Bytes of equal significance side by side, then zstd (level 1).
std::string encodeChunk(std::span<const int64_t> values);

/// The reverse, into exactly as many values. Throws ProtocolError unless the bytes decode to that many: nothing is
/// allocated on the word of the sender.
void decodeChunk(std::string_view bytes, std::span<int64_t> values);

}  // namespace antipode::wire
