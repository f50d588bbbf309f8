#include "scene/mesh_cleanup.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

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

/// All attributes of a mesh's vertices as numbers: of each, where it starts and how many a vertex has.
class VertexBits {
public:
    explicit VertexBits(const Mesh& mesh) {
        add(mesh.positions), add(mesh.normals), add(mesh.uvs), add(mesh.colors), add(mesh.tangents);
        for (size_t set = 0; set < mesh.moreUvs.size(); set += mesh.positions.size())
            columns_.push_back({mesh.moreUvs[set].data(), 2});
    }

    bool same(size_t i, size_t j) const {
        return std::all_of(columns_.begin(), columns_.end(), [&](const Column& c) {
            return std::memcmp(c.first + i * c.width, c.first + j * c.width, c.width * sizeof(float)) == 0;
        });
    }

    uint64_t hash(size_t i) const {
        uint64_t h = 0xcbf29ce484222325u;
        for (const Column& c : columns_) {
            for (size_t k = 0; k < c.width; ++k) {
                h = (h ^ std::bit_cast<uint32_t>(c.first[i * c.width + k])) * 0x9e3779b97f4a7c15u;
                h ^= h >> 29;
            }
        }
        return h;
    }

private:
    struct Column {
        const float* first;
        size_t width;
    };

    template <class T>
    void add(const std::vector<T>& values) {
        if (!values.empty())
            columns_.push_back({reinterpret_cast<const float*>(values.data()), sizeof(T) / sizeof(float)});
    }

    std::vector<Column> columns_;
};

/// The entries `order` of a list, or of each of its stretches of `length`.
template <class T>
void gather(std::vector<T>& values, const std::vector<uint32_t>& order, size_t length) {
    std::vector<T> gathered;
    for (size_t begin = 0; begin < values.size(); begin += length)
        for (uint32_t i : order) gathered.push_back(values[begin + i]);
    values = std::move(gathered);
}

template <size_t n>
bool isFinite(const std::array<float, n>& v) {
    return std::all_of(v.begin(), v.end(), [](float x) { return std::isfinite(x); });
}

}  // namespace

void checkMesh(const Mesh& mesh) {
    const size_t count = mesh.positions.size();
    if (!mesh.normals.empty() && mesh.normals.size() != count)
        fail(mesh, std::to_string(mesh.normals.size()) + " normals for " + std::to_string(count) + " positions");
    if (!mesh.uvs.empty() && mesh.uvs.size() != count)
        fail(mesh, std::to_string(mesh.uvs.size()) + " uvs for " + std::to_string(count) + " positions");
    if (!mesh.colors.empty() && mesh.colors.size() != count)
        fail(mesh, std::to_string(mesh.colors.size()) + " colours for " + std::to_string(count) + " positions");
    if (!mesh.tangents.empty() && mesh.tangents.size() != count)
        fail(mesh, std::to_string(mesh.tangents.size()) + " tangents for " + std::to_string(count) + " positions");
    if (!mesh.moreUvs.empty() && (count == 0 || mesh.moreUvs.size() % count != 0))
        fail(mesh, std::to_string(mesh.moreUvs.size()) + " further uvs for " + std::to_string(count) + " positions");
    for (size_t i = 0; i < count; ++i) {
        if (!isFinite(mesh.positions[i])) fail(mesh, "position " + std::to_string(i) + " is not finite");
        if (!mesh.normals.empty() && !isFinite(mesh.normals[i]))
            fail(mesh, "normal " + std::to_string(i) + " is not finite");
        if (!mesh.uvs.empty() && !(std::isfinite(mesh.uvs[i][0]) && std::isfinite(mesh.uvs[i][1])))
            fail(mesh, "uv " + std::to_string(i) + " is not finite");
        if (!mesh.tangents.empty() && !isFinite(mesh.tangents[i]))
            fail(mesh, "tangent " + std::to_string(i) + " is not finite");
        if (!mesh.colors.empty())
            for (float c : mesh.colors[i])
                if (!(c >= 0 && c <= 1)) fail(mesh, "colour " + std::to_string(i) + " lies outside [0,1]");
    }
    for (size_t i = 0; i < mesh.moreUvs.size(); ++i)
        if (!isFinite(mesh.moreUvs[i])) fail(mesh, "further uv " + std::to_string(i) + " is not finite");
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
    const VertexBits bits(mesh);
    const size_t count = mesh.positions.size();
    std::vector<uint32_t> slots(std::bit_ceil(2 * count + 1), kFree);  // new indices, by their vertices' bits
    std::vector<uint32_t> newIndex(count, kFree), order;
    const auto place = [&](uint32_t old) {
        size_t slot = bits.hash(old) & (slots.size() - 1);
        while (slots[slot] != kFree && !bits.same(order[slots[slot]], old)) slot = (slot + 1) & (slots.size() - 1);
        if (slots[slot] == kFree) {
            slots[slot] = uint32_t(order.size());
            order.push_back(old);
        }
        return slots[slot];
    };
    for (auto& triangle : mesh.triangles) {
        for (uint32_t& index : triangle) {
            if (newIndex[index] == kFree) newIndex[index] = place(index);
            index = newIndex[index];
        }
    }
    gather(mesh.positions, order, count);
    gather(mesh.normals, order, count);
    gather(mesh.uvs, order, count);
    gather(mesh.moreUvs, order, count);
    gather(mesh.colors, order, count);
    gather(mesh.tangents, order, count);
}

void MeshLosses::addNotices(std::vector<std::string>& notices) const {
    if (degenerate > 0) notices.push_back(std::to_string(degenerate) + " triangles without area were dropped.");
    if (otherPrimitives > 0) notices.push_back(std::to_string(otherPrimitives) + " points and lines were dropped.");
    if (normalsNotFinite > 0)
        notices.push_back(std::to_string(normalsNotFinite) +
                          " normals are not finite; the normals of faces stand for them.");
    for (const std::string& name : constantNormals)
        notices.push_back("Mesh '" + name + "' has one normal for faces of several directions; it is shaded flat.");
    for (const std::string& name : withoutPositions)
        notices.push_back("Mesh '" + name + "' has a part without positions, which was left out.");
    for (const std::string& name : withoutUvs)
        notices.push_back("Mesh '" + name + "' lacks texture coordinates that its material's textures ask for.");
    for (const std::string& name : clampedColors)
        notices.push_back("Mesh '" + name + "' has vertex colours outside [0,1], which were clamped.");
}

void cleanMesh(Mesh& mesh, MeshLosses& losses) {
    checkMesh(mesh);
    losses.degenerate += dropDegenerateTriangles(mesh);
    normalizeNormals(mesh);
    if (dropIdleNormals(mesh)) losses.constantNormals.push_back(mesh.name);
    joinVertices(mesh);
}

}  // namespace antipode
