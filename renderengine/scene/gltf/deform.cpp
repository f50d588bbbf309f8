#include "scene/gltf/deform.h"

#include <algorithm>
#include <utility>

#include "renderengine/error.h"
#include "scene/gltf/accessors.h"

namespace antipode::gltf {
namespace {

[[noreturn]] void failIn(const Mesh& mesh, const std::string& why) {
    throw Error(ErrorCode::Input, "mesh '" + mesh.name + "': " + why);
}

/// m += w·a.
void addScaled(Affine& m, const Affine& a, double w) {
    m.x += a.x * w;
    m.y += a.y * w;
    m.z += a.z * w;
    m.offset += a.offset * w;
}

/// The mean of the matrices that hold vertex i, or `unbound`.
Affine blended(const std::vector<Influences>& sets, size_t i, const Deformation& deformation, const Mesh& mesh) {
    Affine sum{{}, {}, {}, {}};
    double total = 0;
    for (const Influences& set : sets) {
        for (size_t k = 0; k < 4; ++k) {
            const double weight = set.weights[i][k];
            if (weight == 0) continue;
            const float joint = set.joints[i][k];
            if (!(joint >= 0 && joint < float(deformation.jointMatrices.size())))
                failIn(mesh, "vertex " + std::to_string(i) + " hangs from a joint that its skin does not have");
            addScaled(sum, deformation.jointMatrices[size_t(joint)], weight);
            total += weight;
        }
    }
    if (!(total > 0)) return deformation.unbound;
    Affine mean{{}, {}, {}, {}};
    addScaled(mean, sum, 1 / total);
    return mean;
}

}  // namespace

void applyMorphTargets(const Document& document, const json& primitive, const std::vector<double>& weights,
                       Mesh& mesh) {
    const json& targets = list(primitive, "targets");
    for (size_t t = 0; t < std::min(targets.size(), weights.size()); ++t) {
        if (weights[t] == 0) continue;
        const auto displace = [&](const char* semantic, auto& values) {
            const auto accessor = reference(targets[t], semantic);
            if (!accessor || values.empty()) return;
            const Values by = readFloats(document, *accessor, 3);
            if (by.count != values.size())
                failIn(mesh, "morph target " + std::to_string(t) + " has " + std::to_string(by.count) + " values of " +
                                 semantic + " for " + std::to_string(values.size()) + " vertices");
            for (size_t i = 0; i < by.count; ++i)
                for (int axis = 0; axis < 3; ++axis)
                    values[i][axis] += float(weights[t] * double(by.numbers[3 * i + size_t(axis)]));
        };
        displace("POSITION", mesh.positions);
        displace("NORMAL", mesh.normals);
        displace("TANGENT", mesh.tangents);
    }
}

void applySkin(const std::vector<Influences>& sets, const Deformation& deformation, Mesh& mesh) {
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const Affine map = blended(sets, i, deformation, mesh);
        mesh.positions[i] = Vec3f(map.point(Vec3d(mesh.positions[i])));
        // Scaled, so that a small model's normals are not taken for none.
        if (!mesh.normals.empty()) {
            const Vec3d n = map.normal(Vec3d(mesh.normals[i]));
            const double size = length(n);
            mesh.normals[i] = size > 0 ? Vec3f(n / size) : Vec3f{};
        }
        if (!mesh.tangents.empty()) {
            auto& t = mesh.tangents[i];
            const Vec3d image = map.vector(Vec3d(t[0], t[1], t[2]));
            const double size = length(image);
            if (size > 0) t = {float(image.x / size), float(image.y / size), float(image.z / size), t[3]};
        }
    }
    // Joints that mirror turn fronts over; triangles are turned back.
    const auto& joints = deformation.jointMatrices;
    if (std::all_of(joints.begin(), joints.end(), [](const Affine& m) { return m.determinant() < 0; })) {
        for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
        for (auto& t : mesh.tangents) t[3] = -t[3];
    }
}

std::vector<Affine> jointMatrices(const Document& document, size_t index, const std::vector<Affine>& nodesToWorld) {
    const json& skin = entry(document.json, "skins", index);
    const json& joints = list(skin, "joints");
    Values inverse;
    if (const auto accessor = reference(skin, "inverseBindMatrices")) {
        inverse = readFloats(document, *accessor, 16);
        if (inverse.count < joints.size()) fail("skin " + std::to_string(index) + " has fewer matrices than joints");
    }
    std::vector<Affine> matrices;
    for (size_t i = 0; i < joints.size(); ++i) {
        const uint64_t node = natural(joints[i]);
        entry(document.json, "nodes", node);
        Affine bind;
        if (inverse.count > 0) {
            const float* m = inverse.numbers.data() + 16 * i;
            bind = {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
        }
        matrices.push_back(nodesToWorld[node] * bind);
    }
    return matrices;
}

}  // namespace antipode::gltf
