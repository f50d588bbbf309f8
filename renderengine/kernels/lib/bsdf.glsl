// Reflection and transmission at a surface. `wKnown` is the direction that the sub-path came from, `wNew` the one it
// goes on to; both unit, world space, leaving the surface. Values are BSDFs without the cosine; densities are per solid
// angle and include the probability of surviving Russian roulette, which depends on the material alone.
#ifndef ANTIPODE_BSDF
#define ANTIPODE_BSDF
#include "lib/frame.glsl"
#include "lib/microfacet.glsl"
#include "lib/surface.glsl"
#include "lib/transcendental.glsl"

struct Bsdf {
    uint kind;
    bool specular;  // delta lobes only: nothing to evaluate, connect or merge
    bool black;     // reflects nothing on this side
    real3 diffuse;  // Lambertian albedo
    real3 glossy;   // Phong, mirror: reflectance; metallic-roughness: F0
    real f90;       // metallic-roughness
    real exponent;  // Phong
    real alpha;     // GGX
    real eta;       // dielectrics: index beyond over index on the side of wKnown
    real3 conductorEta, conductorK;
    real diffuseChance;  // of sampling the diffuse lobe, where it does not depend on the direction
    real survival;
    real3 n;   // shading normal on the side of wKnown
    real3 ng;  // geometric normal on the side of wKnown
};

struct BsdfSample {
    real3 direction;
    real3 value;  // BSDF, without the cosine; for delta lobes the coefficient over the chance, roulette included
    real pdf, reversePdf;
    bool specular;
    bool valid;
    bool zeroPdf;  // drawn on the side that its lobe covers, and yet without density
};

/// The material's values at the surface for a sub-path that arrives from `wKnown`.
Bsdf loadBsdf(inout Surface s, real3 wKnown) {
    Bsdf b;
    uint at = s.material * MATERIAL_TEXELS;
    uvec4 m0 = texelFetch(materials, int(at)), m1 = texelFetch(materials, int(at + 1u)),
          m2 = texelFetch(materials, int(at + 2u)), m3 = texelFetch(materials, int(at + 3u));
    b.kind = m0.w & KIND_MASK;
    b.specular = (m0.w & MATERIAL_SPECULAR) != 0u;
    bool front = dot(wKnown, s.normal) > 0.0;
    b.black = (m0.w & MATERIAL_BLACK) != 0u || (!front && (m0.w & MATERIAL_TWO_SIDED) == 0u);
    b.ng = front ? s.normal : -s.normal;
    b.n = front ? s.shadingNormal : -s.shadingNormal;
    b.diffuse = uintBitsToFloat(m0.xyz);
    b.glossy = uintBitsToFloat(m1.xyz);
    b.exponent = uintBitsToFloat(m1.w);
    b.alpha = b.exponent;
    real ior = uintBitsToFloat(m2.w);
    b.eta = front ? ior : 1.0 / ior;
    b.survival = uintBitsToFloat(m3.w);
    b.f90 = 1.0;
    b.diffuseChance = 1.0;
    if (feature(FEATURE_TEXTURES)) {
        uint map = texelFetch(materials, int(at + 4u)).x;
        if (map != NO_INDEX) b.diffuse *= sampleTexture(map, s.uv).rgb;
    }
    if (feature(FEATURE_PHONG)) b.diffuseChance = uintBitsToFloat(texelFetch(materials, int(at + 6u)).w);
    if (feature(FEATURE_CONDUCTOR)) {
        b.conductorEta = uintBitsToFloat(texelFetch(materials, int(at + 5u)).xyz);
        b.conductorK = uintBitsToFloat(texelFetch(materials, int(at + 6u)).xyz);
    }
    if (feature(FEATURE_METALLIC_ROUGHNESS) && b.kind == KIND_METALLIC_ROUGHNESS) {
        real metallic = uintBitsToFloat(m3.x), specularFactor = uintBitsToFloat(m3.y);
        real roughness = b.alpha;  // perceptual here: the texture multiplies it
        if (feature(FEATURE_TEXTURES)) {
            uint map = texelFetch(materials, int(at + 4u)).z;
            if (map != NO_INDEX) {
                real4 texel = sampleTexture(map, s.uv);
                roughness *= texel.g;
                metallic *= texel.b;
            }
        }
        // A rougher floor than zero keeps D(h) within float range where a texture asks for a mirror. Of floats in
        // double, too: it is part of the model.
        b.alpha = max(roughness * roughness, 1e-3);
        real r0 = (ior - 1.0) / (ior + 1.0);
        real3 dielectricF0 = min(r0 * r0 * b.glossy, real3(1.0)) * specularFactor;
        b.glossy = mix(dielectricF0, b.diffuse, metallic);
        b.f90 = mix(specularFactor, 1.0, metallic);
        b.diffuse *= 1.0 - metallic;
    }
    return b;
}

