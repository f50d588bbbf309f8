// Materials of the schema to and from the engine's.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "proto/scene.pb.h"
#include "renderengine/scene.h"

namespace antipode {

/// Finds the index of a texture by its reference in the schema; throws Error(Input) where there is none.
using TextureLookup = std::function<uint32_t(const std::string& reference, const std::string& where)>;

/// Adds to `notices` which of the fields that are set have no effect on a material of this kind. Throws Error(Input).
Material readMaterial(const schema::Material& material, const TextureLookup& textures,
                      std::vector<std::string>& notices);

/// Every field, so that reading it back gives the same material bit for bit.
void writeMaterial(const Material& material, schema::Material* out);

}  // namespace antipode
