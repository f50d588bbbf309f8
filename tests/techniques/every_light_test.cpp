// A kind of light is a row in the table of Scene and its physics: whatever else looks at lights finds each of them.
#include <gtest/gtest.h>

#include "client/explanation.h"
#include "gpu/near_lights.h"
#include "gpu/packed_scene.h"
#include "scene/defaults.h"
#include "scene/scene_fields.h"
#include "tests/scene/full_scene.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

Scene floorScene() {
    Scene scene;
    addHorizontalSquare(scene, {0, 0, 0}, 2, addLambert(scene, Vec3f(0.5f)));
    scene.camera = lookAt({0, 3, 3}, {0, 0, 0}, {0, 1, 0}, 0.8);
    return scene;
}

/// Calls visit(name, scene, hasIntensity) with the floor under each kind of light of fullScene() alone.
template <class Visit>
void forEachKindOfLight(const Visit& visit) {
    const Scene full = antipode::testing::fullScene();
    forEachField(full, [&](auto field, const auto& lights) {
        if constexpr (field.role == Role::Light) {
            SCOPED_TRACE(field.name);
            Scene scene = floorScene();
            scene.*(field.member) = lights;
            visit(
                scene, requires(Entry<decltype(lights)> light) { light.intensity; });
        }
    });
}

size_t lampEffects(const Scene& scene) {
    size_t present = 0;
    for (const SceneEffect& effect : sceneEffects(scene))
        present += effect.present && effect.group == EffectGroup::Lamps;
    return present;
}

size_t partsInShort(const Scene& scene) { return size_t(std::ranges::count(sceneInShort(scene, {})[0], ',')) + 1; }

TEST(EveryLight, IsRendered) {
    forEachKindOfLight([](const Scene& scene, bool hasIntensity) {
        EXPECT_EQ(packScene(scene).lightCount, 1u);
        EXPECT_EQ(brightestSpot(scene, 0) > 0, hasIntensity);
        const LightPathFacts facts = lightPathFacts(scene);
        EXPECT_TRUE(facts.sizedLamps || facts.sizelessLamps);
    });
    EXPECT_EQ(packScene(floorScene()).lightCount, 0u);
}

TEST(EveryLight, LightsAScene) {
    EXPECT_FALSE(hasLight(floorScene()));
    forEachKindOfLight([](const Scene& scene, bool) { EXPECT_TRUE(hasLight(scene)); });
}

TEST(EveryLight, IsTold) {
    EXPECT_EQ(partsInShort(floorScene()), 1u);
    forEachKindOfLight([](const Scene& scene, bool) {
        EXPECT_GE(lampEffects(scene), 1u);
        EXPECT_EQ(partsInShort(scene), 2u);
        EXPECT_EQ(explainScene(scene, {}).lamps, 1u);
    });
}

}  // namespace
}  // namespace antipode::test