real3 reflectAbout(real3 w, real3 n) { return 2.0 * dot(w, n) * n - w; }

// Phong's lobe, in the versine 1 − cosα: where the exponent is large, the cosine's rounding is as large as the lobe.
real phongVersine(real3 mirrored, real3 w) {
    real3 d = w - mirrored;
    return 0.5 * dot(d, d);
}
/// cosαⁿ for versines below 1.
real phongPower(real versine, real exponent) { return exp(exponent * logOneMinus(versine)); }
/// 1 − (1 − u)^(1/(n+1)): distributed as (n+1)/(2π)·cosαⁿ wants it. Of 1 − u, as u may be 0 and the lobe's border is
/// not of it.
real samplePhongVersine(real u, real exponent) { return oneMinusExp(-log(1.0 - u) / (exponent + 1.0)); }

/// What the specular layer leaves to the diffuse lobe: (1−F(known))(1−F(new))/(1−F̄), F̄ = F0 + (F90−F0)/21 the
/// cosine-weighted mean of Schlick's term (Kelemen and Szirmay-Kalos 2001). glTF's own 1−F(h) reflects up to 1.24 of
/// what arrives at grazing angles; this is reciprocal, equal to it at normal incidence, and keeps the sum below 1.
real metallicDiffuseScale(Bsdf b, real cosKnown, real cosNew) {
    real f0 = max(b.glossy.x, max(b.glossy.y, b.glossy.z));
    real known = fresnelSchlick(cosKnown, real3(f0), b.f90).x, new_ = fresnelSchlick(cosNew, real3(f0), b.f90).x;
    real passed = 1.0 - (f0 + (b.f90 - f0) / 21.0);
    return passed > 0.0 ? (1.0 - known) * (1.0 - new_) / passed : 0.0;
}

/// Chance of the diffuse lobe of the metallic-roughness model for a direction with cosine `c`: by the lobes' albedos.
real metallicDiffuseChance(Bsdf b, real c) {
    real3 f = fresnelSchlick(c, b.glossy, b.f90);
    real s = max(f.x, max(f.y, f.z));
    real d = max(b.diffuse.x, max(b.diffuse.y, b.diffuse.z)) * (1.0 - s);
    return d + s > 0.0 ? d / (d + s) : 1.0;
}

