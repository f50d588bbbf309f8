// Frames: the unit in which messages and bulk bytes travel between client and server.
//
//   frame   = header message payload
//   header  = magic version type messageBytes payloadBytes checksum        24 bytes, little-endian
//   magic   = "APF1"               version  = uint16   frame layout, 1
//   type    = uint16, FrameType    messageBytes, payloadBytes = uint32, at most 1 MiB each
//   checksum = uint64, XXH3-64 of the 16 header bytes before it, the message and the payload
//
// The checksum finds accidents; secrecy and authenticity are TLS's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include <google/protobuf/message_lite.h>

namespace antipode::wire {

enum class FrameType : uint16_t {
    Hello = 1,
    Welcome = 2,
    Refusal = 3,
    Heartbeat = 4,
    Draining = 5,
    OpenJob = 6,
    NeedBlobs = 7,
    BlobChunk = 8,
    JobReady = 9,
    CloseJob = 10,
    LeaseGrant = 11,
    Progress = 12,
    Truncate = 13,
    LeaseReturned = 14,
    ResultOffer = 15,
    ResultCredit = 16,
    ResultChunk = 17,
    ResultVerdict = 18,
    Capacity = 19,
};

constexpr uint32_t protocolVersion = 3;  ///< of the messages; Hello and Welcome negotiate it
constexpr size_t frameHeaderBytes = 24;
constexpr size_t maxMessageBytes = 1 << 20, maxPayloadBytes = 1 << 20;

struct Frame {
    FrameType type = FrameType::Heartbeat;
    std::string message;  ///< serialised farm.proto message
    std::string payload;  ///< BlobChunk and ResultChunk only
    bool operator==(const Frame&) const = default;
};

/// What the peer sent cannot be: a broken frame, an unexpected or invalid message. The connection has to end.
class ProtocolError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Throws std::length_error where message or payload is too long.
std::string encodeFrame(const Frame& frame);

/// Cuts a stream of bytes into frames. Lengths are checked before anything is allocated for them, and types and
/// checksums before a frame is given out. After a ProtocolError the reader is of no more use.
class FrameReader {
public:
    /// Appends bytes as they came.
    void feed(std::string_view bytes);
    /// The next complete frame, if there is one. Throws ProtocolError.
    std::optional<Frame> next();

private:
    std::string buffer_;
    size_t position_ = 0;  ///< of the first byte in `buffer_` that no frame has used
};

/// The frame that carries a message.
Frame makeFrame(FrameType type, const google::protobuf::MessageLite& message, std::string payload = {});

/// Parses a frame's message. Throws ProtocolError where it is no Message or where a payload comes with a type that has
/// none.
template <class Message>
Message parseMessage(const Frame& frame);

/// For parseMessage.
void parseInto(const Frame& frame, google::protobuf::MessageLite& message);

template <class Message>
Message parseMessage(const Frame& frame) {
    Message message;
    parseInto(frame, message);
    return message;
}

}  // namespace antipode::wire
