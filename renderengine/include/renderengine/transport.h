// The techniques of the weighted sum that can be left out of it, to see what each is for or to save its time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderengine/enum_set.h"

namespace antipode {

/// In the order of bits of TransportSet. Meeting emitters by chance is in every technique and costs nothing.
enum class Transport { NextEvent, LightTracing, Connections, Merging };
inline constexpr uint32_t transports = 4;

struct TransportInfo {
    Transport transport;
    const char* option;       ///< what --without takes
    const char* description;  ///< a few words
};

/// All of them, in the order of Transport.
const std::vector<TransportInfo>& transportTable();

using TransportSet = EnumSet<Transport, transports>;

/// The names that --without takes, joined by commas; "none" where there are none.
std::string name(TransportSet set);

}  // namespace antipode