/// The non-delta BSDF. `adjoint`: light travels the way of the sub-path (light paths), so that refraction does not
/// scale with η². pdf: of sampling wNew from wKnown; reversePdf: of sampling wKnown from wNew.
real3 evalBsdf(Bsdf b, real3 wKnown, real3 wNew, bool adjoint, out real pdf, out real reversePdf) {
    pdf = 0.0;
    reversePdf = 0.0;
    real3 value = real3(0.0);
    real cosKnown = dot(wKnown, b.n), cosNew = dot(wNew, b.n);
    real sideNew = dot(wNew, b.ng);
    if (b.specular || b.black || cosKnown <= 0.0) return value;
    if (cosNew > 0.0 && sideNew > 0.0) {
        real chance = b.diffuseChance, reverseChance = chance;
        real3 diffuseScale = real3(1.0);
        if (feature(FEATURE_PHONG) && b.kind == KIND_PHONG) {
            real versine = phongVersine(reflectAbout(wKnown, b.n), wNew);
            if (versine < 1.0) {
                real lobe = phongPower(versine, b.exponent) * (0.5 / PI);
                value += b.glossy * (lobe * (b.exponent + 2.0));
                real lobePdf = lobe * (b.exponent + 1.0) * (1.0 - chance);
                pdf += lobePdf;
                reversePdf += lobePdf;
            }
        }
        bool metallic = feature(FEATURE_METALLIC_ROUGHNESS) && b.kind == KIND_METALLIC_ROUGHNESS;
        bool conductor = feature(FEATURE_CONDUCTOR) && b.kind == KIND_ROUGH_CONDUCTOR;
        bool dielectric = feature(FEATURE_ROUGH_DIELECTRIC) && b.kind == KIND_ROUGH_DIELECTRIC;
        if (feature(FEATURE_METALLIC_ROUGHNESS | FEATURE_CONDUCTOR | FEATURE_ROUGH_DIELECTRIC) &&
            (metallic || conductor || dielectric)) {
            real3 h = normalize(wKnown + wNew);
            real cosH = dot(wKnown, h);
            real d = ggxDistribution(h, b.n, b.alpha);
            real3 f = real3(0.0);
            if (feature(FEATURE_CONDUCTOR) && conductor) f = fresnelConductor(cosH, b.conductorEta, b.conductorK);
            real glossyChance = 1.0, reverseGlossy = 1.0;
            if (feature(FEATURE_ROUGH_DIELECTRIC) && dielectric) {
                f = real3(fresnelDielectric(cosH, b.eta));
                glossyChance = reverseGlossy = f.x;
            }
            if (feature(FEATURE_METALLIC_ROUGHNESS) && metallic) {
                f = fresnelSchlick(cosH, b.glossy, b.f90);
                chance = metallicDiffuseChance(b, cosKnown);
                reverseChance = metallicDiffuseChance(b, cosNew);
                glossyChance = 1.0 - chance;
                reverseGlossy = 1.0 - reverseChance;
                diffuseScale = real3(metallicDiffuseScale(b, cosKnown, cosNew));
            }
            value += f * (d * ggxG2(cosKnown, cosNew, b.alpha) / (4.0 * cosKnown * cosNew));
            pdf += glossyChance * ggxG1(cosKnown, b.alpha) * d / (4.0 * cosKnown);
            reversePdf += reverseGlossy * ggxG1(cosNew, b.alpha) * d / (4.0 * cosNew);
        }
        if (feature(FEATURE_LAMBERT | FEATURE_PHONG | FEATURE_METALLIC_ROUGHNESS) &&
            (b.kind == KIND_LAMBERT || b.kind == KIND_PHONG || b.kind == KIND_METALLIC_ROUGHNESS)) {
            value += b.diffuse * diffuseScale / PI;
            pdf += chance * cosNew / PI;
            reversePdf += reverseChance * cosKnown / PI;
        }
    } else if (feature(FEATURE_ROUGH_DIELECTRIC) && b.kind == KIND_ROUGH_DIELECTRIC && cosNew < 0.0 && sideNew < 0.0) {
        // Walter et al. 2007, eq. 21 and 17.
        real3 h = normalize(wKnown + wNew * b.eta);
        if (dot(h, b.n) < 0.0) h = -h;
        real ko = dot(wKnown, h), ki = dot(wNew, h);
        if (ko > 0.0 && ki < 0.0) {
            real f = fresnelDielectric(ko, b.eta);
            real d = ggxDistribution(h, b.n, b.alpha);
            real denominator = ki + ko / b.eta;
            denominator *= denominator;
            value = real3((1.0 - f) * d * ggxG2(cosKnown, cosNew, b.alpha) *
                          abs(ki * ko / (cosKnown * cosNew * denominator)));
            if (!adjoint) value /= b.eta * b.eta;
            real reverse = ko + ki * b.eta;
            pdf = (1.0 - f) * ggxG1(cosKnown, b.alpha) * ko * d / cosKnown * abs(ki) / denominator;
            reversePdf = (1.0 - f) * ggxG1(cosNew, b.alpha) * abs(ki) * d / abs(cosNew) * ko / (reverse * reverse);
        }
    }
    pdf *= b.survival;
    reversePdf *= b.survival;
    return value;
}

