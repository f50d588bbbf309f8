// Materials of an imported file: Assimp's list → engine materials, one for one.
#pragma once

#include <assimp/scene.h>

#include <optional>
#include <string>
#include <vector>

#include "renderengine/scene.h"
#include "scene/assimp_textures.h"

namespace antipode {

/// The classic model of Collada, FBX, PLY and their relatives:
///  - opacity < 1 with an index of refraction above 1 → Dielectric;
///  - specular > 0 → Phong; where diffuse + specular > 1 both are scaled down, with a notice;
///  - anything else → Lambert. Emission is unbounded. All are two-sided.
Material importClassicMaterial(const aiScene& file, const aiMaterial& material, TextureTable& textures,
                               std::vector<std::string>& notices);

/// The materials that `file`'s meshes use; entry i belongs to Assimp's material i, unused ones are empty.
/// `strict`: see TextureTable. Throws Error(Input).
std::vector<std::optional<Material>> importMaterials(const aiScene& file, const std::string& directory, bool strict,
                                                     Scene& scene);

/// The same for a Wavefront OBJ, from the libraries that it names; moves the texture coordinates of the scene's meshes
/// as they say.
std::vector<std::optional<Material>> importObjMaterials(const aiScene& file, const std::string& path, bool strict,
                                                        Scene& scene);

}  // namespace antipode
