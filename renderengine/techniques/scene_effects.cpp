#include "renderengine/scene_effects.h"

#include <algorithm>
#include <stdexcept>

#include "gpu/pack_materials.h"
#include "gpu/packed_scene.h"
#include "scene/scene_fields.h"

namespace antipode {
namespace {

using namespace shared;
using enum EffectGroup;

/// What pipelines are specialised on.
struct Marks {
    uint32_t features = 0, lobes = 0;

    bool in(const PackedScene& scene) const { return ((scene.features & features) | (scene.lobes & lobes)) != 0; }
    bool operator==(const Marks&) const = default;
};
constexpr Marks feature(uint32_t bits) { return {bits, 0}; }
constexpr Marks lobe(uint32_t bits) { return {0, bits}; }

struct EffectRow {
    SceneEffect effect;
    Marks marks;  ///< of which one says that it is present
    void (*remove)(Scene&) = nullptr;
};

void removeTextures(Scene& scene) {
    for (Material& m : scene.materials)
        for (TextureIndex* texture :
             {&m.baseColorTexture, &m.emissionTexture, &m.metallicRoughnessTexture, &m.transmissionTexture,
              &m.clearcoatTexture, &m.clearcoatRoughnessTexture, &m.sheenColorTexture, &m.sheenRoughnessTexture})
            texture->reset();
}

void removeNormalMaps(Scene& scene) {
    for (Material& m : scene.materials) m.normalTexture.reset();
}

void removeAlpha(Scene& scene) {
    for (Material& m : scene.materials) {
        if (isHole(m)) continue;
        m.alphaCutoff.reset();
        m.coverage.reset();
    }
}

void removeAbsorption(Scene& scene) {
    for (Material& m : scene.materials) m.attenuationDistance.reset();
}

void removeScattering(Scene& scene) {
    for (Material& m : scene.materials) m.scatteringDistance.reset();
}

void removeDispersion(Scene& scene) {
    for (Material& m : scene.materials) m.abbeNumber.reset();
}

void removeClearcoat(Scene& scene) {
    for (Material& m : scene.materials) m.clearcoat = 0;
}

void removeSheen(Scene& scene) {
    for (Material& m : scene.materials) m.sheenColor = Vec3f(0.0f);
}

void removeVertexColors(Scene& scene) {
    for (Mesh& mesh : scene.meshes) mesh.colors.clear();
}

void removeEnvironmentMap(Scene& scene) {
    Environment& sky = *scene.environment;
    Vec3d sum;
    for (const Vec3f& texel : sky.map) sum += Vec3d(texel);
    sky.radiance = sky.radiance * Vec3f(sum / double(sky.map.size()));
    sky.map.clear();
    sky.width = sky.height = 0;
}

/// Mirrors have no mark of their own: every specular lobe begins as one.
constexpr Marks mirrors;

const std::vector<EffectRow>& effectTable() {
    static const std::vector<EffectRow> rows{
        {{"triangles", Shapes, "triangle meshes", "modelled surfaces"}, feature(FEATURE_TRIANGLES)},
        {{"spheres", Shapes, "exact spheres", "round at any distance"}, feature(FEATURE_SPHERES)},
        {{"attributes", Shapes, "smooth normals, texture coordinates", "facets shade as one surface"},
         feature(FEATURE_ATTRIBUTES)},
        {{"more_uvs", Shapes, "several sets of texture coordinates", "textures placed apart"},
         feature(FEATURE_MORE_UVS)},
        {{"vertex_colors", Shapes, "vertex colours", "colour painted on the mesh"},
         feature(FEATURE_VERTEX_COLORS),
         removeVertexColors},
        {{"tangents", Shapes, "tangents", "normal maps turned as they were baked"}, feature(FEATURE_TANGENTS)},

        {{"matte", Surfaces, "matte surfaces", "chalk, paper, walls"}, lobe(LOBE_LAMBERT)},
        {{"phong", Surfaces, "glossy paint", "Phong highlights"}, lobe(LOBE_PHONG)},
        {{"metallic_roughness", Surfaces, "painted and metallic surfaces", "the material of glTF and game engines"},
         lobe(LOBE_METALLIC_ROUGHNESS)},
        {{"clearcoat", Surfaces, "clear coats", "lacquer: a sharp gloss over another surface"},
         lobe(LOBE_CLEARCOAT),
         removeClearcoat},
        {{"sheen", Surfaces, "sheen", "velvet and cloth: bright where seen from the side"},
         lobe(LOBE_SHEEN),
         removeSheen},
        {{"conductors", Surfaces, "measured metals", "gold, copper, aluminium by their optical constants"},
         lobe(LOBE_CONDUCTOR)},
        {{"mirrors", Surfaces, "mirrors", "show the scene again, and throw light on it"}, mirrors},
        {{"clear_glass", Surfaces, "clear glass", "bends light: refractions and caustics"}, lobe(LOBE_DIELECTRIC)},
        {{"frosted_glass", Surfaces, "frosted glass", "bends light and blurs it"}, lobe(LOBE_ROUGH_DIELECTRIC)},
        {{"partial_glass", Surfaces, "panes, tinted or partial glass", "windows, coloured bottles"},
         lobe(LOBE_TRANSMISSION)},
        {{"touching_glass", Surfaces, "glass that touches or encloses", "liquid in a glass, ice in the liquid"},
         feature(FEATURE_INTERFACES)},
        {{"absorption", Surfaces, "glass that absorbs", "deeper is darker and more coloured"},
         feature(FEATURE_ABSORPTION),
         removeAbsorption},
        {{"scattering", Surfaces, "bodies that scatter light inside", "milk, wax, fog: light spreads in them"},
         feature(FEATURE_SCATTERING),
         removeScattering},
        {{"dispersion", Surfaces, "glass that disperses light", "rainbows: each colour is bent by itself"},
         feature(FEATURE_DISPERSION),
         removeDispersion},
        {{"textures", Surfaces, "textures", "colour and finish from images"},
         feature(FEATURE_TEXTURES),
         removeTextures},
        {{"nearest_texels", Surfaces, "textures without smoothing", "pixels keep their edges"},
         feature(FEATURE_NEAREST)},
        {{"normal_maps", Surfaces, "normal maps", "relief from images"},
         feature(FEATURE_NORMAL_MAPS),
         removeNormalMaps},
        {{"alpha", Surfaces, "cut-outs", "leaves, fences, veils"}, feature(FEATURE_ALPHA), removeAlpha},
        {{"blending", Surfaces, "part-transparent surfaces", "light passes in part"}, feature(FEATURE_BLENDING)},

        {{"glowing_surfaces", Lamps, "glowing surfaces", "lamps with a size: soft shadows"},
         feature(FEATURE_LIGHT_TRIANGLES)},
        {{"glowing_spheres", Lamps, "glowing spheres", "lamps with a size: soft shadows"},
         feature(FEATURE_LIGHT_SPHERES)},
        {{"points", Lamps, "point lamps", "no size: sharp shadows, never seen themselves"},
         feature(FEATURE_LIGHT_POINTS)},
        {{"spots", Lamps, "spotlights", "no size, a cone of light"}, feature(FEATURE_LIGHT_SPOTS)},
        {{"suns", Lamps, "suns", "parallel light: sharp shadows"}, feature(FEATURE_LIGHT_DIRECTIONALS)},
        {{"sky", Lamps, "a sky", "light from all around"}, feature(FEATURE_ENVIRONMENT)},
        {{"sky_map", Lamps, "a sky from an image", "its bright parts are aimed at"},
         feature(FEATURE_ENVIRONMENT_MAP),
         removeEnvironmentMap},

        {{"lens", View, "a lens", "blurs what is out of focus"},
         feature(FEATURE_LENS),
         [](Scene& scene) { scene.camera.lensRadius = 0; }},
        {{"orthographic", View, "parallel projection", "no perspective"}, feature(FEATURE_ORTHOGRAPHIC)},
    };
    return rows;
}

bool hasMirrors(const Scene& scene) {
    const auto isMirror = [&](uint32_t material) {
        const Material& m = scene.materials[material];
        return m.kind == MaterialKind::Mirror && !isBlack(m) && !isHole(m);
    };
    return std::ranges::any_of(scene.meshes,
                               [&](const Mesh& m) { return !m.triangles.empty() && isMirror(m.material); }) ||
           std::ranges::any_of(scene.spheres, [&](const Sphere& s) { return isMirror(s.material); });
}

constexpr LightCount countOf(Of<PointLight>) { return {"point lamp", "point lamps"}; }
constexpr LightCount countOf(Of<SpotLight>) { return {"spotlight", "spotlights"}; }
constexpr LightCount countOf(Of<DirectionalLight>) { return {"sun", "suns"}; }
constexpr LightCount countOf(Of<Environment>) { return {"sky", "skies"}; }

}  // namespace

std::vector<LightCount> lightCounts(const Scene& scene) {
    std::vector<LightCount> counts;
    forEachField(scene, [&](auto field, const auto& lights) {
        if constexpr (field.role == Role::Light) {
            LightCount& count = counts.emplace_back(countOf(Of<Entry<decltype(lights)>>{}));
            forEachEntry(lights, [&](const auto&) { ++count.number; });
        }
    });
    return counts;
}

const char* name(EffectGroup group) {
    switch (group) {
        case Shapes: return "shapes";
        case Surfaces: return "surfaces";
        case Lamps: return "lamps";
        case View: return "camera";
    }
    return "";
}

std::vector<SceneEffect> sceneEffects(const Scene& scene) {
    validate(scene);
    const PackedScene packed = packScene(scene);
    std::vector<SceneEffect> effects;
    for (const EffectRow& row : effectTable()) {
        SceneEffect effect = row.effect;
        effect.present = row.marks == mirrors ? hasMirrors(scene) : row.marks.in(packed);
        effect.removable = effect.present && row.remove != nullptr;
        effects.push_back(effect);
    }
    return effects;
}

Scene sceneWithout(const Scene& scene, const std::string& key) {
    for (const EffectRow& row : effectTable()) {
        if (key != row.effect.key || !row.remove) continue;
        Scene changed = scene;
        row.remove(changed);
        return changed;
    }
    throw std::logic_error("the effect '" + key + "' cannot be taken away");
}

}  // namespace antipode
