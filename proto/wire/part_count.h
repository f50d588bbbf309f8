// What parsing a message would cost, known before it is parsed.
#pragma once

#include <cstddef>
#include <string_view>

#include <google/protobuf/descriptor.h>

namespace antipode::wire {

/// How many messages, repeated strings and unknown fields the bytes hold, at all depths: two bytes of input can become
/// a message of hundreds. Stops counting above `limit`, and where the bytes are no message.
size_t partCount(std::string_view bytes, const google::protobuf::Descriptor& type, size_t limit);

}  // namespace antipode::wire
