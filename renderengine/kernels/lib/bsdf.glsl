// Reflection and transmission at a surface. `wKnown` is the direction that the sub-path came from, `wNew` the one it
// goes on to; both unit, world space, leaving the surface. Values are BSDFs without the cosine, densities are per solid
// angle. The lobes are in lib/lobes, one kind a file.
#ifndef ANTIPODE_BSDF
#define ANTIPODE_BSDF
#include "lib/lobes/conductor.glsl"
#include "lib/lobes/dielectric.glsl"
#include "lib/lobes/lambert.glsl"
#include "lib/lobes/layers.glsl"
#include "lib/lobes/metallic_roughness.glsl"
#include "lib/lobes/mirror.glsl"
#include "lib/lobes/phong.glsl"
#include "lib/lobes/rough_dielectric.glsl"

const uint LOBES_GGX = LOBE_METALLIC_ROUGHNESS | LOBE_CONDUCTOR | LOBE_ROUGH_DIELECTRIC;

/// The material's values at the surface for a sub-path that arrives from `wKnown`.
Bsdf loadBsdf(Surface surface, real3 wKnown) {
    Bsdf b;
    uint at = surface.material * MATERIAL_TEXELS;
    uvec4 m0 = texelFetch(materials, int(at)), m1 = texelFetch(materials, int(at + 1u)),
          m2 = texelFetch(materials, int(at + 2u)), m3 = texelFetch(materials, int(at + 3u));
    b.kind = m0.w & KIND_MASK;
    b.specular = (m0.w & MATERIAL_SPECULAR) != 0u;
    // A path that arrives in the surface's own plane has no density there, by any technique, and no weight.
    real sideKnown = dot(wKnown, surface.normal);
    bool front = sideKnown > 0.0;
    b.black = (m0.w & MATERIAL_BLACK) != 0u || sideKnown == 0.0 || (!front && (m0.w & MATERIAL_TWO_SIDED) == 0u);
    b.ng = front ? surface.normal : -surface.normal;
    b.n = front ? surface.shadingNormal : -surface.shadingNormal;
    b.diffuse = uintBitsToFloat(m0.xyz);
    b.glossy = uintBitsToFloat(m1.xyz);
    b.exponent = uintBitsToFloat(m1.w);
    b.alpha = b.exponent;
    real ior = uintBitsToFloat(m2.w), glassIor = ior;
    if (feature(FEATURE_DISPERSION)) {
        real spread = uintBitsToFloat(m3.w);
        b.dispersive = spread > 0.0;
        glassIor = indexAtWavelength(ior, spread);
    }
    b.thin = (m0.w & MATERIAL_THIN) != 0u;
    b.eta = front || isPane(b) ? glassIor : 1.0 / glassIor;
    b.f90 = 1.0;
    b.lossKnown = 0.0;
    b.diffuseChance = 1.0;
    if (feature(FEATURE_TEXTURES)) {
        uint map = texelFetch(materials, int(at + 4u)).x;
        if (map != NO_INDEX) b.diffuse *= sampleTexture(map, surface.uv).rgb;
    }
    if (feature(FEATURE_VERTEX_COLORS)) b.diffuse *= vertexColor(surface.uv).rgb;
    if (lobe(LOBE_TRANSMISSION)) {
        b.glass = b.kind == KIND_DIELECTRIC || b.kind == KIND_ROUGH_DIELECTRIC ? 1.0 : 0.0;
        b.smoothGlass = b.kind == KIND_DIELECTRIC;
        // A body's colour is that of both the faces that light crosses.
        b.tint = (m0.w & MATERIAL_TINTED) == 0u ? real3(1.0) : b.thin ? b.diffuse : sqrt(b.diffuse);
    }
    if (lobe(LOBE_PHONG)) loadPhong(b, at);
    if (lobe(LOBE_CONDUCTOR)) loadConductor(b, at);
    if (lobe(LOBE_MULTIPLE_SCATTERING) && hasKind(b, LOBE_CONDUCTOR, KIND_ROUGH_CONDUCTOR))
        loadMultipleScattering(b, dot(wKnown, b.n), b.glossy, 1.0);
    if (hasKind(b, LOBE_METALLIC_ROUGHNESS, KIND_METALLIC_ROUGHNESS))
        loadMetallicRoughness(b, at, surface.uv, m3, ior, dot(wKnown, b.n));
    if (hasRoughGlass(b)) loadRoughDielectric(b, dot(wKnown, b.n));
    if (lobe(LOBES_OF_LAYERS)) loadLayers(b, at, surface.uv);
    return b;
}

