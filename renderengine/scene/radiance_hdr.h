// Radiance pictures (.hdr, .pic): RGBE with run-length coding (Ward, "Real Pixels", Graphics Gems II, 1991).
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "renderengine/film.h"

namespace antipode {

/// Linear RGB; a mantissa m stands for m/256·2^(e−128), as most programs write it. Pictures stored top row first and
/// left to right ("-Y h +X w") only. Throws Error(Input) naming `name` where the data are no such picture or cut short.
Image decodeRadianceHdr(std::span<const uint8_t> data, const std::string& name);

}  // namespace antipode
