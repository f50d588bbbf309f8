#include "proto/wire/frame.h"

// For a hash state on the stack.
#define XXH_STATIC_LINKING_ONLY
#include <xxhash.h>

#include <google/protobuf/io/coded_stream.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace antipode::wire {
namespace {

static_assert(std::endian::native == std::endian::little, "headers are read as they lie in memory");

constexpr std::string_view magic = "APF1";
constexpr uint16_t layoutVersion = 1;
constexpr size_t hashedHeaderBytes = 16;
/// Messages nest three deep; groups, which no message of ours has, could nest deeper.
constexpr int recursionLimit = 16;

struct Header {
    char magic[4];
    uint16_t version, type;
    uint32_t messageBytes, payloadBytes;
    uint64_t checksum;
};
static_assert(sizeof(Header) == frameHeaderBytes && offsetof(Header, checksum) == hashedHeaderBytes);

uint64_t checksumOf(const Header& header, std::string_view body) {
    XXH3_state_t state;
    XXH3_INITSTATE(&state);
    XXH3_64bits_reset(&state);
    XXH3_64bits_update(&state, &header, hashedHeaderBytes);
    XXH3_64bits_update(&state, body.data(), body.size());
    return XXH3_64bits_digest(&state);
}

bool isKnown(uint16_t type) { return type >= uint16_t(FrameType::Hello) && type <= uint16_t(FrameType::Capacity); }

bool carriesPayload(FrameType type) { return type == FrameType::BlobChunk || type == FrameType::ResultChunk; }

void checkLength(const char* part, uint32_t bytes, size_t most) {
    if (bytes > most)
        throw ProtocolError("a frame announces a " + std::string(part) + " of " + std::to_string(bytes) +
                            " bytes, but " + std::to_string(most) + " are the most");
}

[[noreturn]] void refusePayload(FrameType type) {
    throw ProtocolError("a frame of type " + std::to_string(unsigned(type)) +
                        " carries a payload, which it has none of");
}

void check(const Header& header) {
    if (header.version != layoutVersion)
        throw ProtocolError("a frame has layout " + std::to_string(header.version) + ", but this build reads layout " +
                            std::to_string(layoutVersion));
    if (!isKnown(header.type)) throw ProtocolError("a frame has the unknown type " + std::to_string(header.type));
    checkLength("message", header.messageBytes, maxMessageBytes);
    checkLength("payload", header.payloadBytes, maxPayloadBytes);
    const auto type = FrameType(header.type);
    if (header.payloadBytes != 0 && !carriesPayload(type)) refusePayload(type);
}

}  // namespace

std::string encodeFrame(const Frame& frame) {
    if (frame.message.size() > maxMessageBytes || frame.payload.size() > maxPayloadBytes)
        throw std::length_error("a frame of " + std::to_string(frame.message.size()) + " + " +
                                std::to_string(frame.payload.size()) + " bytes is too long to be sent");
    Header header{
        {}, layoutVersion, uint16_t(frame.type), uint32_t(frame.message.size()), uint32_t(frame.payload.size()), 0};
    std::ranges::copy(magic, header.magic);
    std::string bytes;
    bytes.reserve(frameHeaderBytes + frame.message.size() + frame.payload.size());
    bytes.resize(frameHeaderBytes);
    bytes.append(frame.message).append(frame.payload);
    header.checksum = checksumOf(header, std::string_view(bytes).substr(frameHeaderBytes));
    std::memcpy(bytes.data(), &header, sizeof header);
    return bytes;
}

void FrameReader::feed(std::string_view bytes) {
    // Moving no more bytes than were used since the last move keeps the whole stream's cost proportional to its length.
    if (position_ >= buffer_.size() - position_) {
        buffer_.erase(0, position_);
        position_ = 0;
    }
    buffer_.append(bytes);
}

std::optional<Frame> FrameReader::next() {
    const std::string_view rest = std::string_view(buffer_).substr(position_);
    // The first bytes tell another protocol; its peer might wait for an answer before it sends more.
    const size_t known = std::min(rest.size(), magic.size());
    if (rest.substr(0, known) != magic.substr(0, known))
        throw ProtocolError("what came is no frame: the peer speaks another protocol");
    if (rest.size() < frameHeaderBytes) return {};
    Header header;
    std::memcpy(&header, rest.data(), sizeof header);
    check(header);
    const size_t bodyBytes = size_t(header.messageBytes) + header.payloadBytes;
    if (rest.size() - frameHeaderBytes < bodyBytes) return {};
    const std::string_view body = rest.substr(frameHeaderBytes, bodyBytes);
    if (checksumOf(header, body) != header.checksum)
        throw ProtocolError("a frame's checksum does not match: it was damaged on its way");
    position_ += frameHeaderBytes + bodyBytes;
    return Frame{FrameType(header.type), std::string(body.substr(0, header.messageBytes)),
                 std::string(body.substr(header.messageBytes))};
}

Frame makeFrame(FrameType type, const google::protobuf::MessageLite& message, std::string payload) {
    return {type, message.SerializeAsString(), std::move(payload)};
}

void parseInto(const Frame& frame, google::protobuf::MessageLite& message) {
    if (!frame.payload.empty() && !carriesPayload(frame.type)) refusePayload(frame.type);
    if (frame.message.size() > maxMessageBytes)
        throw ProtocolError("a " + message.GetTypeName() + " of " + std::to_string(frame.message.size()) +
                            " bytes is longer than any message");
    google::protobuf::io::CodedInputStream stream(reinterpret_cast<const uint8_t*>(frame.message.data()),
                                                  int(frame.message.size()));
    stream.SetRecursionLimit(recursionLimit);
    if (!message.ParseFromCodedStream(&stream) || !stream.ConsumedEntireMessage())
        throw ProtocolError("a frame of type " + std::to_string(unsigned(frame.type)) + " does not hold a " +
                            message.GetTypeName());
}

}  // namespace antipode::wire