/// Makes a dielectric the interface between two media, seen from wKnown, not between its own and none. Between equal
/// indices nothing is refracted, and a microfacet's half vector has no direction. A pane is none.
void placeInterface(inout Bsdf b, real3 wKnown, uvec2 mediaAcross) {
    if (isPane(b)) return;
    b.eta = relativeIndex(mediaAcross.x, mediaAcross.y);
    if (feature(FEATURE_DISPERSION))
        b.dispersive = (hasSmoothGlass(b) || hasRoughGlass(b)) && dispersesBetween(mediaAcross.x, mediaAcross.y);
    if (lobe(LOBE_TRANSMISSION) && b.eta == 1.0 && b.glass > 0.0) {
        b.smoothGlass = true;
        b.specular = b.glass == 1.0;
    }
    if (hasKind(b, LOBE_ROUGH_DIELECTRIC, KIND_ROUGH_DIELECTRIC) && b.eta == 1.0) {
        b.kind = KIND_DIELECTRIC;
        b.specular = true;
    }
    if (hasRoughGlass(b)) loadRoughDielectric(b, dot(wKnown, b.n));
}

/// The non-delta BSDF. `adjoint`: light travels the way of the sub-path (light paths), so that refraction does not
/// scale with η². pdf: of sampling wNew from wKnown; reversePdf: of sampling wKnown from wNew.
real3 evalBsdf(Bsdf b, real3 wKnown, real3 wNew, bool adjoint, out real pdf, out real reversePdf) {
    pdf = reversePdf = 0.0;
    LobeSum sum = LobeSum(real3(0.0), 0.0, 0.0);
    real cosKnown = dot(wKnown, b.n), cosNew = dot(wNew, b.n), sideNew = dot(wNew, b.ng);
    if (b.specular || b.black || cosKnown <= 0.0) return sum.value;
    if (cosNew > 0.0 && sideNew > 0.0) {
        if (hasKind(b, LOBE_PHONG, KIND_PHONG)) addPhong(sum, b, wKnown, wNew);
        if (lobe(LOBES_GGX)) {
            Microfacets m = reflectingMicrofacets(wKnown, wNew, cosKnown, cosNew, b.n, b.alpha);
            if (hasKind(b, LOBE_CONDUCTOR, KIND_ROUGH_CONDUCTOR)) addRoughConductor(sum, b, m);
            if (hasKind(b, LOBE_METALLIC_ROUGHNESS, KIND_METALLIC_ROUGHNESS)) {
                addMetallicRoughness(sum, b, m);
                if (lobe(LOBES_OF_LAYERS)) addLayers(sum, b, wKnown, wNew, cosKnown, cosNew);
                if (lobe(LOBE_TRANSMISSION)) scaleLobes(sum, 1.0 - b.glass);
            }
            if (hasRoughGlass(b)) addRoughDielectricReflection(sum, b, m);
        }
        if (lobe(LOBE_LAMBERT | LOBE_PHONG) && (b.kind == KIND_LAMBERT || b.kind == KIND_PHONG))
            addLambert(sum, b, real3(1.0), b.diffuseChance, b.diffuseChance, cosKnown, cosNew);
    } else if (hasRoughGlass(b) && cosNew < 0.0 && sideNew < 0.0) {
        if (isPane(b))
            addRoughPane(sum, b, wKnown, wNew);
        else
            addRoughDielectricRefraction(sum, b, wKnown, wNew, adjoint);
    }
    pdf = sum.pdf;
    reversePdf = sum.reversePdf;
    return sum.value;
}

/// A direction of a delta lobe. `choice` in [0,1).
void sampleSpecular(inout BsdfSample result, Bsdf b, real3 wKnown, real cosKnown, bool adjoint, real choice) {
    sampleMirror(result, b, wKnown);
    if (hasKind(b, LOBE_CONDUCTOR, KIND_CONDUCTOR)) sampleSmoothConductor(result, b, cosKnown);
    if (hasSmoothGlass(b)) sampleDielectric(result, b, wKnown, cosKnown, adjoint, choice);
    real sideNew = dot(result.direction, b.ng);
    bool transmitted = dot(result.direction, b.n) < 0.0;
    result.valid = cosKnown > 0.0 && (transmitted ? sideNew < 0.0 : sideNew > 0.0);
}

