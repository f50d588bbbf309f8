// A scene that was moved gives the same bytes where its floats can say where it is.
#include <cmath>

#include "scene/origin.h"
#include "tests/techniques/differing_sums.h"
#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/row_names.h"

namespace antipode::test {
namespace {

/// A room with mirror and glass whose coordinates are multiples of 2^-5, under a lamp and a point light.
Scene room() {
    Scene scene;
    scene.materials.resize(4);
    scene.materials[0].baseColor = Vec3f(0.7f, 0.6f, 0.5f);
    scene.materials[1].kind = MaterialKind::Dielectric;
    scene.materials[2].kind = MaterialKind::Mirror;
    scene.materials[3].emission = Vec3f(8);
    const auto quad = [&](const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& d, uint32_t material) {
        Mesh mesh;
        mesh.positions = {a, b, c, d};
        mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
        mesh.material = material;
        scene.meshes.push_back(mesh);
    };
    quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}, 0);
    quad({-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, 0);
    quad({-1, -1, 1}, {-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}, 2);
    quad({-0.25f, 1, -0.25f}, {0.25f, 1, -0.25f}, {0.25f, 1, 0.25f}, {-0.25f, 1, 0.25f}, 3);
    scene.spheres.push_back({{0.25f, -0.5f, 0.25f}, 0.375f, 1});
    scene.pointLights.push_back({{0.5f, 0.5f, 0.5f}, Vec3f(1)});
    scene.camera.position = {0, 0, 3};
    return scene;
}

class EngineTranslation : public EngineTest, public testing::WithParamInterface<Vec3f> {};

TEST_P(EngineTranslation, GivesTheSameBytes) {
    RenderSettings settings;
    settings.width = 48;
    settings.height = 32;
    settings.initialRadius = 0.02;  // its default depends on rounded distances
    const Scene moved = movedToOrigin(room(), -GetParam());
    for (const Precision precision : {Precision::Float, Precision::Double}) {
        settings.precision = precision;
        expectWithin({"Scale", "a room of width 2, moved by up to 131072", "sums of the film that differ", 0},
                     differingSums(renderSums(moved, settings, {1, 2}), renderSums(room(), settings, {1, 2})),
                     deviceName(), precision);
    }
}

// Beyond 2^18 multiples of 2^-5 are no floats any more.
INSTANTIATE_TEST_SUITE_P(By, EngineTranslation,
                         testing::Values(Vec3f(64, 0, 0), Vec3f(0, -1024, 512), Vec3f(100000, 100000, -100000),
                                         Vec3f(0, 131072, 0)),
                         [](const auto& by) { return std::to_string(int(maxComponent(by.param))); });

}  // namespace
}  // namespace antipode::test
