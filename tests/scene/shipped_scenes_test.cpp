// Every scene of the repository loads, says nothing and has the geometry that its comments claim.
#include <filesystem>
#include <numbers>

#include "proto/scene_loader.h"
#include "proto/scene_translation.h"
#include "tests/scene/model_files.h"

namespace antipode {
namespace {

const std::filesystem::path kScenes = std::filesystem::path(ANTIPODE_SOURCE_DIR) / "scenes";

Scene load(const std::string& name) { return loadScene((kScenes / name).string()); }

const Mesh& meshOf(const Scene& scene, const std::string& name) {
    for (const Mesh& mesh : scene.meshes)
        if (mesh.name == name) return mesh;
    throw std::runtime_error("no mesh " + name);
}

Vec3f frontOf(const Mesh& mesh, size_t triangle = 0) {
    const auto& t = mesh.triangles.at(triangle);
    return normalize(cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]));
}

TEST(ShippedScenes, AllLoadWithoutNoticesAndSurviveTheWire) {
    size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kScenes)) {
        if (entry.path().extension() != ".textproto") continue;
        SCOPED_TRACE(entry.path().string());
        const Scene scene = loadScene(entry.path().string());
        EXPECT_TRUE(scene.notices.empty()) << scene.notices[0];
        EXPECT_EQ(sceneHash(fromProto(toProto(scene))), sceneHash(scene));
        ++count;
    }
    EXPECT_EQ(count, 14u);
}

class CornellScenes : public ::testing::TestWithParam<const char*> {};

TEST_P(CornellScenes, WallsFaceTheRoom) {
    const Scene scene = load(std::string("cornell/") + GetParam() + ".textproto");
    const std::pair<const char*, Vec3f> walls[] = {{"floor", {0, 0, 1}},
                                                   {"ceiling", {0, 0, -1}},
                                                   {"back wall", {0, -1, 0}},
                                                   {"left wall", {1, 0, 0}},
                                                   {"right wall", {-1, 0, 0}}};
    for (const auto& [name, front] : walls) {
        for (size_t i : {0, 1}) EXPECT_EQ(frontOf(meshOf(scene, name), i), front) << name;
        EXPECT_FALSE(scene.materials[meshOf(scene, name).material].twoSided);
    }
    EXPECT_EQ(scene.materials[meshOf(scene, "floor").material].kind, MaterialKind::Phong);
    EXPECT_NEAR(scene.camera.verticalFov, std::numbers::pi / 4, 1e-7);
    for (const Sphere& sphere : scene.spheres) {
        EXPECT_NEAR(sphere.center.z - sphere.radius, -1.28002, 1e-6) << "stands on the floor";
        EXPECT_TRUE(scene.materials[sphere.material].twoSided);
    }
    EXPECT_EQ(scene.maxPathLength, std::optional(10u));
}
INSTANTIATE_TEST_SUITE_P(All, CornellScenes, ::testing::Values("sun", "area", "point", "sky"));

TEST(ShippedScenes, CornellAreaLamp) {
    const Scene scene = load("cornell/area.textproto");
    const Mesh& lamp = meshOf(scene, "lamp");
    EXPECT_EQ(scene.materials[lamp.material].emission, Vec3f(25.0333f));
    EXPECT_EQ(scene.materials[lamp.material].baseColor, Vec3f(0.0f));
    for (size_t i : {0, 1}) EXPECT_EQ(frontOf(lamp, i), Vec3f(0, 0, -1));
    // The housing's four sides look outwards.
    const Mesh& housing = meshOf(scene, "lamp housing");
    ASSERT_EQ(housing.triangles.size(), 8u);
    for (size_t i = 0; i < 8; ++i) {
        Vec3f middle;
        for (uint32_t v : housing.triangles[i]) middle += housing.positions[v] / 3.0f;
        EXPECT_GT(dot(frontOf(housing, i), middle - Vec3f(0, 0, 1.27002f)), 0) << i;
    }
}

TEST(ShippedScenes, CornellSpheres) {
    const Scene scene = load("cornell/sun.textproto");
    ASSERT_EQ(scene.spheres.size(), 2u);
    EXPECT_NEAR(scene.spheres[0].center.x, -1.27029 + 2.56004 * 2 / 7, 1e-5);
    EXPECT_NEAR(scene.spheres[1].center.x, 1.28975 - 2.56004 * 2 / 7, 1e-5);
    EXPECT_EQ(scene.materials[scene.spheres[0].material].kind, MaterialKind::Mirror);
    EXPECT_EQ(scene.materials[scene.spheres[1].material].kind, MaterialKind::Dielectric);
    EXPECT_EQ(scene.materials[scene.spheres[1].material].ior, 1.6f);
    EXPECT_EQ(scene.directionalLights.at(0).irradiance, Vec3f(10, 4, 0));
}

// Beyond radius / ior from the centre, total reflection would trap rays for ever.
TEST(ShippedScenes, LampsOfTheStillLifeLieInsideGlassAndTrapNoRay) {
    const Scene scene = load("glass_caustics.textproto");
    size_t lamps = 0;
    for (const Sphere& lamp : scene.spheres) {
        if (!scene.materials[lamp.material].emits()) continue;
        ++lamps;
        bool inside = false;
        for (const Sphere& glass : scene.spheres) {
            const Material& material = scene.materials[glass.material];
            inside |= material.kind == MaterialKind::Dielectric &&
                      length(lamp.center - glass.center) + lamp.radius < glass.radius / material.ior;
        }
        EXPECT_TRUE(inside);
    }
    EXPECT_EQ(lamps, 3u);
}

TEST(ShippedScenes, PoolIsReadyForCaustics) {
    const Scene scene = load("pool.textproto");
    const Mesh& water = meshOf(scene, "water");
    EXPECT_EQ(water.triangles.size(), 2u * 200 * 200);
    EXPECT_GT(frontOf(water).y, 0.9f);
    for (size_t i = 0; i < water.positions.size(); ++i) {
        EXPECT_LT(std::abs(water.positions[i].y), 0.05f);
        EXPECT_GT(water.normals[i].y, 0.8f);
    }
    EXPECT_EQ(scene.textures.at(0).width, 256u);
    EXPECT_EQ(frontOf(meshOf(scene, "bottom")), Vec3f(0, 1, 0));
    EXPECT_EQ(frontOf(meshOf(scene, "left wall")), Vec3f(1, 0, 0));
    EXPECT_EQ(frontOf(meshOf(scene, "front wall")), Vec3f(0, 0, -1));
}

}  // namespace
}  // namespace antipode
