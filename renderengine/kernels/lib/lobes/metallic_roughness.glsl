// glTF's metallic-roughness model: a GGX layer with Schlick's Fresnel over a Lambertian base.
#ifndef ANTIPODE_METALLIC_ROUGHNESS
#define ANTIPODE_METALLIC_ROUGHNESS
#include "lib/lobes/lambert.glsl"

/// `parameters`: the material's texel 3. `ior` of the dielectric part.
void loadMetallicRoughness(inout Bsdf b, uint material, real2 uv, uvec4 parameters, real ior) {
    real metallic = uintBitsToFloat(parameters.x), specularFactor = uintBitsToFloat(parameters.y);
    real roughness = b.alpha;  // perceptual here: the texture multiplies it
    if (feature(FEATURE_TEXTURES)) {
        uint map = texelFetch(materials, int(material + 4u)).z;
        if (map != NO_INDEX) {
            real4 texel = sampleTexture(map, uv);
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

/// What the specular layer leaves to the diffuse lobe: (1−F(known))(1−F(new))/(1−F̄), F̄ = F0 + (F90−F0)/21 the
/// cosine-weighted mean of Schlick's term (Kelemen and Szirmay-Kalos 2001). glTF's own 1−F(h) reflects up to 1.24 of
/// what arrives at grazing angles; this is reciprocal, equal to it at normal incidence, and keeps the sum below 1.
real metallicDiffuseScale(Bsdf b, real cosKnown, real cosNew) {
    real f0 = max(b.glossy.x, max(b.glossy.y, b.glossy.z));
    real known = fresnelSchlick(cosKnown, real3(f0), b.f90).x, new_ = fresnelSchlick(cosNew, real3(f0), b.f90).x;
    real passed = 1.0 - (f0 + (b.f90 - f0) / 21.0);
    return passed > 0.0 ? (1.0 - known) * (1.0 - new_) / passed : 0.0;
}

/// Chance of the diffuse lobe for a direction with cosine `c`: by the lobes' albedos.
real metallicDiffuseChance(Bsdf b, real c) {
    real3 f = fresnelSchlick(c, b.glossy, b.f90);
    real s = max(f.x, max(f.y, f.z));
    real d = max(b.diffuse.x, max(b.diffuse.y, b.diffuse.z)) * (1.0 - s);
    return d + s > 0.0 ? d / (d + s) : 1.0;
}

/// Whether `choice` in [0,1) takes the GGX layer, which reflects about a visible normal, and not the base.
bool samplesMetallicGlossy(Bsdf b, real cosKnown, real choice) { return choice >= metallicDiffuseChance(b, cosKnown); }

void addMetallicRoughness(inout LobeSum sum, Bsdf b, Microfacets m) {
    real chance = metallicDiffuseChance(b, m.cosKnown), reverseChance = metallicDiffuseChance(b, m.cosNew);
    sum.value += fresnelSchlick(m.cosHalf, b.glossy, b.f90) * m.value;
    sum.pdf += microfacetPdf(m, 1.0 - chance);
    sum.reversePdf += microfacetReversePdf(m, 1.0 - reverseChance);
    addLambert(sum, b, real3(metallicDiffuseScale(b, m.cosKnown, m.cosNew)), chance, reverseChance, m.cosKnown,
               m.cosNew);
}
#endif
