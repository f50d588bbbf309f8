// Text from files that others wrote, on its way to people and over the wire.
#pragma once

#include <string>
#include <string_view>

#include "renderengine/scene.h"

namespace antipode {

bool isUtf8(std::string_view text);

/// UTF-8 without control characters: text that is no UTF-8 is taken for Latin-1, control characters become '?', and
/// what is longer than `longest` bytes ends in an ellipsis.
std::string readableText(std::string_view text, size_t longest = 500);

/// Applies it to all names (200 bytes) and notices of a scene, which stand in messages, go over the wire and into the
/// output's metadata.
void makeNamesReadable(Scene& scene);

}  // namespace antipode
