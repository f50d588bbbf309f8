#include "gpu/pack_materials.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "numerics/half.h"

namespace antipode {
namespace {

using namespace shared;

// Below this GGX width a rough interface is treated as smooth: D(h) would leave float's range of exact cosines.
constexpr float smoothAlpha = 1e-4f;

uint bits(float value) { return std::bit_cast<uint>(value); }
uvec4 texel(const Vec3f& v, uint w) { return {bits(v.x), bits(v.y), bits(v.z), w}; }

float srgbToLinear(float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); }

/// Whether one smooth or rough interface of glass is all that the material is.
bool isGlassAlone(const Material& m) {
    return m.transmission == 1.0f && m.metallic == 0.0f && !m.transmissionTexture && !m.metallicRoughnessTexture;
}

/// Glass whose roughness has a texture as the model that knows of one.
Material withTexturedRoughness(Material m) {
    if (m.kind != MaterialKind::RoughDielectric || !m.metallicRoughnessTexture) return m;
    m.kind = MaterialKind::MetallicRoughness;
    m.baseColor = Vec3f(1.0f);
    if (!m.alphaCutoff) m.baseColorTexture.reset();
    m.metallic = 0.0f;
    m.transmission = 1.0f;
    m.transmissionTexture.reset();
    return m;
}

uint kindOf(const Material& m) {
    const float alpha = m.roughness * m.roughness;
    if (m.kind == MaterialKind::MetallicRoughness && isGlassAlone(m))
        return alpha < smoothAlpha || m.ior == 1.0f ? KIND_DIELECTRIC : KIND_ROUGH_DIELECTRIC;
    switch (m.kind) {
        case MaterialKind::Lambert: return KIND_LAMBERT;
        case MaterialKind::Phong: return KIND_PHONG;
        case MaterialKind::Mirror: return KIND_MIRROR;
        case MaterialKind::Dielectric: return KIND_DIELECTRIC;
        case MaterialKind::RoughConductor: return alpha < smoothAlpha ? KIND_CONDUCTOR : KIND_ROUGH_CONDUCTOR;
        // Between equal indices nothing is refracted, and a microfacet's half vector has no direction.
        case MaterialKind::RoughDielectric:
            return alpha < smoothAlpha || m.ior == 1.0f ? KIND_DIELECTRIC : KIND_ROUGH_DIELECTRIC;
        case MaterialKind::MetallicRoughness: return KIND_METALLIC_ROUGHNESS;
    }
    return KIND_LAMBERT;
}

uint lobeOf(uint kind) {
    switch (kind) {
        case KIND_PHONG: return LOBE_PHONG;
        case KIND_MIRROR: return 0;  // every delta lobe begins as one
        case KIND_DIELECTRIC: return LOBE_DIELECTRIC;
        case KIND_CONDUCTOR:
        case KIND_ROUGH_CONDUCTOR: return LOBE_CONDUCTOR;
        case KIND_ROUGH_DIELECTRIC: return LOBE_ROUGH_DIELECTRIC;
        case KIND_METALLIC_ROUGHNESS: return LOBE_METALLIC_ROUGHNESS;
        default: return LOBE_LAMBERT;
    }
}

Vec3f conductorF0(const Vec3f& eta, const Vec3f& k) {
    const Vec3f one(1.0f);
    return ((eta - one) * (eta - one) + k * k) / ((eta + one) * (eta + one) + k * k);
}

/// Fresnel's reflectance of a metal for one channel, as lib/microfacet.glsl has it.
double fresnelConductor(double cosine, double eta, double k) {
    const double c2 = cosine * cosine, s2 = 1 - c2, t0 = eta * eta - k * k - s2;
    const double a2b2 = std::sqrt(t0 * t0 + 4 * eta * eta * k * k), t1 = a2b2 + c2;
    const double t2 = 2 * cosine * std::sqrt(std::max(0.5 * (a2b2 + t0), 0.0));
    const double s = (t1 - t2) / (t1 + t2), t3 = c2 * a2b2 + s2 * s2, t4 = t2 * s2;
    return 0.5 * (s + s * (t3 - t4) / (t3 + t4));
}

/// Its mean over the hemisphere, weighted by the cosine.
Vec3f meanReflectance(const Material& m) {
    constexpr int steps = 200;
    Vec3f mean;
    for (int channel = 0; channel < 3; ++channel) {
        double sum = 0;
        for (int i = 0; i < steps; ++i)
            sum += fresnelConductor(std::sqrt((i + 0.5) / steps), m.conductorEta[channel], m.conductorK[channel]);
        mean[channel] = float(sum / steps);
    }
    return mean;
}

/// Whether metal is part of the material, and rough.
bool isRoughMetal(const Material& m, uint kind) {
    return kind == KIND_ROUGH_CONDUCTOR || (kind == KIND_METALLIC_ROUGHNESS && m.metallic > 0.0f);
}

/// Which channels of the textures that are base colours are anywhere above 0.
std::vector<Vec3f> colouredChannels(const Scene& scene) {
    std::vector<Vec3f> channels(scene.textures.size());
    std::vector<bool> known(scene.textures.size());
    for (const Material& m : scene.materials) {
        if (!m.baseColorTexture || known[*m.baseColorTexture]) continue;
        known[*m.baseColorTexture] = true;
        const std::vector<uint8_t>& rgba = scene.textures[*m.baseColorTexture].rgba;
        for (size_t i = 0; i < rgba.size(); ++i)
            if (i % 4 < 3 && rgba[i] > 0) channels[*m.baseColorTexture][int(i % 4)] = 1.0f;
    }
    return channels;
}

/// The layers over what is not glass of it.
uint layerLobes(const Material& m, uint kind) {
    if (kind != KIND_METALLIC_ROUGHNESS) return 0;
    return (m.clearcoat > 0.0f ? LOBE_CLEARCOAT : 0) | (maxComponent(m.sheenColor) > 0.0f ? LOBE_SHEEN : 0);
}

/// Whether the material reflects or transmits anything.
bool scatters(const Material& m, const std::vector<Vec3f>& textureChannels, uint kind) {
    const Vec3f shown = m.baseColorTexture ? textureChannels[*m.baseColorTexture] : Vec3f(1.0f);
    const bool base = maxComponent(m.baseColor * shown) > 0.0f;
    switch (kind) {
        case KIND_PHONG: return base || maxComponent(m.specular) > 0.0f;
        case KIND_MIRROR: return maxComponent(m.specular) > 0.0f;
        case KIND_CONDUCTOR:
        case KIND_ROUGH_CONDUCTOR: return maxComponent(conductorF0(m.conductorEta, m.conductorK)) > 0.0f;
        case KIND_DIELECTRIC:
        case KIND_ROUGH_DIELECTRIC: return true;
        case KIND_METALLIC_ROUGHNESS:
            return base || m.specularFactor > 0.0f || m.transmission > 0.0f || layerLobes(m, kind) != 0;
        default: return base;
    }
}

uint index(const TextureIndex& texture) { return texture.value_or(NO_INDEX); }

bool isSpecularKind(uint kind) { return kind == KIND_MIRROR || kind == KIND_DIELECTRIC || kind == KIND_CONDUCTOR; }

/// What glass that is part of the metallic-roughness model, tinted, or a pane needs of the kernels.
uint transmissionLobes(const Material& m, uint kind) {
    if (kind != KIND_METALLIC_ROUGHNESS) {
        const bool tinted =
            m.kind == MaterialKind::MetallicRoughness && (m.baseColorTexture || m.baseColor != Vec3f(1.0f));
        return m.thin || tinted ? LOBE_TRANSMISSION : 0;
    }
    const bool varies = m.metallicRoughnessTexture.has_value(), smooth = m.roughness * m.roughness < smoothAlpha;
    return LOBE_TRANSMISSION | (varies || smooth || m.ior == 1.0f ? LOBE_DIELECTRIC : 0) |
           (varies || !smooth ? LOBE_ROUGH_DIELECTRIC : 0);
}

void packMaterial(const Material& given, const std::vector<Vec3f>& textureChannels, PackedScene& packed) {
    const Material m = withTexturedRoughness(given);
    const uint kind = kindOf(m);
    const bool transmissive = m.transmits(), tinted = m.kind == MaterialKind::MetallicRoughness && transmissive;
    const bool black = !scatters(m, textureChannels, kind);
    const bool holes = hasHoles(m), blended = blends(m);
    uint flags = kind;
    if (m.twoSided || transmissive) flags |= MATERIAL_TWO_SIDED;
    if (m.emitsBothSides) flags |= MATERIAL_EMITS_BOTH_SIDES;
    if (isSpecularKind(kind)) flags |= MATERIAL_SPECULAR;
    if (black) flags |= MATERIAL_BLACK;
    if (holes || blended) flags |= MATERIAL_ALPHA;
    if (blended) flags |= MATERIAL_BLENDS;
    if (tinted) flags |= MATERIAL_TINTED;
    if (transmissive && m.thin) flags |= MATERIAL_THIN;
    const Vec3f specularColor = kind == KIND_ROUGH_CONDUCTOR ? meanReflectance(m)
                                : kind == KIND_PHONG || kind == KIND_MIRROR || kind == KIND_METALLIC_ROUGHNESS
                                    ? m.specular
                                    : Vec3f(1.0f);
    const float lobe = kind == KIND_PHONG                ? m.phongExponent
                       : kind == KIND_METALLIC_ROUGHNESS ? m.roughness
                                                         : m.roughness * m.roughness;
    const float diffuse = maxComponent(m.baseColor), glossy = maxComponent(m.specular);
    const float diffuseChance = kind != KIND_PHONG        ? 1.0f
                                : diffuse + glossy > 0.0f ? diffuse / (diffuse + glossy)
                                                          : 1.0f;

    packed.materials.push_back(texel(m.baseColor, flags));
    packed.materials.push_back(texel(specularColor, bits(lobe)));
    packed.materials.push_back(texel(m.emission, bits(m.ior)));
    packed.materials.push_back({bits(m.metallic), bits(m.specularFactor),
                                bits(blended ? *m.coverage : m.alphaCutoff.value_or(0.0f)), bits(indexSpread(m))});
    packed.materials.push_back({index(m.baseColorTexture), index(m.emissionTexture), index(m.metallicRoughnessTexture),
                                index(m.normalTexture)});
    if (m.kind == MaterialKind::MetallicRoughness)
        packed.materials.push_back({bits(m.transmission), index(m.transmissionTexture), 0, bits(m.normalScale)});
    else
        packed.materials.push_back(texel(m.conductorEta, bits(m.normalScale)));
    packed.materials.push_back(texel(m.conductorK, bits(diffuseChance)));

    if (!black) packed.lobes |= lobeOf(kind) | layerLobes(m, kind);
    if (!black && isRoughMetal(m, kind)) packed.lobes |= LOBE_MULTIPLE_SCATTERING;
    if (!black && transmissive) packed.lobes |= transmissionLobes(m, kind);
    if (!black && indexSpread(m) > 0) packed.features |= FEATURE_DISPERSION;
    if (m.baseColorTexture || m.emissionTexture || m.metallicRoughnessTexture || m.transmissionTexture)
        packed.features |= FEATURE_TEXTURES | FEATURE_ATTRIBUTES;
    if (m.normalTexture) packed.features |= FEATURE_NORMAL_MAPS | FEATURE_ATTRIBUTES;
    if (holes || blended) packed.features |= FEATURE_ALPHA;
    if (blended) packed.features |= FEATURE_BLENDING;
}

/// Behind the records of all materials, for those that have layers.
void packLayers(const Scene& scene, PackedScene& packed) {
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        const Material m = withTexturedRoughness(scene.materials[i]);
        if (layerLobes(m, kindOf(m)) == 0) continue;
        packed.materials[i * MATERIAL_TEXELS + 5].z = uint(packed.materials.size());
        packed.materials.push_back({bits(m.clearcoat), bits(m.clearcoatRoughness), index(m.clearcoatTexture),
                                    index(m.clearcoatRoughnessTexture)});
        packed.materials.push_back(texel(m.sheenColor, bits(m.sheenRoughness)));
        packed.materials.push_back({index(m.sheenColorTexture), index(m.sheenRoughnessTexture), 0, 0});
        if (m.clearcoatTexture || m.clearcoatRoughnessTexture || m.sheenColorTexture || m.sheenRoughnessTexture)
            packed.features |= FEATURE_TEXTURES | FEATURE_ATTRIBUTES;
    }
}

}  // namespace

