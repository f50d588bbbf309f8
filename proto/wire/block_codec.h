// Film sums in chunks, as they travel in results and lie in checkpoints.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace antipode::wire {

/// Values per chunk; the last chunk of a film has the rest. 512 KiB, so that an incompressible chunk fits in a frame.
constexpr size_t chunkValues = 65536;

constexpr size_t chunkCount(size_t values) { return (values + chunkValues - 1) / chunkValues; }
/// The `index`-th chunk's part of all values.
std::span<int64_t> chunkOf(std::span<int64_t> values, size_t index);
std::span<const int64_t> chunkOf(std::span<const int64_t> values, size_t index);

/// Bytes of equal significance side by side, then zstd (level 1).
std::string encodeChunk(std::span<const int64_t> values);

/// The reverse, into exactly as many values. Throws ProtocolError unless the bytes decode to that many: nothing is
/// allocated on the word of the sender.
void decodeChunk(std::string_view bytes, std::span<int64_t> values);

}  // namespace antipode::wire
