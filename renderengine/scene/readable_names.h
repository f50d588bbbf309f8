// Names and notices of scenes, as people and other machines may see them.
#pragma once

#include <string>
#include <vector>

#include "renderengine/scene.h"

namespace antipode {

/// Makes all names (200 bytes) and notices of a scene readable text: they stand in messages, go over the wire and into
/// the output's metadata.
void makeNamesReadable(Scene& scene);

/// Of notices that say the same of several materials, or twice of one, keeps the first, with the number of the others.
void foldNotices(std::vector<std::string>& notices);

}  // namespace antipode
