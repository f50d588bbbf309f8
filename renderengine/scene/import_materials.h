// Materials of an imported file: Assimp's list → engine materials, one for one.
#pragma once

#include <assimp/scene.h>

#include <optional>
#include <string>
#include <vector>

#include "renderengine/scene.h"
#include "scene/collada_document.h"
#include "scene/model_format.h"
#include "scene/assimp_textures.h"

namespace antipode {

/// What decides how the numbers of a file's materials are read.
struct MaterialSource {
    const aiScene& file;
    ModelFormat format;
    const ColladaDocument* collada;  ///< null for other formats
};

/// The classic model of Collada, FBX, 3DS and their relatives:
///  - opacity below one half with an index of refraction above 1 → Dielectric;
///  - specular > 0 → Phong; where diffuse + specular > 1 both are scaled down, with a notice;
///  - anything else → Lambert. Emission is unbounded. All are two-sided.
/// Opacity below one is coverage where nothing refracts, of 0 a notice; the alpha of a texture counts where it stands
/// for opacity as well. FBX's SpecularFactor scales the highlight, and its textures replace colours; what Blender wrote
/// as FBX is the principled material that it was, without transmission. Collada's highlights are the document's. STL
/// and PLY are grey where they have no material of their own. Textures that nothing here uses are named in a notice.
Material importClassicMaterial(const MaterialSource& source, const aiMaterial& material, TextureTable& textures,
                               std::vector<std::string>& notices);

/// The materials that the file's meshes use; entry i belongs to Assimp's material i, unused ones are empty.
/// `strict`: see TextureTable. Throws Error(Input).
std::vector<std::optional<Material>> importMaterials(const MaterialSource& source, const std::string& directory,
                                                     bool strict, Scene& scene);

/// The same for a Wavefront OBJ, from the libraries that it names; moves the texture coordinates of the scene's meshes
/// as they say.
std::vector<std::optional<Material>> importObjMaterials(const aiScene& file, const std::string& path, bool strict,
                                                        Scene& scene);

}  // namespace antipode