/// Chooses how the sub-path goes on; invalid where it ends (absorbed or below the surface).
BsdfSample sampleBsdf(Bsdf b, real3 wKnown, bool adjoint, real3 u) {
    BsdfSample result;
    result.valid = result.zeroPdf = false;
    result.specular = b.specular;
    result.value = real3(0.0);
    result.pdf = result.reversePdf = 0.0;
    result.direction = b.n;
    real cosKnown = dot(wKnown, b.n);
    if (b.black) return result;
    if (b.specular) {
        sampleSpecular(result, b, wKnown, cosKnown, adjoint, u.z);
        return result;
    }
    if (cosKnown <= 0.0) return result;

    // Glass or not, where the surface is a mix of both; what is left of u.z chooses on.
    bool glass = hasKind(b, LOBE_ROUGH_DIELECTRIC, KIND_ROUGH_DIELECTRIC);
    if (lobe(LOBE_TRANSMISSION) && b.kind == KIND_METALLIC_ROUGHNESS && b.glass > 0.0) {
        glass = u.z < b.glass;
        u.z = min(glass ? u.z / b.glass : (u.z - b.glass) / (1.0 - b.glass), 1.0 - UNIT_ROUNDOFF);
        if (glass && b.smoothGlass) {
            result.specular = true;
            sampleSpecular(result, b, wKnown, cosKnown, adjoint, u.z);
            return result;
        }
    }

    // A direction of one lobe, chosen by u.z.
    bool chosen = false, transmitted = false;
    bool layered = lobe(LOBES_OF_LAYERS) && b.kind == KIND_METALLIC_ROUGHNESS && !glass &&
                   sampleLayers(b, wKnown, cosKnown, u.xy, u.z, result.direction);
    if (layered) chosen = true;
    if (hasKind(b, LOBE_PHONG, KIND_PHONG) && u.z >= b.diffuseChance) {
        result.direction = samplePhong(b, wKnown, u.xy);
        chosen = true;
    }
    bool multiple = lobe(LOBE_ROUGH_DIELECTRIC) && glass && samplesGlassMultiple(b, u.z, transmitted);
    if (lobe(LOBES_GGX) && !multiple && !layered) {
        bool rough = glass || (b.kind == KIND_ROUGH_CONDUCTOR && samplesConductorGlossy(b, u.z));
        if (rough || (b.kind == KIND_METALLIC_ROUGHNESS && samplesMetallicGlossy(b, cosKnown, u.z))) {
            real3 h = sampleVisibleNormal(wKnown, b.n, b.alpha, u.xy);
            result.direction = sampleRoughConductor(wKnown, h);
            if (glass) result.direction = sampleRoughDielectric(b, wKnown, h, u.z, transmitted);
            chosen = true;
        }
    }
    if (!chosen) result.direction = sampleLambert(b, u.xy);
    if (multiple && transmitted) result.direction = -result.direction;

    // Its value and density under all lobes.
    result.value = evalBsdf(b, wKnown, result.direction, adjoint, result.pdf, result.reversePdf);
    // What a microfacet reflects to below the surface, or refracts to above it, is lost: evalBsdf would take it for the
    // other lobe, whose density does not count it.
    real cosNew = dot(result.direction, b.n), sideNew = dot(result.direction, b.ng);
    result.valid = result.pdf > 0.0 && (cosNew < 0.0) == transmitted;
    result.zeroPdf =
        !(result.pdf > 0.0) && (transmitted ? cosNew < 0.0 && sideNew < 0.0 : cosNew > 0.0 && sideNew > 0.0);
    return result;
}

/// |cos_shading| over |cos_geometric| of a direction: what light that arrives from it gains at an interpolated normal.
/// In the surface's own plane nothing arrives: 0, and not the quotient of a BSDF that is 0 there by 0.
real shadingGain(Bsdf b, real3 w) {
    real side = dot(w, b.ng);
    return side == 0.0 ? 0.0 : abs(dot(w, b.n) / side);
}

/// Veach's correction for shading normals on light paths (1997, eq. 5.19): |cos_shading(known)·cos_geometric(new)| over
/// |cos_geometric(known)·cos_shading(new)|, to be multiplied with the shading cosine of wNew.
real adjointCosine(Bsdf b, real3 wKnown, real3 wNew) {
    real cosine = abs(dot(wNew, b.ng));
    if (feature(FEATURE_ATTRIBUTES)) cosine *= shadingGain(b, wKnown);
    return cosine;
}
#endif
