#include "scene/import_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "renderengine/error.h"
#include "scene/import_nodes.h"
#include "scene/mesh_cleanup.h"

namespace antipode {
namespace {

float linearOfSrgb(float encoded) {
    const double v = std::clamp(double(encoded), 0.0, 1.0);
    return float(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
}

/// Scanners write the colours of photographs. Their alpha, where there is any, is confidence as often as transparency.
std::vector<std::array<float, 4>> scannedColors(const aiMesh& from) {
    std::vector<std::array<float, 4>> colors;
    colors.reserve(from.mNumVertices);
    for (unsigned i = 0; i < from.mNumVertices; ++i) {
        const aiColor4D& c = from.mColors[0][i];
        colors.push_back({linearOfSrgb(c.r), linearOfSrgb(c.g), linearOfSrgb(c.b), 1.0f});
    }
    return colors;
}

/// The mesh in its own space, cleaned.
Mesh convert(const aiMesh& from, ModelFormat format, MeshLosses& losses) {
    Mesh mesh;
    mesh.name = from.mName.C_Str();
    mesh.material = from.mMaterialIndex;
    mesh.positions.reserve(from.mNumVertices);
    for (unsigned i = 0; i < from.mNumVertices; ++i) mesh.positions.push_back(toVec3f(from.mVertices[i]));
    if (from.HasNormals()) {
        mesh.normals.reserve(from.mNumVertices);
        for (unsigned i = 0; i < from.mNumVertices; ++i) mesh.normals.push_back(toVec3f(from.mNormals[i]));
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
    if (from.HasVertexColors(0) && format == ModelFormat::Ply)
        mesh.colors = scannedColors(from);
    else
        losses.vertexColors |= from.HasVertexColors(0);
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

void importMeshes(const aiScene& file, ModelFormat format, Scene& scene) {
    MeshLosses losses;
    std::vector<unsigned> usesLeft(file.mNumMeshes, 0);
    visitNodes(*file.mRootNode, [&](const aiNode& node, const Affine&) {
        for (unsigned i = 0; i < node.mNumMeshes; ++i) ++usesLeft[node.mMeshes[i]];
    });
    std::vector<std::optional<Mesh>> converted(file.mNumMeshes);
    visitNodes(*file.mRootNode, [&](const aiNode& node, const Affine& toWorld) {
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            const unsigned index = node.mMeshes[i];
            std::optional<Mesh>& source = converted[index];
            if (!source) source = convert(*file.mMeshes[index], format, losses);
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
