#include "scene/gltf/primitives.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "renderengine/error.h"
#include "scene/gltf/accessors.h"
#include "scene/gltf/draco.h"

namespace antipode::gltf {
namespace {

enum Mode { kPoints = 0, kLines = 1, kLineLoop = 2, kLineStrip = 3, kTriangles = 4, kStrip = 5, kFan = 6 };

[[noreturn]] void failIn(const std::string& mesh, const std::string& why) {
    throw Error(ErrorCode::Input, "mesh '" + mesh + "': " + why);
}

/// What a primitive's attributes and indices are, compressed or not.
class Source {
public:
    Source(const Document& document, const json& primitive, const std::string& mesh)
        : document_(document), primitive_(primitive), attributes_(object(primitive, "attributes")), mesh_(mesh) {
        if (object(primitive, "extensions").contains("KHR_draco_mesh_compression"))
            compressed_ = decodeDraco(document, primitive);
    }

    /// Nothing where there is no such attribute. `vertices`: how many there must be; 0: any number.
    std::optional<Values> attribute(const std::string& semantic, int components, size_t vertices,
                                    Integers integers = Integers::Themselves) const {
        std::optional<Values> values;
        const auto decoded = compressed_.attributes.find(semantic);
        if (decoded != compressed_.attributes.end())
            values = decoded->second;
        else if (const auto accessor = reference(attributes_, semantic.c_str()))
            values = readFloats(document_, *accessor, integers);
        if (values) check(*values, semantic, components, vertices);
        return values;
    }

    /// Three or four numbers a vertex, integers as fractions.
    std::optional<Values> colors(size_t vertices) const {
        const auto accessor = reference(attributes_, "COLOR_0");
        if (!accessor) return {};
        const bool rgb = entry(document_.json, "accessors", *accessor).value("type", "") == "VEC3";
        return attribute("COLOR_0", rgb ? 3 : 4, vertices, Integers::Fractions);
    }

    /// Three a triangle, two a line …, as the primitive's mode says.
    std::vector<uint32_t> corners(size_t vertices) const {
        if (!compressed_.corners.empty()) return compressed_.corners;
        if (const auto indices = reference(primitive_, "indices")) return readIntegers(document_, *indices);
        std::vector<uint32_t> all(vertices);
        std::iota(all.begin(), all.end(), 0u);
        return all;
    }

private:
    void check(const Values& values, const std::string& semantic, int components, size_t vertices) const {
        if (values.components != components)
            failIn(mesh_, semantic + " has " + std::to_string(values.components) + " numbers a vertex, not " +
                              std::to_string(components));
        if (vertices != 0 && values.count != vertices)
            failIn(mesh_, std::to_string(values.count) + " values of " + semantic + " for " + std::to_string(vertices) +
                              " positions");
    }

