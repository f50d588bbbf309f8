#include "gpu/emitted_power.h"

#include <map>
#include <numbers>
#include <utility>

#include "gpu/pack_materials.h"

namespace antipode {
namespace {

using Emitters = std::vector<size_t>;

/// Multiplies the radiance of the emitters by their means of the texture, channel by channel.
void modulate(const Texture& texture, const Emitters& shown, const std::vector<EmitterPrimitive>& emitters,
              std::vector<Vec3d>& radiance) {
    const auto decode = decodeTable(texture.srgb);
    for (int channel = 0; channel < 3; ++channel) {
        const TexelSums sums(texture, [&](const uint8_t* rgba) { return double(decode[rgba[channel]]); });
        for (size_t i : shown) radiance[i][channel] *= sums.mean(emitters[i].uvs(texture.uvSet));
    }
}

/// Multiplies it by the part of the texels whose alpha reaches the cut-off.
void cutHoles(const Texture& texture, float cutoff, const Emitters& cut, const std::vector<EmitterPrimitive>& emitters,
              std::vector<Vec3d>& radiance) {
    // The kernels compare halves that they have interpolated: what rounds up to the cut-off counts.
    const TexelSums sums(texture,
                         [&](const uint8_t* rgba) { return float(rgba[3]) / 255.0f * 1.001f >= cutoff ? 1.0 : 0.0; });
    for (size_t i : cut) radiance[i] = radiance[i] * sums.mean(emitters[i].uvs(texture.uvSet));
}

}  // namespace

std::vector<double> emittedPowers(const Scene& scene, const std::vector<EmitterPrimitive>& emitters,
                                  const std::function<void()>& nextTexture) {
    std::vector<Vec3d> radiance;
    std::map<uint32_t, Emitters> byEmissionTexture;
    std::map<std::pair<uint32_t, float>, Emitters> byHoles;
    for (size_t i = 0; i < emitters.size(); ++i) {
        const Material& m = scene.materials[emitters[i].material];
        radiance.push_back(Vec3d(m.emission));
        if (m.emissionTexture) byEmissionTexture[*m.emissionTexture].push_back(i);
        if (hasHoles(m) && !emitters[i].sphere) byHoles[{*m.baseColorTexture, *m.alphaCutoff}].push_back(i);
    }
    for (const auto& [texture, shown] : byEmissionTexture) {
        nextTexture();
        modulate(scene.textures[texture], shown, emitters, radiance);
    }
    for (const auto& [key, cut] : byHoles) {
        nextTexture();
        cutHoles(scene.textures[key.first], key.second, cut, emitters, radiance);
    }
    std::vector<double> powers;
    for (size_t i = 0; i < emitters.size(); ++i) {
        const Vec3d& r = radiance[i];
        const double sides = scene.materials[emitters[i].material].emitsBothSides ? 2.0 : 1.0;
        powers.push_back((r.x + r.y + r.z) / 3.0 * std::numbers::pi * emitters[i].area * sides);
    }
    return powers;
}

}  // namespace antipode
