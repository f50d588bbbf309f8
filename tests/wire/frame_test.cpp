#include "proto/wire/frame.h"

#include <cstring>
#include <vector>

#include "proto/farm.pb.h"
#include "tests/wire/protocol_error.h"

namespace antipode::wire {
namespace {

using testing::expectProtocolError;

constexpr size_t messageBytesAt = 8, payloadBytesAt = 12;

Frame smallFrame() { return {FrameType::ResultChunk, "message", "payload bytes"}; }

/// Whatever the reader gives out of the pieces, in order.
std::vector<Frame> readAll(const std::vector<std::string_view>& pieces) {
    FrameReader reader;
    std::vector<Frame> frames;
    for (std::string_view piece : pieces) {
        reader.feed(piece);
        while (auto frame = reader.next()) frames.push_back(std::move(*frame));
    }
    return frames;
}

/// A header of this frame type that announces lengths; its checksum is wrong.
std::string headerOf(FrameType type, uint32_t messageBytes, uint32_t payloadBytes) {
    std::string bytes = encodeFrame({type, "", ""});
    std::memcpy(&bytes[messageBytesAt], &messageBytes, 4);
    std::memcpy(&bytes[payloadBytesAt], &payloadBytes, 4);
    return bytes;
}

TEST(Frame, LooksAsSpecified) {
    const std::string bytes = encodeFrame({FrameType::BlobChunk, "ab", "xyz"});
    ASSERT_EQ(bytes.size(), frameHeaderBytes + 5);
    EXPECT_EQ(bytes.substr(0, 16), std::string("APF1\x01\0\x08\0\x02\0\0\0\x03\0\0\0", 16));
    EXPECT_EQ(bytes.substr(frameHeaderBytes), "abxyz");
}

TEST(Frame, EveryTypeSurvives) {
    for (auto type = uint16_t(FrameType::Hello); type <= uint16_t(FrameType::Capacity); ++type) {
        const Frame frame{FrameType(type), std::string(type, 'm'), ""};
        const auto frames = readAll({encodeFrame(frame)});
        ASSERT_EQ(frames.size(), 1u);
        EXPECT_EQ(frames[0], frame);
    }
}

TEST(Frame, TooLongOnesAreNotEncoded) {
    EXPECT_THROW(encodeFrame({FrameType::BlobChunk, std::string(maxMessageBytes + 1, ' '), ""}), std::length_error);
    EXPECT_THROW(encodeFrame({FrameType::BlobChunk, "", std::string(maxPayloadBytes + 1, ' ')}), std::length_error);
}

TEST(FrameReader, EverySplitOfAStream) {
    const std::vector<Frame> sent{smallFrame(), {FrameType::Heartbeat, "", ""}, {FrameType::Hello, "hello", ""}};
    std::string stream;
    for (const Frame& frame : sent) stream += encodeFrame(frame);
    for (size_t a = 0; a <= stream.size(); ++a)
        for (size_t b = a; b <= stream.size(); ++b) {
            const std::string_view all = stream;
            EXPECT_TRUE(readAll({all.substr(0, a), all.substr(a, b - a), all.substr(b)}) == sent) << a << ' ' << b;
        }
}

TEST(FrameReader, ByteByByte) {
    const std::string stream = encodeFrame(smallFrame()) + encodeFrame(smallFrame());
    std::vector<std::string_view> pieces;
    for (size_t i = 0; i < stream.size(); ++i) pieces.push_back(std::string_view(stream).substr(i, 1));
    EXPECT_EQ(readAll(pieces).size(), 2u);
}

TEST(FrameReader, AMillionFramesAtOnceAndFedWhileReading) {
    // Were what is left moved after every frame, this would move 10^13 bytes.
    constexpr size_t count = 1'000'000;
    const std::string one = encodeFrame({FrameType::Heartbeat, "", ""});
    std::string stream;
    for (size_t i = 0; i < count; ++i) stream += one;
    FrameReader reader;
    reader.feed(stream);
    size_t frames = 0;
    for (size_t i = 0; i < one.size(); ++i)
        for (size_t taken = 0; taken < count / one.size() && reader.next(); ++taken, ++frames)
            if (taken == 0) reader.feed(std::string_view(one).substr(i, 1));
    while (reader.next()) ++frames;
    EXPECT_EQ(frames, count + 1);
}

TEST(FrameReader, DuplicatesAreFramesLikeOthers) {
    const std::string bytes = encodeFrame(smallFrame());
    EXPECT_EQ(readAll({bytes, bytes}), (std::vector<Frame>{smallFrame(), smallFrame()}));
}

TEST(FrameReader, EveryTruncationGivesNothing) {
    const std::string bytes = encodeFrame(smallFrame());
    for (size_t size = 0; size < bytes.size(); ++size)
        EXPECT_TRUE(readAll({std::string_view(bytes).substr(0, size)}).empty()) << size;
}

TEST(FrameReader, EveryFlippedBitIsDetected) {
    const std::string bytes = encodeFrame(smallFrame());
    // A length that has grown makes the reader wait; what follows then shows the damage.
    const std::string following(maxMessageBytes + maxPayloadBytes, '\0');
    for (size_t bit = 0; bit < bytes.size() * 8; ++bit) {
        std::string damaged = bytes;
        damaged[bit / 8] = char(damaged[bit / 8] ^ (1 << bit % 8));
        EXPECT_THROW(readAll({damaged, following}), ProtocolError) << "bit " << bit;
    }
}

TEST(FrameReader, SplicedFramesAreDetected) {
    const std::string a = encodeFrame(smallFrame());
    const std::string b = encodeFrame({FrameType::ResultChunk, "massage", "payload bites"});
    ASSERT_EQ(a.size(), b.size());
    for (size_t cut = frameHeaderBytes + 2; cut < a.size() - 3; ++cut)
        EXPECT_THROW(readAll({a.substr(0, cut) + b.substr(cut)}), ProtocolError) << cut;
    // Bytes lost between two frames.
    EXPECT_THROW(readAll({a.substr(0, a.size() - 1), b}), ProtocolError);
    EXPECT_THROW(readAll({a, b.substr(1)}), ProtocolError);
}

TEST(FrameReader, LengthsOf0) { EXPECT_EQ(readAll({encodeFrame({FrameType::BlobChunk, "", ""})}).size(), 1u); }

TEST(FrameReader, LengthsOfTheMaximum) {
    const Frame frame{FrameType::BlobChunk, std::string(maxMessageBytes, 'm'), std::string(maxPayloadBytes, 'p')};
    const auto frames = readAll({encodeFrame(frame)});
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_EQ(frames[0], frame);
}

TEST(FrameReader, MessageOfTheMaximumPlus1IsRefusedByItsHeader) {
    expectProtocolError("announces a message of 1048577 bytes",
                        [] { readAll({headerOf(FrameType::BlobChunk, maxMessageBytes + 1, 0)}); });
}

TEST(FrameReader, PayloadOfTheMaximumPlus1IsRefusedByItsHeader) {
    expectProtocolError("announces a payload of 1048577 bytes",
                        [] { readAll({headerOf(FrameType::BlobChunk, 0, maxPayloadBytes + 1)}); });
}

TEST(FrameReader, MessageOf4GiBIsRefusedByItsHeader) {
    expectProtocolError("announces a message of 4294967295 bytes",
                        [] { readAll({headerOf(FrameType::BlobChunk, 0xFFFFFFFF, 0xFFFFFFFF)}); });
}

TEST(FrameReader, PayloadOf4GiBIsRefusedByItsHeader) {
    expectProtocolError("announces a payload of 4294967295 bytes",
                        [] { readAll({headerOf(FrameType::BlobChunk, 0, 0xFFFFFFFF)}); });
}

TEST(FrameReader, AnotherProtocolIsRefusedByItsFirstByte) {
    expectProtocolError("another protocol", [] { readAll({"G"}); });
    expectProtocolError("another protocol", [] { readAll({"APF2"}); });
}

TEST(FrameReader, OtherLayoutsAndTypesAreRefused) {
    std::string bytes = encodeFrame({FrameType::Heartbeat, "", ""});
    bytes[4] = 2;
    expectProtocolError("has layout 2", [&] { readAll({bytes}); });
    for (const char type : {0, 20, 127}) {
        bytes = encodeFrame({FrameType(type), "", ""});
        expectProtocolError("unknown type " + std::to_string(type), [&] { readAll({bytes}); });
    }
}

TEST(FrameReader, PayloadsOfMessagesWithoutAreRefusedByTheirHeader) {
    expectProtocolError("carries a payload", [] { readAll({headerOf(FrameType::Hello, 0, 1)}); });
}

TEST(ParseMessage, RoundTrip) {
    farm::BlobChunk chunk;
    chunk.set_offset(77);
    const Frame frame = makeFrame(FrameType::BlobChunk, chunk, "bytes");
    EXPECT_EQ(parseMessage<farm::BlobChunk>(frame).offset(), 77u);
    EXPECT_EQ(frame.payload, "bytes");
}

TEST(ParseMessage, RefusesWhatIsNoMessage) {
    for (const std::string bytes : {"\x08", "\xFF\xFF\xFF\xFF", "\x0A\x7F", "\x0C"})
        expectProtocolError("does not hold a antipode.farm.Hello", [&] {
            parseMessage<farm::Hello>({FrameType::Hello, bytes, ""});
        });
}

TEST(ParseMessage, RefusesPayloadsOfMessagesWithout) {
    expectProtocolError("carries a payload", [] { parseMessage<farm::Hello>({FrameType::Hello, "", "x"}); });
}

TEST(ParseMessage, RefusesMessagesLongerThanAFrameHas) {
    expectProtocolError("longer than any message", [] {
        parseMessage<farm::Hello>({FrameType::Hello, std::string(maxMessageBytes + 1, '\0'), ""});
    });
}

TEST(ParseMessage, RefusesDeepNesting) {
    const std::string field = "\xA3\x06";  // an unknown group in a group in a group …
    std::string bytes;
    for (int i = 0; i < 10000; ++i) bytes += field;
    for (int i = 0; i < 10000; ++i) bytes += "\xA4\x06";
    expectProtocolError("does not hold", [&] { parseMessage<farm::Hello>({FrameType::Hello, bytes, ""}); });
}

}  // namespace
}  // namespace antipode::wire
