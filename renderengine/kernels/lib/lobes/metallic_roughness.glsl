// glTF's metallic-roughness model: a GGX layer with Schlick's Fresnel over a Lambertian base, mixed with metal; and
// with glass, which lib/lobes/dielectric.glsl and rough_dielectric.glsl are told the share of.
#ifndef ANTIPODE_METALLIC_ROUGHNESS
#define ANTIPODE_METALLIC_ROUGHNESS
#include "lib/lobes/clearcoat.glsl"
#include "lib/lobes/lambert.glsl"
#include "lib/lobes/multiple_scattering.glsl"

/// Of the dielectric part, (1 − metallic) of all, the share t is glass: (1−m)t. What is left, (1−m)(1−t) and m, is
/// again a mix of dielectric and metal. Glass of a width below smoothAlpha (gpu/pack_materials.cpp) is smooth.
void loadGlassShare(inout Bsdf b, uint material, TexturePoint point, real width, inout real metallic) {
    uvec4 m5 = texelFetch(materials, int(material + 5u));
    real transmission = uintBitsToFloat(m5.x);
    if (feature(FEATURE_TEXTURES) && m5.y != NO_INDEX && transmission > 0.0)
        transmission *= sampleTexture(m5.y, point).r;
    b.glass = (1.0 - metallic) * transmission;
    b.smoothGlass = width < 1e-4 || (b.eta == 1.0 && !b.thin);
    b.specular = b.glass == 1.0 && b.smoothGlass;
    metallic = b.glass < 1.0 ? metallic / (1.0 - b.glass) : 0.0;
}

/// `parameters`: the material's texel 3. `ior` of the dielectric part.
void loadMetallicRoughness(inout Bsdf b, uint material, TexturePoint point, uvec4 parameters, real ior, real cosKnown) {
    real metallic = uintBitsToFloat(parameters.x), specularFactor = uintBitsToFloat(parameters.y);
    real roughness = b.alpha;  // perceptual here: the texture multiplies it
    if (feature(FEATURE_TEXTURES)) {
        uint map = texelFetch(materials, int(material + 4u)).z;
        if (map != NO_INDEX) {
            real4 texel = sampleTexture(map, point);
            roughness *= texel.g;
            metallic *= texel.b;
        }
    }
    if (lobe(LOBE_TRANSMISSION)) loadGlassShare(b, material, point, roughness * roughness, metallic);
    // A rougher floor than zero keeps D(h) within float range where a texture asks for a mirror. Of floats in
    // double, too: it is part of the model.
    b.alpha = max(roughness * roughness, 2.5e-4);
    real r0 = (ior - 1.0) / (ior + 1.0);
    real3 dielectricF0 = min(r0 * r0 * b.glossy, real3(1.0)) * specularFactor;
    b.glossy = mix(dielectricF0, b.diffuse, metallic);
    b.f90 = mix(specularFactor, 1.0, metallic);
    // Of Schlick's term the cosine-weighted mean is F0 + (1 − F0)/21.
    if (lobe(LOBE_MULTIPLE_SCATTERING))
        loadMultipleScattering(b, cosKnown, b.diffuse + (1.0 - b.diffuse) / real(21.0), metallic);
    b.baseF0 = max(dielectricF0.x, max(dielectricF0.y, dielectricF0.z));
    b.baseF90 = specularFactor;
    b.diffuse *= 1.0 - metallic;
}

/// What the dielectric's specular layer leaves to the diffuse lobe: (1−F(known))(1−F(new))/(1−F̄), F̄ = F0 + (F90−F0)/21
/// the cosine-weighted mean of Schlick's term (Kelemen and Szirmay-Kalos 2001). glTF's own 1−F(h) reflects up to 1.24
/// of what arrives at grazing angles; this is reciprocal, equal to it at normal incidence, and keeps the sum below 1.
/// Under a coat, which scales all that it covers, the mean is that of what both let through.
real metallicDiffuseScale(Bsdf b, real cosKnown, real cosNew) {
    real known = fresnelSchlick(cosKnown, real3(b.baseF0), b.baseF90).x,
         new_ = fresnelSchlick(cosNew, real3(b.baseF0), b.baseF90).x;
    if (lobe(LOBE_CLEARCOAT) && b.coat > 0.0)
        return (1.0 - known) * (1.0 - new_) * clearcoatDiffuseGain(b, cosKnown, cosNew, b.baseF0, b.baseF90);
    real passed = 1.0 - (b.baseF0 + (b.baseF90 - b.baseF0) / 21.0);
    return passed > 0.0 ? (1.0 - known) * (1.0 - new_) / passed : 0.0;
}

/// The albedos of what is drawn as a Lambertian lobe and of the GGX layer, in their greatest channels: for a direction
/// with cosine `c`, of which single scattering loses `loss`.
real2 metallicAlbedos(Bsdf b, real c, real loss) {
    real3 f = fresnelSchlick(c, b.glossy, b.f90);
    real s = max(f.x, max(f.y, f.z));
    real d = max(b.diffuse.x, max(b.diffuse.y, b.diffuse.z)) * (1.0 - fresnelSchlick(c, real3(b.baseF0), b.baseF90).x);
    if (lobe(LOBE_MULTIPLE_SCATTERING)) {
        real multiple = multipleAlbedo(b, loss);
        d += multiple;
        s *= 1.0 - multiple;
    }
    return real2(d, s);
}

/// Chance of a Lambertian direction, by the albedos.
real metallicDiffuseChance(Bsdf b, real c, real loss) {
    real2 albedos = metallicAlbedos(b, c, loss);
    return albedos.x + albedos.y > 0.0 ? albedos.x / (albedos.x + albedos.y) : 1.0;
}

/// Whether `choice` in [0,1) takes the GGX layer, which reflects about a visible normal, and not what is drawn as a
/// Lambertian lobe.
bool samplesMetallicGlossy(Bsdf b, real cosKnown, real choice) {
    return choice >= metallicDiffuseChance(b, cosKnown, b.lossKnown);
}

void addMetallicRoughness(inout LobeSum sum, Bsdf b, Microfacets m) {
    real lossNew = 0.0;
    if (lobe(LOBE_MULTIPLE_SCATTERING)) {
        lossNew = metalLoss(m.cosNew, b.alpha);
        addMultipleScattering(sum, b, lossNew);
    }
    real chance = metallicDiffuseChance(b, m.cosKnown, b.lossKnown),
         reverseChance = metallicDiffuseChance(b, m.cosNew, lossNew);
    sum.value += fresnelSchlick(m.cosHalf, b.glossy, b.f90) * m.value;
    sum.pdf += microfacetPdf(m, 1.0 - chance);
    sum.reversePdf += microfacetReversePdf(m, 1.0 - reverseChance);
    addLambert(sum, b, real3(metallicDiffuseScale(b, m.cosKnown, m.cosNew)), chance, reverseChance, m.cosKnown,
               m.cosNew);
}
#endif
