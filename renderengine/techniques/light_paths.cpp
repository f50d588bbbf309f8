#include "renderengine/light_paths.h"

#include <algorithm>

#include "gpu/pack_materials.h"
#include "kernels/shared/layout.h"
#include "scene/scene_fields.h"
#include "techniques/technique.h"

namespace antipode {
namespace {

void addSurface(const Material& m, LightPathFacts& facts) {
    if (isHole(m)) return;
    facts.sizedLamps |= m.emits();
    if (isBlack(m)) return;
    facts.scattering |= !isSpecular(m);
    facts.specular |= hasSpecularPart(m);
    facts.media |= m.scattersInside();
}

}  // namespace

LightPathFacts lightPathFacts(const Scene& scene) {
    LightPathFacts facts;
    for (const Mesh& mesh : scene.meshes)
        if (!mesh.triangles.empty()) addSurface(scene.materials[mesh.material], facts);
    for (const Sphere& sphere : scene.spheres) addSurface(scene.materials[sphere.material], facts);
    const auto shines = [](const Vec3f& value) { return maxComponent(value) > 0; };
    forEachLight(scene, [&](const auto& light) {
        if constexpr (requires { light.radiance; }) facts.sizedLamps |= shines(light.radiance);
        if constexpr (requires { light.intensity; }) facts.sizelessLamps |= shines(light.intensity);
        if constexpr (requires { light.irradiance; }) facts.sizelessLamps |= shines(light.irradiance);
    });
    return facts;
}

uint32_t PathClass::fewestEdges() const {
    return scattered ? 2u + uint32_t(specularStart) + uint32_t(specularEnd) + uint32_t(adjacent) : 1u;
}

std::string PathClass::expression() const {
    if (!scattered) return "LS*E";
    const std::string d = mediaAlone ? "M" : "D";
    return (specularStart ? "LS+" : "L") + d + (adjacent ? "…" + d : "") + (specularEnd ? "S+E" : "E");
}

std::string PathClass::words() const {
    if (!scattered) return "lamps and skies themselves";
    std::string light = specularStart ? "caustics" : adjacent ? "indirect light" : "direct light";
    if (mediaAlone) light += " in media";
    return light + (sizeless ? " of points, spots and suns" : " of glowing surfaces and skies") +
           (specularEnd ? ", seen in mirrors or through glass" : "");
}

std::vector<PathClass> pathClasses(const LightPathFacts& facts, std::optional<uint32_t> maxPathLength) {
    std::vector<PathClass> classes;
    const auto add = [&](const PathClass& c) {
        if (c.fewestEdges() <= maxPathLength.value_or(c.fewestEdges())) classes.push_back(c);
    };
    if (facts.sizedLamps) add({.scattered = false});
    for (const bool media : {false, true})
        for (const bool sizeless : {false, true}) {
            if (!(media ? facts.media : facts.scattering)) continue;
            if (!(sizeless ? facts.sizelessLamps : facts.sizedLamps)) continue;
            for (const bool start : {false, true})
                for (const bool adjacent : {false, true})
                    for (const bool end : {false, true})
                        if (facts.specular || (!start && !end)) add({sizeless, true, start, end, adjacent, media});
        }
    return classes;
}

std::vector<PathClass> missingClasses(const LightPathFacts& facts, const RenderSettings& settings) {
    const TechniquePlan plan = planTechnique(settings);
    std::vector<PathClass> missing;
    for (const PathClass& c : pathClasses(facts, settings.maxPathLength))
        if (!makes(plan, c)) missing.push_back(c);
    return missing;
}

std::string described(const std::vector<PathClass>& classes) {
    std::vector<std::pair<std::string, std::string>> parts;  // words, expressions
    for (const PathClass& c : classes) {
        const auto same = [&](const auto& part) { return part.first == c.words(); };
        const auto found = std::find_if(parts.begin(), parts.end(), same);
        if (found != parts.end())
            found->second += ", " + c.expression();
        else
            parts.emplace_back(c.words(), c.expression());
    }
    std::string text;
    for (const auto& [words, expressions] : parts)
        text += (text.empty() ? "" : "; ") + words + " (" + expressions + ")";
    return text;
}

}  // namespace antipode
