// Guides: what the surface that a camera path meets first is like, for denoisers and compositing.
#ifndef ANTIPODE_GUIDES
#define ANTIPODE_GUIDES
#include "lib/film.glsl"
#include "lib/path_vertex.glsl"

const real GUIDE_SCALE = 4294967296.0;  // 2^GUIDE_SCALE_EXPONENT

/// What the surface reflects (or passes on) of light that comes along its normal, all lobes together.
real3 albedoOf(Bsdf b) {
    if (b.black) return real3(0.0);
    if (lobe(LOBE_CONDUCTOR) && (b.kind == KIND_CONDUCTOR || b.kind == KIND_ROUGH_CONDUCTOR))
        return fresnelConductor(1.0, b.conductorEta, b.conductorK);
    if (hasKind(b, LOBE_DIELECTRIC, KIND_DIELECTRIC) || hasKind(b, LOBE_ROUGH_DIELECTRIC, KIND_ROUGH_DIELECTRIC))
        return lobe(LOBE_TRANSMISSION) ? mix(b.tint, real3(1.0), glassReflectance(b, 1.0)) : real3(1.0);
    if (b.kind == KIND_LAMBERT) return b.diffuse;
    if (b.kind == KIND_MIRROR) return b.glossy;
    real3 opaque = b.diffuse + b.glossy;
    if (lobe(LOBES_OF_LAYERS) && b.kind == KIND_METALLIC_ROUGHNESS) opaque = layeredAlbedo(b, opaque);
    if (!lobe(LOBE_TRANSMISSION)) return opaque;
    return mix(opaque, mix(b.tint, real3(1.0), glassReflectance(b, 1.0)), b.glass);
}

void addGuide(uint at, real scaled, uint random_) {
    uvec2 whole;
    if (roundSample(scaled, random_, whole))
        addToLayers(at, whole);
    else
        countEvent(SOURCE_FILM, EVENT_SATURATED);
}

void addGuide(uint bit, uint pixel, real3 value, real scale, uint random_) {
    uint at = layerBase(bit) + 3u * pixel;
    addGuide(at, value.x * scale, random_);
    addGuide(at + 1u, value.y * scale, random_);
    addGuide(at + 2u, value.z * scale, random_);
}

/// Adds the guides of the pixel's path where `v` is the vertex that they tell of: at most one of a path is.
void addGuides(const PathVertex v, uint pixel) {
    bool told =
        layer(GUIDES_FIRST_HIT) ? pathLength(v.path) == 1u : (v.path.flags & PATH_SPECULAR) != 0u && !v.bsdf.specular;
    if (!told || inMedium(v)) return;
    uint id = framePixel(pixel);
    uint random_ = randomBits(id, 0u, id, RANDOM_ROUNDING).y;
    real3 position = v.surface.position;
    if (layer(LAYER_ALBEDO)) addGuide(LAYER_ALBEDO, pixel, albedoOf(v.bsdf), GUIDE_SCALE, random_);
    if (layer(LAYER_NORMAL)) addGuide(LAYER_NORMAL, pixel, v.bsdf.n, GUIDE_SCALE, random_);
    if (layer(LAYER_DEPTH))
        addGuide(layerBase(LAYER_DEPTH) + pixel,
                 dot(position - job.cameraPosition.xyz, job.cameraForward.xyz) * job.worldOrigin.w, random_);
    if (layer(LAYER_POSITION))
        addGuide(LAYER_POSITION, pixel, position + job.worldOrigin.xyz, job.worldOrigin.w, random_);
    if (layer(LAYER_COVERAGE)) addGuide(layerBase(LAYER_COVERAGE) + pixel, GUIDE_SCALE, random_);
}
#endif
