#include "scene/mesh_cleanup.h"

#include <bit>
#include <cmath>
#include <string>

#include "renderengine/error.h"

namespace antipode {
namespace {

[[noreturn]] void fail(const Mesh& mesh, const std::string& what) {
    throw Error(ErrorCode::Input, "mesh '" + mesh.name + "': " + what);
}

Vec3d areaVector(const Mesh& mesh, const std::array<uint32_t, 3>& t) {
    const Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    return cross(b - a, c - a);
}

/// All the bits of one vertex; missing attributes count as zero.
struct VertexBits {
    std::array<uint32_t, 8> words{};
    bool operator==(const VertexBits&) const = default;

    VertexBits(const Mesh& mesh, size_t i) {
        const auto put = [&](size_t at, float value) { words[at] = std::bit_cast<uint32_t>(value); };
        for (int axis = 0; axis < 3; ++axis) {
            put(axis, mesh.positions[i][axis]);
            if (!mesh.normals.empty()) put(3 + axis, mesh.normals[i][axis]);
        }
        if (!mesh.uvs.empty()) put(6, mesh.uvs[i][0]), put(7, mesh.uvs[i][1]);
    }

    uint64_t hash() const {
        uint64_t h = 0xcbf29ce484222325u;
        for (uint32_t word : words) {
            h = (h ^ word) * 0x9e3779b97f4a7c15u;
            h ^= h >> 29;
        }
        return h;
    }
};

}  // namespace

void checkMesh(const Mesh& mesh) {
    const size_t count = mesh.positions.size();
    if (!mesh.normals.empty() && mesh.normals.size() != count)
        fail(mesh, std::to_string(mesh.normals.size()) + " normals for " + std::to_string(count) + " positions");
    if (!mesh.uvs.empty() && mesh.uvs.size() != count)
        fail(mesh, std::to_string(mesh.uvs.size()) + " uvs for " + std::to_string(count) + " positions");
    for (size_t i = 0; i < count; ++i) {
        if (!isFinite(mesh.positions[i])) fail(mesh, "position " + std::to_string(i) + " is not finite");
        if (!mesh.normals.empty() && !isFinite(mesh.normals[i]))
            fail(mesh, "normal " + std::to_string(i) + " is not finite");
        if (!mesh.uvs.empty() && !(std::isfinite(mesh.uvs[i][0]) && std::isfinite(mesh.uvs[i][1])))
            fail(mesh, "uv " + std::to_string(i) + " is not finite");
    }
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (uint32_t index : mesh.triangles[t]) {
            if (index >= count)
                fail(mesh, "triangle " + std::to_string(t) + " refers to vertex " + std::to_string(index) + " of " +
                               std::to_string(count));
        }
    }
}

size_t dropDegenerateTriangles(Mesh& mesh) {
    return std::erase_if(mesh.triangles, [&](const auto& t) {
        const Vec3d area = areaVector(mesh, t);
        return area.x == 0 && area.y == 0 && area.z == 0;
    });
}

void normalizeNormals(Mesh& mesh) {
    if (mesh.normals.empty()) return;
    for (const auto& t : mesh.triangles) {
        for (uint32_t i : t) {
            if (mesh.normals[i] == Vec3f{}) mesh.normals[i] = Vec3f(normalize(areaVector(mesh, t)));
        }
    }
    for (Vec3f& n : mesh.normals) {
        const double squared = dot(Vec3d(n), Vec3d(n));
        // Three roundings of unit components move the square by no more than this.
        if (squared != 0 && std::abs(squared - 1) > 4e-7) n = Vec3f(Vec3d(n) / std::sqrt(squared));
    }
}

bool dropIdleNormals(Mesh& mesh) {
    if (mesh.normals.empty() || mesh.triangles.empty()) return false;
    constexpr float tolerance = 1e-6f;  // on the cosine's complement: unit normals in floats agree no better
    bool flat = true, constant = true, oneDirection = true;
    const Vec3f first = mesh.normals[mesh.triangles.front()[0]];
    const Vec3f firstFace(normalize(areaVector(mesh, mesh.triangles.front())));
    for (const auto& t : mesh.triangles) {
        const Vec3f face(normalize(areaVector(mesh, t)));
        oneDirection = oneDirection && 1.0f - dot(face, firstFace) < tolerance;
        for (uint32_t i : t) {
            flat = flat && 1.0f - dot(mesh.normals[i], face) < tolerance;
            constant = constant && mesh.normals[i] == first;
        }
    }
    const bool contradictory = constant && !oneDirection;
    if (flat || contradictory) mesh.normals.clear();
    return contradictory;
}

void joinVertices(Mesh& mesh) {
    constexpr uint32_t kFree = 0xffffffffu;
    std::vector<uint32_t> slots(std::bit_ceil(2 * mesh.positions.size() + 1), kFree);
    std::vector<uint32_t> newIndex(mesh.positions.size(), kFree);
    Mesh joined;
    const auto place = [&](uint32_t old) {
        const VertexBits bits(mesh, old);
        size_t slot = bits.hash() & (slots.size() - 1);
        while (slots[slot] != kFree && !(VertexBits(joined, slots[slot]) == bits))
            slot = (slot + 1) & (slots.size() - 1);
        if (slots[slot] == kFree) {
            slots[slot] = uint32_t(joined.positions.size());
            joined.positions.push_back(mesh.positions[old]);
            if (!mesh.normals.empty()) joined.normals.push_back(mesh.normals[old]);
            if (!mesh.uvs.empty()) joined.uvs.push_back(mesh.uvs[old]);
        }
        return slots[slot];
    };
    for (auto& triangle : mesh.triangles) {
        for (uint32_t& index : triangle) {
            if (newIndex[index] == kFree) newIndex[index] = place(index);
            index = newIndex[index];
        }
    }
    mesh.positions = std::move(joined.positions);
    mesh.normals = std::move(joined.normals);
    mesh.uvs = std::move(joined.uvs);
}

void MeshLosses::addNotices(std::vector<std::string>& notices) const {
    if (degenerate > 0) notices.push_back(std::to_string(degenerate) + " triangles without area were dropped.");
    if (otherPrimitives > 0) notices.push_back(std::to_string(otherPrimitives) + " points and lines were dropped.");
    for (const std::string& name : constantNormals)
        notices.push_back("Mesh '" + name + "' has one normal for faces of several directions; it is shaded flat.");
    for (const std::string& name : withoutPositions)
        notices.push_back("Mesh '" + name + "' has a part without positions, which was left out.");
    if (vertexColors) notices.push_back("Vertex colours are ignored.");
}

void cleanMesh(Mesh& mesh, MeshLosses& losses) {
    checkMesh(mesh);
    losses.degenerate += dropDegenerateTriangles(mesh);
    normalizeNormals(mesh);
    if (dropIdleNormals(mesh)) losses.constantNormals.push_back(mesh.name);
    joinVertices(mesh);
}

}  // namespace antipode