/// Chooses how the sub-path goes on; invalid where it ends (absorbed, below the surface, or by roulette).
BsdfSample sampleBsdf(Bsdf b, real3 wKnown, bool adjoint, real4 u) {
    BsdfSample r;
    r.valid = r.zeroPdf = false;
    r.specular = b.specular;
    r.value = real3(0.0);
    r.pdf = r.reversePdf = 0.0;
    r.direction = b.n;
    real cosKnown = dot(wKnown, b.n);
    if (b.black || u.w >= b.survival) return r;
    if (b.specular) {
        real3 value = b.glossy;
        r.direction = reflectAbout(wKnown, b.n);
        r.pdf = 1.0;
        if (feature(FEATURE_CONDUCTOR) && b.kind == KIND_CONDUCTOR)
            value = fresnelConductor(abs(cosKnown), b.conductorEta, b.conductorK);
        if (feature(FEATURE_DIELECTRIC) && b.kind == KIND_DIELECTRIC) {
            real f = fresnelDielectric(abs(cosKnown), b.eta);
            value = real3(1.0);
            if (u.z >= f) {
                real cosT = sqrt(max(1.0 - (1.0 - cosKnown * cosKnown) / (b.eta * b.eta), 0.0));
                r.direction = normalize(-wKnown / b.eta + b.n * (cosKnown / b.eta - cosT));
                if (!adjoint) value /= b.eta * b.eta;
            }
        }
        real sideNew = dot(r.direction, b.ng);
        bool transmitted = dot(r.direction, b.n) < 0.0;
        r.valid = cosKnown > 0.0 && (transmitted ? sideNew < 0.0 : sideNew > 0.0);
        r.value = value / b.survival;
        return r;
    }
    if (cosKnown <= 0.0) return r;
    bool done_ = false, transmitted = false;
    if (feature(FEATURE_PHONG) && b.kind == KIND_PHONG && u.z >= b.diffuseChance) {
        real versine = samplePhongVersine(u.x, b.exponent);
        real s = sqrt(versine * (2.0 - versine)), phi = 2.0 * PI * (u.y - 0.5);
        r.direction = toWorld(real3(s * cos(phi), s * sin(phi), 1.0 - versine), reflectAbout(wKnown, b.n));
        done_ = true;
    }
    if (feature(FEATURE_METALLIC_ROUGHNESS | FEATURE_CONDUCTOR | FEATURE_ROUGH_DIELECTRIC)) {
        bool glossy = b.kind == KIND_ROUGH_CONDUCTOR || b.kind == KIND_ROUGH_DIELECTRIC ||
                      (b.kind == KIND_METALLIC_ROUGHNESS && u.z >= metallicDiffuseChance(b, cosKnown));
        if (glossy) {
            real3 t, bt;
            tangentFrame(b.n, t, bt);
            real3 local = real3(dot(wKnown, t), dot(wKnown, bt), cosKnown);
            real3 hLocal = ggxSampleVisibleNormal(local, b.alpha, u.xy);
            real3 h = t * hLocal.x + bt * hLocal.y + b.n * hLocal.z;
            real c = dot(wKnown, h);
            r.direction = reflectAbout(wKnown, h);
            transmitted = feature(FEATURE_ROUGH_DIELECTRIC) && b.kind == KIND_ROUGH_DIELECTRIC &&
                          u.z >= fresnelDielectric(c, b.eta);
            if (transmitted) {
                real cosT = sqrt(max(1.0 - (1.0 - c * c) / (b.eta * b.eta), 0.0));
                r.direction = normalize(-wKnown / b.eta + h * (c / b.eta - cosT));
            }
            done_ = true;
        }
    }
    if (!done_) r.direction = toWorld(sampleCosineHemisphere(u.xy), b.n);
    r.value = evalBsdf(b, wKnown, r.direction, adjoint, r.pdf, r.reversePdf);
    // What a microfacet reflects to below the surface, or refracts to above it, is lost: evalBsdf would take it for the
    // other lobe, whose density does not count it.
    real cosNew = dot(r.direction, b.n), sideNew = dot(r.direction, b.ng);
    r.valid = r.pdf > 0.0 && (cosNew < 0.0) == transmitted;
    r.zeroPdf = !(r.pdf > 0.0) && (transmitted ? cosNew < 0.0 && sideNew < 0.0 : cosNew > 0.0 && sideNew > 0.0);
    return r;
}

/// Veach's correction for shading normals on light paths (1997, eq. 5.19): |cos_shading(known)·cos_geometric(new)| over
/// |cos_geometric(known)·cos_shading(new)|, to be multiplied with the shading cosine of wNew.
real adjointCosine(Bsdf b, real3 wKnown, real3 wNew) {
    real cosine = abs(dot(wNew, b.ng));
    if (feature(FEATURE_ATTRIBUTES)) cosine *= abs(dot(wKnown, b.n) / dot(wKnown, b.ng));
    return cosine;
}
#endif
