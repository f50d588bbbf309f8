// Preconditions of the image writers.
#pragma once

#include <string>

#include "renderengine/film.h"

namespace antipode {

/// Throws Error(Usage) unless the image has at least one and at most 2^31 − 1 pixels per side and as many pixels as its
/// size says. `path` is where it was to be written.
void requireConsistent(const Image& image, const std::string& path);

}  // namespace antipode
