#include "proto/wire/block_codec.h"

#include <gtest/gtest.h>
#include <zstd.h>

#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "tests/wire/protocol_error.h"

namespace antipode::wire {
namespace {

using testing::expectProtocolError;

std::vector<int64_t> noise(size_t count, int bits) {
    std::mt19937_64 random(20240607);
    std::vector<int64_t> values(count);
    for (int64_t& value : values) value = int64_t(random()) >> (64 - bits);
    return values;
}

std::vector<int64_t> decoded(std::string_view bytes, size_t count) {
    std::vector<int64_t> values(count, -1);
    decodeChunk(bytes, values);
    return values;
}

/// A zstd frame of `size` zero bytes.
std::string zeros(size_t size, bool announced = true, int windowLog = 0) {
    ZSTD_CCtx* context = ZSTD_createCCtx();
    ZSTD_CCtx_setParameter(context, ZSTD_c_contentSizeFlag, announced ? 1 : 0);
    if (windowLog) ZSTD_CCtx_setParameter(context, ZSTD_c_windowLog, windowLog);
    const std::string content(size, '\0');
    std::string bytes(ZSTD_compressBound(size), '\0');
    bytes.resize(ZSTD_compress2(context, bytes.data(), bytes.size(), content.data(), content.size()));
    ZSTD_freeCCtx(context);
    return bytes;
}

/// RFC 8878, 3.1.1.1: descriptor with an 8-byte content size and a single segment, then the size.
std::string frameHeader(uint64_t contentSize) {
    std::string bytes = "\x28\xB5\x2F\xFD\xE0";
    bytes.append(reinterpret_cast<const char*>(&contentSize), 8);
    return bytes;
}

/// RFC 8878, 3.1.1.2: the last block, one zero repeated up to 128 KiB.
std::string zeroBlock(uint32_t size, bool last) {
    const uint32_t header = (size << 3) | (1 << 1) | (last ? 1 : 0);
    return std::string(reinterpret_cast<const char*>(&header), 3) + '\0';
}

std::string skippable(size_t size) {
    const auto bytes = uint32_t(size);
    return "\x50\x2A\x4D\x18" + std::string(reinterpret_cast<const char*>(&bytes), 4) + std::string(size, 's');
}

TEST(Chunks, CoverAllValuesOnce) {
    for (const size_t count : {size_t(0), size_t(1), chunkValues - 1, chunkValues, chunkValues + 1, 3 * chunkValues}) {
        std::vector<int64_t> values(count);
        size_t covered = 0;
        for (size_t i = 0; i < chunkCount(count); ++i) {
            const std::span<int64_t> chunk = chunkOf(std::span(values), i);
            EXPECT_EQ(chunk.data(), values.data() + covered);
            EXPECT_GT(chunk.size(), 0u);
            EXPECT_LE(chunk.size(), chunkValues);
            covered += chunk.size();
        }
        EXPECT_EQ(covered, count);
        EXPECT_TRUE(chunkOf(std::span(values), chunkCount(count)).empty());
    }
}

TEST(BlockCodec, RoundTrip) {
    for (const size_t count : {size_t(1), size_t(7), size_t(1000), chunkValues})
        for (const int bits : {1, 8, 33, 64}) {
            const std::vector<int64_t> values = noise(count, bits);
            EXPECT_EQ(decoded(encodeChunk(values), count), values) << count << " values of " << bits << " bits";
        }
}

TEST(BlockCodec, ExtremeValues) {
    const std::vector<int64_t> values{std::numeric_limits<int64_t>::min(), std::numeric_limits<int64_t>::max(), 0, -1,
                                      1};
    EXPECT_EQ(decoded(encodeChunk(values), values.size()), values);
}

TEST(BlockCodec, EqualValuesGiveEqualBytes) {
    const std::vector<int64_t> values = noise(chunkValues, 40);
    const std::string first = encodeChunk(values);
    encodeChunk(noise(100, 64));
    EXPECT_EQ(encodeChunk(values), first);
}

TEST(BlockCodec, IncompressibleChunksFitInAFrame) {
    EXPECT_LE(encodeChunk(noise(chunkValues, 64)).size(), maxPayloadBytes);
}

TEST(BlockCodec, HighBytesOfNoiseCostNothing) {
    const size_t bytes = encodeChunk(noise(chunkValues, 32)).size();
    EXPECT_LT(bytes, chunkValues * 5 + chunkValues / 4) << "four bytes of noise and the signs";
}

TEST(BlockCodec, OtherCountsAreRefused) {
    const std::string bytes = encodeChunk(noise(100, 40));
    for (const size_t count : {0, 1, 99, 101, 65536})
        expectProtocolError("does not announce the size", [&] { decoded(bytes, count); });
}

TEST(BlockCodec, EveryTruncationIsRefused) {
    const std::string bytes = encodeChunk(noise(50, 40));
    for (size_t size = 0; size < bytes.size(); ++size)
        EXPECT_THROW(decoded(std::string_view(bytes).substr(0, size), 50), ProtocolError) << size;
}

TEST(BlockCodec, EveryFlippedBitIsRefusedOrDecodesToAsMany) {
    const std::string bytes = encodeChunk(noise(50, 20));
    for (size_t bit = 0; bit < bytes.size() * 8; ++bit) {
        std::string damaged = bytes;
        damaged[bit / 8] = char(damaged[bit / 8] ^ (1 << bit % 8));
        try {
            decoded(damaged, 50);
        } catch (const ProtocolError&) {
        }
    }
}

TEST(BlockCodec, WhatFollowsTheFrameIsRefused) {
    const std::string bytes = encodeChunk(noise(100, 40));
    for (const std::string& more : {std::string("x"), bytes, skippable(5), zeros(8)})
        expectProtocolError("one whole frame", [&] { decoded(bytes + more, 100); });
}

TEST(BlockCodec, SkippableFramesAreRefused) {
    for (const size_t count : {0, 2}) {
        expectProtocolError("does not announce", [&] { decoded(skippable(16), count); });
        expectProtocolError("does not announce", [&] { decoded(skippable(0) + zeros(16), count); });
    }
}

TEST(BlockCodec, UnknownSizesAreRefused) {
    ASSERT_EQ(decoded(zeros(800), 100), std::vector<int64_t>(100));
    expectProtocolError("does not announce", [] { decoded(zeros(800, false), 100); });
}

TEST(BlockCodec, AFrameThatClaimsATebibyteIsRefused) {
    expectProtocolError("does not announce",
                        [] { decoded(frameHeader(uint64_t(1) << 40) + zeroBlock(800, true), 100); });
}

TEST(BlockCodec, AFrameThatHoldsMoreThanItClaimsIsRefused) {
    ASSERT_EQ(decoded(frameHeader(800) + zeroBlock(800, true), 100), std::vector<int64_t>(100));
    std::string bomb = frameHeader(800);
    for (int i = 0; i < 8192; ++i) bomb += zeroBlock(128 << 10, false);  // a gibibyte
    bomb += zeroBlock(1, true);
    expectProtocolError("cannot be decompressed", [&] { decoded(bomb, 100); });
    expectProtocolError("cannot be decompressed", [] { decoded(frameHeader(800) + zeroBlock(801, true), 100); });
}

TEST(BlockCodec, AFrameThatHoldsLessThanItClaimsIsRefused) {
    expectProtocolError("cannot be decompressed", [] { decoded(frameHeader(800) + zeroBlock(799, true), 100); });
}

TEST(BlockCodec, DictionariesAreRefused) {
    std::string bytes = frameHeader(800) + zeroBlock(800, true);
    bytes[4] = char(bytes[4] | 1);       // one byte of dictionary number …
    bytes.insert(bytes.begin() + 5, 7);  // … which is 7
    expectProtocolError("dictionary", [&] { decoded(bytes, 100); });
}

TEST(BlockCodec, HugeWindowsCostNothing) {
    // The same frame without a single segment: its window descriptor asks for the 3.75 TiB that the format allows.
    std::string bytes = frameHeader(800) + zeroBlock(800, true);
    bytes[4] = char(0xC0);
    bytes.insert(bytes.begin() + 5, char(0xFF));
    try {
        EXPECT_EQ(decoded(bytes, 100), std::vector<int64_t>(100));
    } catch (const ProtocolError&) {
    }
}

}  // namespace
}  // namespace antipode::wire
