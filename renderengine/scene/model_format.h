// Which format a model is in, where that decides what its numbers mean.
#pragma once

#include <string>

namespace antipode {

enum class ModelFormat { Wavefront, Fbx, Collada, Stl, Ply, Other };

/// By the extension, in any case.
ModelFormat formatOf(const std::string& path);

}  // namespace antipode