std::array<float, 256> decodeTable(bool srgb) {
    std::array<float, 256> table;
    for (int i = 0; i < 256; ++i) table[size_t(i)] = srgb ? srgbToLinear(float(i) / 255.0f) : float(i) / 255.0f;
    return table;
}

bool isSpecular(const Material& m) { return isSpecularKind(kindOf(withTexturedRoughness(m))); }

bool hasSpecularPart(const Material& given) {
    const Material m = withTexturedRoughness(given);
    const uint kind = kindOf(m);
    return isSpecularKind(kind) || (m.transmits() && (transmissionLobes(m, kind) & LOBE_DIELECTRIC) != 0);
}

float indexSpread(const Material& m) {
    return m.abbeNumber && m.transmits() && !m.thin ? (m.ior - 1) / *m.abbeNumber : 0.0f;
}

bool isBlack(const Material& m) {
    Material plain = m;
    plain.baseColorTexture.reset();
    return !scatters(plain, {}, kindOf(plain));
}

bool blends(const Material& m) {
    return m.coverage && (*m.coverage < 1.0f || m.baseColorTexture) && (m.thin || !m.transmits());
}

bool hasHoles(const Material& m) {
    return !blends(m) && m.alphaCutoff && *m.alphaCutoff > 0.0f && *m.alphaCutoff <= 1.0f && m.baseColorTexture;
}

