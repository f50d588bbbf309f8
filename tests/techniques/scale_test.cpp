// A scene scaled by a power of two gives the same bytes: no length in the engine is absolute.
#include <cmath>

#include "proto/scene_loader.h"
#include "tests/techniques/engine_fixture.h"

namespace antipode::test {
namespace {

/// Every length × 2^exponent; intensities × 4^exponent, which keeps the irradiance.
Scene scaled(Scene scene, int exponent) {
    const float f = std::ldexp(1.0f, exponent);
    for (Mesh& mesh : scene.meshes)
        for (Vec3f& p : mesh.positions) p *= f;
    for (Sphere& s : scene.spheres) s.center *= f, s.radius *= f;
    for (PointLight& l : scene.pointLights) l.position *= f, l.intensity *= f * f;
    scene.camera.position *= f;
    scene.camera.focusDistance *= f;
    scene.camera.lensRadius *= f;
    return scene;
}

class EngineScale : public EngineTest, public testing::WithParamInterface<const char*> {};

TEST_P(EngineScale, PowersOfTwoGiveTheSameBytes) {
    const Scene scene = loadScene(std::string(ANTIPODE_SOURCE_DIR) + "/scenes/cornell/" + GetParam() + ".textproto");
    RenderSettings settings;
    settings.width = 48;
    settings.height = 32;
    const std::string expected = renderSums(scene, settings, {1, 2}).sha256();
    for (const int exponent : {-20, -10, -1, 1, 10, 20})
        EXPECT_EQ(renderSums(scaled(scene, exponent), settings, {1, 2}).sha256(), expected) << "2^" << exponent;
}

// Area lights and mirrors; points and glass; a constant environment.
INSTANTIATE_TEST_SUITE_P(Cornell, EngineScale, testing::Values("area", "point", "sky"));

}  // namespace
}  // namespace antipode::test
