// Material and texture records.
#pragma once

#include <array>

#include "gpu/packed_scene.h"

namespace antipode {

/// Fills materials, textureInfo and texels, and the features and lobes that they call for.
void packMaterials(const Scene& scene, PackedScene& packed);

/// Linear values of a texture's bytes.
std::array<float, 256> decodeTable(bool srgb);

/// Whether what leaves the surface follows from what came: nothing merges there.
bool isSpecular(const Material& m);
/// Whether of part of what leaves the surface that is so: of all where isSpecular(), else of smooth glass in it.
bool hasSpecularPart(const Material& m);
/// Whether the surface neither reflects nor transmits, whatever its textures hold.
bool isBlack(const Material& m);
/// n_F − n_C of a body of glass, by which it disperses light; 0 where its index is the same at all wavelengths.
float indexSpread(const Material& m);
/// Whether part of the light passes the surface as if it were not there.
bool blends(const Material& m);
/// Whether look-ups of the base colour's alpha decide where the surface is.
bool hasHoles(const Material& m);
/// Whether no alpha reaches the cut-off, not even where there is no texture: nothing of the surface is there.
bool isHole(const Material& m);

}  // namespace antipode
