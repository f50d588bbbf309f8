// Material and texture records.
#pragma once

#include "gpu/packed_scene.h"

namespace antipode {

/// Fills materials, textureInfo and texels, and the features that they call for.
void packMaterials(const Scene& scene, bool roulette, PackedScene& packed);

/// Mean of a texture's linear RGB; 1 where there is none.
Vec3d meanColor(const Scene& scene, const TextureIndex& texture);

}  // namespace antipode