    const Document& document_;
    const json &primitive_, &attributes_;
    const std::string& mesh_;
    DracoGeometry compressed_;
};

std::vector<Vec3f> toVectors(const Values& values) {
    std::vector<Vec3f> vectors(values.count);
    for (size_t i = 0; i < values.count; ++i)
        vectors[i] = {values.numbers[3 * i], values.numbers[3 * i + 1], values.numbers[3 * i + 2]};
    return vectors;
}

std::vector<std::array<float, 2>> toPairs(const Values& values) {
    std::vector<std::array<float, 2>> pairs(values.count);
    for (size_t i = 0; i < values.count; ++i) pairs[i] = {values.numbers[2 * i], values.numbers[2 * i + 1]};
    return pairs;
}

size_t lineCount(Mode mode, size_t corners) {
    switch (mode) {
        case kLines: return corners / 2;
        case kLineStrip: return corners - 1;
        default: return corners;
    }
}

std::vector<std::array<uint32_t, 3>> toTriangles(Mode mode, const std::vector<uint32_t>& corners) {
    std::vector<std::array<uint32_t, 3>> triangles;
    const auto add = [&](size_t a, size_t b, size_t c) {
        const uint32_t i = corners[a], j = corners[b], k = corners[c];
        if (mode == kTriangles || (i != j && j != k && k != i)) triangles.push_back({i, j, k});
    };
    if (mode == kTriangles) {
        triangles.reserve(corners.size() / 3);
        for (size_t i = 0; i + 2 < corners.size(); i += 3) add(i, i + 1, i + 2);
    } else {
        // Every second triangle of a strip is turned over, so that all face one way (glTF 2.0, 3.7.2.1).
        for (size_t i = 0; i + 2 < corners.size(); ++i)
            mode == kFan ? add(i + 1, i + 2, 0) : add(i, i + 1 + i % 2, i + 2 - i % 2);
    }
    return triangles;
}

/// The sets of texture coordinates that the material asks for, one after the other.
std::vector<std::array<float, 2>> readUvs(const Source& source, const VertexNeeds& needs, const Mesh& mesh,
                                          MeshLosses& losses) {
    const std::vector<UvStream> streams = needs.uvStreams.empty() ? std::vector(1, UvStream{}) : needs.uvStreams;
    std::vector<std::array<float, 2>> all;
    bool any = false;
    for (const UvStream& stream : streams) {
        const auto values = source.attribute("TEXCOORD_" + std::to_string(stream.texCoord), 2, mesh.positions.size());
        if (!values && needs.textured) losses.withoutUvs.insert(mesh.name);
        any = any || values;
        const size_t begin = all.size();
        all.resize(begin + mesh.positions.size());
        if (values) {
            const auto uvs = toPairs(*values);
            std::transform(uvs.begin(), uvs.end(), all.begin() + std::ptrdiff_t(begin), stream);
        }
    }
    if (!any) all.clear();
    return all;
}

std::vector<std::array<float, 4>> toQuadruples(const Values& values, float fourth) {
    std::vector<std::array<float, 4>> quadruples(values.count, {0, 0, 0, fourth});
    for (size_t i = 0; i < values.count; ++i)
        std::copy_n(values.numbers.begin() + std::ptrdiff_t(i) * values.components, values.components,
                    quadruples[i].begin());
    return quadruples;
}

/// Vertex colours; empty where all are white and change nothing.
std::vector<std::array<float, 4>> readColors(const Source& source, const Mesh& mesh, MeshLosses& losses) {
    const auto values = source.colors(mesh.positions.size());
    if (!values) return {};
    auto colors = toQuadruples(*values, 1);
    bool white = true;
    for (auto& color : colors) {
        for (float& channel : color) {
            white = white && channel == 1;
            const float clamped = std::clamp(channel, 0.0f, 1.0f);
            if (clamped != channel) losses.clampedColors.insert(mesh.name);
            channel = clamped;
        }
    }
    if (white) colors.clear();
    return colors;
}

/// All sets of joints that hold the vertices.
std::vector<Influences> readInfluences(const Source& source, size_t vertices) {
    std::vector<Influences> sets;
    for (size_t i = 0;; ++i) {
        const std::string number = std::to_string(i);
        const auto joints = source.attribute("JOINTS_" + number, 4, vertices);
        const auto weights = source.attribute("WEIGHTS_" + number, 4, vertices, Integers::Fractions);
        if (!joints || !weights) return sets;
        sets.push_back({toQuadruples(*joints, 0), toQuadruples(*weights, 0)});
    }
}

}  // namespace

bool hasTriangles(const json& primitive) { return natural(primitive, "mode", kTriangles) >= kTriangles; }

Mesh readPrimitive(const Document& document, const json& primitive, const std::string& meshName,
                   const VertexNeeds& needs, const Deformation& deformation, MeshLosses& losses) {
    Mesh mesh;
    mesh.name = meshName;
    const Source source(document, primitive, meshName);
    const auto positions = source.attribute("POSITION", 3, 0);
    if (!positions) {
        losses.withoutPositions.push_back(meshName);
        return mesh;
    }
    mesh.positions = toVectors(*positions);
    const size_t vertices = mesh.positions.size();

    const std::vector<uint32_t> corners = source.corners(vertices);
    for (size_t i = 0; i < corners.size(); ++i)
        if (corners[i] >= vertices)
            failIn(meshName, "index " + std::to_string(i) + " refers to vertex " + std::to_string(corners[i]) + " of " +
                                 std::to_string(vertices));

    const uint64_t mode = natural(primitive, "mode", kTriangles);
    if (mode > kFan) failIn(meshName, "its mode " + std::to_string(mode) + " is unknown");
    if (mode < kTriangles) {
        losses.otherPrimitives += lineCount(Mode(mode), corners.size());
        return mesh;
    }
    mesh.triangles = toTriangles(Mode(mode), corners);
    if (const auto normals = source.attribute("NORMAL", 3, vertices)) mesh.normals = toVectors(*normals);
    mesh.uvs = readUvs(source, needs, mesh, losses);
    if (mesh.uvs.size() > vertices) {
        mesh.moreUvs.assign(mesh.uvs.begin() + std::ptrdiff_t(vertices), mesh.uvs.end());
        mesh.uvs.resize(vertices);
    }
    if (needs.tangents && !mesh.normals.empty())
        if (const auto tangents = source.attribute("TANGENT", 4, vertices)) mesh.tangents = toQuadruples(*tangents, 1);
    if (needs.colors) mesh.colors = readColors(source, mesh, losses);
    if (!deformation.morphWeights.empty()) applyMorphTargets(document, primitive, deformation.morphWeights, mesh);
    if (!deformation.jointMatrices.empty()) applySkin(readInfluences(source, vertices), deformation, mesh);
    return mesh;
}

}  // namespace antipode::gltf