bool isHole(const Material& m) { return blends(m) ? *m.coverage == 0.0f : m.alphaCutoff && *m.alphaCutoff > 1.0f; }

void packMaterials(const Scene& scene, PackedScene& packed) {
    const std::vector<Vec3f> channels = colouredChannels(scene);
    for (const Material& m : scene.materials) packMaterial(m, channels, packed);
    packLayers(scene, packed);
    for (size_t i = 0; i < scene.textures.size(); ++i) {
        const Texture& t = scene.textures[i];
        uint info = uint(t.wrapU) | (uint(t.wrapV) << TEXTURE_WRAP_V_SHIFT) | (t.uvSet << TEXTURE_UV_SET_SHIFT);
        if (t.nearest) info |= TEXTURE_NEAREST, packed.features |= FEATURE_NEAREST;
        if (t.uvSet > 0) packed.features |= FEATURE_MORE_UVS;
        // One picture that is read in several ways is kept once.
        const auto end = scene.textures.begin() + std::ptrdiff_t(i);
        const auto same = std::find_if(scene.textures.begin(), end, [&](const Texture& other) {
            return other.width == t.width && other.srgb == t.srgb && other.rgba == t.rgba;
        });
        if (same != end) {
            packed.textureInfo.push_back(
                {packed.textureInfo[size_t(same - scene.textures.begin())].x, t.width, t.height, info});
            continue;
        }
        packed.textureInfo.push_back({uint(packed.texels.size() / 4), t.width, t.height, info});
        const auto decode = decodeTable(t.srgb);
        for (size_t at = 0; at < t.rgba.size(); at += 4) {
            for (size_t c = 0; c < 3; ++c) packed.texels.push_back(toHalf(decode[t.rgba[at + c]]));
            packed.texels.push_back(toHalf(float(t.rgba[at + 3]) / 255.0f));
        }
    }
}

}  // namespace antipode
