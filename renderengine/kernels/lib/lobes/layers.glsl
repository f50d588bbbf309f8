// What covers a base of glTF's metallic-roughness model: sheen, and a clear coat over both.
#ifndef ANTIPODE_LAYERS
#define ANTIPODE_LAYERS
#include "lib/lobes/clearcoat.glsl"
#include "lib/lobes/metallic_roughness.glsl"
#include "lib/lobes/sheen.glsl"

const uint LOBES_OF_LAYERS = LOBE_CLEARCOAT | LOBE_SHEEN;

void loadLayers(inout Bsdf b, uint material, TexturePoint point) {
    b.coat = b.coatRoughness = 0.0;
    b.sheen = real3(0.0);
    b.sheenRoughness = 1.0;
    if (b.kind != KIND_METALLIC_ROUGHNESS) return;
    uint record = texelFetch(materials, int(material + 5u)).z;  // 0: none
    if (record == 0u) return;
    if (lobe(LOBE_CLEARCOAT)) loadClearcoat(b, record, point);
    if (lobe(LOBE_SHEEN)) loadSheen(b, record, point);
}

/// The chances of the coat, and of the sheen where it is not the coat, for a direction of this cosine, of which single
/// scattering at the base loses `loss`.
real2 layerChances(Bsdf b, real cosine, real loss) {
    real2 base = metallicAlbedos(b, cosine, loss);
    real below = base.x + base.y;
    real2 chances = real2(0.0);
    if (lobe(LOBE_SHEEN)) {
        chances.y = sheenChance(b, cosine, below);
        real albedo = sheenAlbedo(b, cosine);
        below = albedo + (1.0 - albedo) * below;
    }
    if (lobe(LOBE_CLEARCOAT)) chances.x = clearcoatChance(b, cosine, below);
    return chances;
}

/// Lays them over what `sum` holds, the base.
void addLayers(inout LobeSum sum, Bsdf b, real3 wKnown, real3 wNew, real cosKnown, real cosNew) {
    real lossNew = lobe(LOBE_MULTIPLE_SCATTERING) ? metalLoss(cosNew, b.alpha) : 0.0;
    real2 chances = layerChances(b, cosKnown, b.lossKnown), reverse = layerChances(b, cosNew, lossNew);
    if (lobe(LOBE_SHEEN)) addSheen(sum, b, wKnown, wNew, cosKnown, cosNew, chances.y, reverse.y);
    if (lobe(LOBE_CLEARCOAT)) addClearcoat(sum, b, wKnown, wNew, cosKnown, cosNew, chances.x, reverse.x);
}

/// Whether `choice` in [0,1), of which the rest is returned in it, takes what has this chance.
bool takes(real chance, inout real choice) {
    bool taken = choice < chance;
    choice = min(taken ? choice / chance : (choice - chance) / (1.0 - chance), 1.0 - UNIT_ROUNDOFF);
    return taken;
}

/// Whether a layer is drawn from, and where it leads; what is left of `choice` chooses on.
bool sampleLayers(Bsdf b, real3 wKnown, real cosKnown, real2 u, inout real choice, inout real3 direction) {
    real2 chances = layerChances(b, cosKnown, b.lossKnown);
    if (lobe(LOBE_CLEARCOAT) && takes(chances.x, choice)) {
        direction = sampleClearcoat(b, wKnown, u);
        return true;
    }
    if (lobe(LOBE_SHEEN) && takes(chances.y, choice)) {
        direction = sampleSheen(b, u);
        return true;
    }
    return false;
}

/// What base and layers reflect of light along the normal; `base`: the base alone.
real3 layeredAlbedo(Bsdf b, real3 base) {
    if (lobe(LOBE_SHEEN)) base = base * (1.0 - sheenAlbedo(b, 1.0)) + b.sheen * whiteSheenAlbedo(1.0, b.sheenRoughness);
    if (lobe(LOBE_CLEARCOAT)) base = base * (1.0 - coatAlbedo(b, 1.0)) + coatAlbedo(b, 1.0);
    return base;
}
#endif
