// Materials of Wavefront OBJ: from its own material libraries, since Assimp fills in what they do not say (Kd .6,
// Ks .4) and drops most of what they do.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderengine/scene.h"
#include "scene/mtl_file.h"
#include "scene/texture_table.h"

namespace antipode {

/// What an OBJ says of its libraries, and what they say.
struct ObjLibraries {
    std::map<std::string, MtlMaterial> materials;
    std::vector<std::string> notices;  ///< of libraries that are missing
};

/// Reads the libraries that the OBJ at `path` names; where one is missing, the one that is called as the OBJ is.
ObjLibraries readObjLibraries(const std::string& path);

/// The material of an MTL entry; null for one that no library holds. All are two-sided.
///  - Pr, Pm or their maps → MetallicRoughness, of the specular factor 2·Ks (Ks ½ stands for an index of 1.5),
///    with Pc and Pcr as its clear coat; Lambert where all but Pr are 0;
///  - illum 6, 7, and 4 or 9 with Tf or d below one half → Dielectric of index Ni, or of colour Tf
///    MetallicRoughness that transmits;
///  - illum 5 → MetallicRoughness of index Ni: an opaque colour under a layer that reflects by Fresnel's formulas;
///  - illum 3 with black Kd → Mirror of reflectance Ks;
///  - Ks > 0 (and illum ≠ 0, 1) → Phong of exponent Ns; where Kd + Ks > 1 both are scaled down, with a notice;
///  - anything else → Lambert. Without Kd it is grey, under a texture 1. Ke is emission, unbounded.
/// map_d makes holes below one half; map_Ks counts by its mean; a grey bump map becomes a normal map. What else a
/// statement asks for is said in `notices`.
Material importMtlMaterial(const std::string& name, const MtlMaterial* entry, TextureTable& textures,
                           std::vector<std::string>& notices);

/// Applies -s and -o of the material's maps to the mesh's texture coordinates: those of the first map that has them.
void applyMapTransform(const MtlMaterial& material, Mesh& mesh);

}  // namespace antipode
