// Tables of what layers reflect (gpu/layer_tables.h), behind those of losses.
#ifndef ANTIPODE_ALBEDOS
#define ANTIPODE_ALBEDOS
#include "lib/losses.glsl"

const uint ALBEDO_ROW = ALBEDO_COSINES - 1u, ALBEDO_CELLS = ALBEDO_ROW * (ALBEDO_ROUGHNESSES - 1u);

uint coatAlbedosFirst() {
    return lobe(LOBE_ROUGH_DIELECTRIC) ? GLASS_LOSS_MEANS_FIRST + GLASS_LOSS_INDICES * (GLASS_LOSS_MEANS - 1u)
                                       : GLASS_LOSS_FIRST;
}

/// Of the table that begins there, at a cosine > 0 and a position in [0,1] along its roughnesses.
real albedoAt(uint first, real cosine, real roughness) {
    real x, y;
    uint column = lossNode(min(sqrt(cosine), 1.0), ALBEDO_COSINES, x), row = lossNode(roughness, ALBEDO_ROUGHNESSES, y);
    real4 corners = texelFetch(losses, int(first + row * ALBEDO_ROW + column));
    return mix(mix(corners.x, corners.y, x), mix(corners.z, corners.w, x), y);
}

/// What a coat of this roughness in [0,1] reflects of light from a direction of this cosine.
real clearcoatAlbedo(real cosine, real roughness) { return albedoAt(coatAlbedosFirst(), cosine, roughness); }

/// Its cosine-weighted mean, and the mean of its product with Schlick's (1 − cosine)⁵.
real2 clearcoatMeanAlbedos(real roughness) {
    real y;
    uint node = lossNode(roughness, ALBEDO_ROUGHNESSES, y);
    real4 means = texelFetch(losses, int(coatAlbedosFirst() + ALBEDO_CELLS + node));
    return mix(means.xz, means.yw, y);
}

const real SHEEN_LEAST_ROUGHNESS = real(SHEEN_LEAST_PERCENT) / 100.0;

/// What white sheen of this roughness in [SHEEN_LEAST_ROUGHNESS,1] reflects of light from a direction of this cosine.
real whiteSheenAlbedo(real cosine, real roughness) {
    real at = (roughness - SHEEN_LEAST_ROUGHNESS) / (1.0 - SHEEN_LEAST_ROUGHNESS);
    return albedoAt(coatAlbedosFirst() + ALBEDO_CELLS + ALBEDO_ROUGHNESSES - 1u, cosine, at);
}
#endif
