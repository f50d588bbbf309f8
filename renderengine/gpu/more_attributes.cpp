#include "gpu/more_attributes.h"

#include <algorithm>
#include <bit>

namespace antipode {
namespace {

using namespace shared;

uint bits(float value) { return std::bit_cast<uint>(value); }
uvec4 texel(const std::array<float, 4>& v) { return {bits(v[0]), bits(v[1]), bits(v[2]), bits(v[3])}; }

}  // namespace

MoreAttributes::MoreAttributes(const Scene& scene) {
    for (const Texture& texture : scene.textures) furtherUvSets_ = std::max(furtherUvSets_, texture.uvSet);
    for (const Mesh& mesh : scene.meshes) {
        if (!mesh.colors.empty()) features_ |= FEATURE_VERTEX_COLORS;
        if (!mesh.tangents.empty() && scene.materials[mesh.material].normalTexture) features_ |= FEATURE_TANGENTS;
    }
    texels_ = (features_ & FEATURE_TANGENTS ? 3 : 0) + (features_ & FEATURE_VERTEX_COLORS ? 3 : 0) + 2 * furtherUvSets_;
}

void MoreAttributes::pack(const Mesh& mesh, const std::array<uint32_t, 3>& t, std::vector<uvec4>& to) const {
    const auto add = [&](const std::vector<std::array<float, 4>>& values, const std::array<float, 4>& otherwise) {
        for (uint32_t i : t) to.push_back(texel(values.empty() ? otherwise : values[i]));
    };
    if (features_ & FEATURE_TANGENTS) add(mesh.tangents, {});
    if (features_ & FEATURE_VERTEX_COLORS) add(mesh.colors, {1, 1, 1, 1});
    for (uint32_t set = 1; set <= furtherUvSets_; ++set) {
        const auto [a, b, c] = uvsOf(mesh, t, set);
        to.push_back(texel({a[0], a[1], b[0], b[1]}));
        to.push_back(texel({c[0], c[1], 0, 0}));
    }
}

void MoreAttributes::packSphere(std::vector<uvec4>& to) const { pack(Mesh{}, {}, to); }

UvTriangle uvsOf(const Mesh& mesh, const std::array<uint32_t, 3>& t, uint32_t set) {
    const std::vector<std::array<float, 2>>& uvs = set > 0 && !mesh.moreUvs.empty() ? mesh.moreUvs : mesh.uvs;
    const size_t begin = &uvs == &mesh.moreUvs ? (set - 1) * mesh.positions.size() : 0;
    if (begin >= uvs.size()) return {};
    return {uvs[begin + t[0]], uvs[begin + t[1]], uvs[begin + t[2]]};
}

}  // namespace antipode
