#include "scene/import_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "renderengine/error.h"
#include "scene/assimp_textures.h"
#include "scene/import_nodes.h"
#include "scene/mesh_cleanup.h"

namespace antipode {
namespace {

float linearOfSrgb(float encoded) {
    const double v = std::clamp(double(encoded), 0.0, 1.0);
    return float(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
}

/// Scanners and the programs that write OBJ, FBX and Collada keep colours as screens show them. Their alpha, where
/// there is any, is confidence or a mask as often as transparency. Empty where a colour is no number, or where all are
/// white, which changes nothing, or black, which exporters write for none.
std::vector<std::array<float, 4>> shownColors(const aiMesh& from) {
    std::vector<std::array<float, 4>> colors;
    colors.reserve(from.mNumVertices);
    bool areWhite = true, areBlack = true;
    for (unsigned i = 0; i < from.mNumVertices; ++i) {
        const aiColor4D& c = from.mColors[0][i];
        if (!std::isfinite(c.r) || !std::isfinite(c.g) || !std::isfinite(c.b)) return {};
        colors.push_back({linearOfSrgb(c.r), linearOfSrgb(c.g), linearOfSrgb(c.b), 1.0f});
        areWhite = areWhite && c.r >= 1 && c.g >= 1 && c.b >= 1;
        areBlack = areBlack && c.r <= 0 && c.g <= 0 && c.b <= 0;
    }
    if (areWhite || areBlack) colors.clear();
    return colors;
}

/// Further sets of texture coordinates up to this one, the last that the mesh has standing for those it lacks.
std::vector<std::array<float, 2>> furtherUvs(const aiMesh& from, unsigned lastSet) {
    std::vector<std::array<float, 2>> uvs;
    if (!from.HasTextureCoords(0)) return uvs;
    unsigned source = 0;
    for (unsigned set = 1; set <= lastSet; ++set) {
        if (from.HasTextureCoords(set)) source = set;
        for (unsigned i = 0; i < from.mNumVertices; ++i)
            uvs.push_back({from.mTextureCoords[source][i].x, 1.0f - from.mTextureCoords[source][i].y});
    }
    return uvs;
}

/// The mesh in its own space, cleaned.
Mesh convert(const aiMesh& from, unsigned lastUvSet, MeshLosses& losses) {
    Mesh mesh;
    mesh.name = from.mName.C_Str();
    mesh.material = from.mMaterialIndex;
    mesh.positions.reserve(from.mNumVertices);
    for (unsigned i = 0; i < from.mNumVertices; ++i) mesh.positions.push_back(toVec3f(from.mVertices[i]));
    if (from.HasNormals()) {
        mesh.normals.reserve(from.mNumVertices);
        for (unsigned i = 0; i < from.mNumVertices; ++i) {
            const Vec3f n = toVec3f(from.mNormals[i]);
            losses.normalsNotFinite += !isFinite(n);
            mesh.normals.push_back(isFinite(n) ? n : Vec3f{});  // the face's own
        }
    }
    if (from.HasTextureCoords(0)) {
        mesh.uvs.reserve(from.mNumVertices);
        // Assimp puts v = 0 at the bottom of an image, the engine at its first row.
        for (unsigned i = 0; i < from.mNumVertices; ++i)
            mesh.uvs.push_back({from.mTextureCoords[0][i].x, 1.0f - from.mTextureCoords[0][i].y});
    }
    mesh.triangles.reserve(from.mNumFaces);
    for (unsigned i = 0; i < from.mNumFaces; ++i) {
        const aiFace& face = from.mFaces[i];
        if (face.mNumIndices == 3)
            mesh.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
        else
            ++losses.otherPrimitives;
    }
    if (from.HasVertexColors(0)) mesh.colors = shownColors(from);
    mesh.moreUvs = furtherUvs(from, lastUvSet);
    cleanMesh(mesh, losses);
    return mesh;
}

}  // namespace

void checkIndices(const aiScene& file) {
    if (!file.mRootNode) throw Error(ErrorCode::Input, "it holds no objects");
    visitNodes(*file.mRootNode, [&](const aiNode& node, const Affine&) {
        for (unsigned i = 0; i < node.mNumMeshes; ++i)
            if (node.mMeshes[i] >= file.mNumMeshes)
                throw Error(ErrorCode::Input, "node '" + std::string(node.mName.C_Str()) + "' refers to mesh " +
                                                  std::to_string(node.mMeshes[i]) + " of " +
                                                  std::to_string(file.mNumMeshes));
    });
    for (unsigned m = 0; m < file.mNumMeshes; ++m) {
        const aiMesh& mesh = *file.mMeshes[m];
        if (mesh.mMaterialIndex >= file.mNumMaterials)
            throw Error(ErrorCode::Input,
                        "mesh '" + std::string(mesh.mName.C_Str()) + "' refers to a material that does not exist");
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            for (unsigned k = 0; k < mesh.mFaces[f].mNumIndices; ++k) {
                const unsigned index = mesh.mFaces[f].mIndices[k];
                if (index >= mesh.mNumVertices)
                    throw Error(ErrorCode::Input, "mesh '" + std::string(mesh.mName.C_Str()) + "': face " +
                                                      std::to_string(f) + " refers to vertex " + std::to_string(index) +
                                                      " of " + std::to_string(mesh.mNumVertices));
            }
        }
    }
}

void importMeshes(const aiScene& file, Scene& scene) {
    MeshLosses losses;
    std::vector<unsigned> lastUvSets;
    for (unsigned i = 0; i < file.mNumMaterials; ++i) lastUvSets.push_back(lastUvSetOf(*file.mMaterials[i]));
    std::vector<unsigned> usesLeft(file.mNumMeshes, 0);
    visitNodes(*file.mRootNode, [&](const aiNode& node, const Affine&) {
        for (unsigned i = 0; i < node.mNumMeshes; ++i) ++usesLeft[node.mMeshes[i]];
    });
    std::vector<std::optional<Mesh>> converted(file.mNumMeshes);
    visitNodes(*file.mRootNode, [&](const aiNode& node, const Affine& toWorld) {
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            const unsigned index = node.mMeshes[i];
            std::optional<Mesh>& source = converted[index];
            if (!source)
                source = convert(*file.mMeshes[index], lastUvSets[file.mMeshes[index]->mMaterialIndex], losses);
            // Most meshes stand in one place; only repeated ones are worth a copy.
            Mesh mesh = --usesLeft[index] == 0 ? std::move(*source) : *source;
            if (mesh.triangles.empty()) continue;
            transformMesh(mesh, toWorld);
            losses.degenerate += dropDegenerateTriangles(mesh);
            checkMesh(mesh);
            if (!mesh.triangles.empty()) scene.meshes.push_back(std::move(mesh));
        }
    });
    losses.addNotices(scene.notices);
}

}  // namespace antipode
