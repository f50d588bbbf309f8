// Materials of an imported file: Assimp's list → engine materials, one for one.
#pragma once

#include <assimp/scene.h>

#include <optional>
#include <string>
#include <vector>

#include "renderengine/scene.h"
#include "scene/gltf_document.h"
#include "scene/assimp_textures.h"

namespace antipode {

/// The classic model of Wavefront MTL and its relatives (Collada, FBX, PLY …):
///  - illum 4–7, or d < 1 with Ni > 1 → Dielectric of index Ni;
///  - illum 3 with black Kd → Mirror of reflectance Ks;
///  - Ks > 0 (and illum ≠ 0, 1) → Phong of exponent Ns; where Kd + Ks > 1 both are scaled down, with a notice;
///  - anything else → Lambert. Ke is emission, unbounded. All are two-sided.
Material importClassicMaterial(const aiScene& file, const aiMaterial& material, TextureTable& textures,
                               std::vector<std::string>& notices);

/// The materials that `file`'s meshes use; entry i belongs to Assimp's material i, unused ones are empty.
/// `gltf` is null for other formats. `strict`: see TextureTable. Throws Error(Input).
std::vector<std::optional<Material>> importMaterials(const aiScene& file, const GltfDocument* gltf,
                                                     const std::string& directory, bool strict, Scene& scene);

}  // namespace antipode
