// Scenes that nobody here made, where ANTIPODE_SHARED tells where they are.
#include <cstdlib>
#include <numbers>

#include "tests/scene/model_files.h"

namespace antipode {
namespace {

constexpr float kDegree = std::numbers::pi_v<float> / 180;

class SharedScenes : public ::testing::Test {
protected:
    void SetUp() override {
        const char* root = std::getenv("ANTIPODE_SHARED");
        if (!root) GTEST_SKIP() << "ANTIPODE_SHARED is not set: the shared sample scenes are not here.";
        root_ = std::string(root) + "/scenes/";
    }
    Scene load(const std::string& name) const { return importModel(root_ + name); }

    std::string root_;
};

size_t triangleCount(const Scene& scene) {
    size_t count = 0;
    for (const Mesh& mesh : scene.meshes) count += mesh.triangles.size();
    return count;
}

Vec3f brightest(const Scene& scene) {
    Vec3f best;
    for (const Mesh& mesh : scene.meshes) {
        const Vec3f& emission = scene.materials[mesh.material].emission;
        if (maxComponent(emission) > maxComponent(best)) best = emission;
    }
    return best;
}

void expectNear(const Vec3f& a, const Vec3f& b) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], 1e-5f * std::max(1.0f, std::abs(b[axis])));
}

TEST_F(SharedScenes, CornellBoxGlb) {
    const Scene scene = load("cornell-box/cornell-box.glb");
    EXPECT_EQ(triangleCount(scene), 36u);
    EXPECT_NEAR(scene.camera.verticalFov, 19.5f * kDegree, 1e-6f);
    expectNear(scene.camera.position, {0, 1, 6.8f});
    expectNear(scene.camera.forward, {0, 0, -1});
    expectNear(brightest(scene), {17, 12, 4});
    for (const Material& m : scene.materials) EXPECT_EQ(m.kind, MaterialKind::Lambert) << m.name;
}

TEST_F(SharedScenes, CornellBoxObjAgreesWithGlb) {
    const Scene obj = load("cornell-box/cornell-box.obj"), glb = load("cornell-box/cornell-box.glb");
    EXPECT_EQ(triangleCount(obj), 36u);
    expectNear(brightest(obj), {17, 12, 4});
    ASSERT_EQ(obj.materials.size(), glb.materials.size());
    for (size_t i = 0; i < obj.materials.size(); ++i) {
        EXPECT_EQ(obj.materials[i].kind, MaterialKind::Lambert);
        expectNear(obj.materials[i].baseColor, glb.materials[i].baseColor);
    }
}

TEST_F(SharedScenes, VeachMis) {
    const Scene scene = load("veach-mis/veach-mis.glb");
    EXPECT_NEAR(scene.camera.verticalFov, 20.11429322446647f * kDegree, 1e-6f);
    EXPECT_NEAR(double(scene.imageWidth) / scene.imageHeight, 16.0 / 9, 2e-3);
    expectNear(scene.camera.position, {28.2792f, 3.5f, 1.23612e-06f});
    expectNear(brightest(scene), Vec3f(3039.64f));
    // Three lamps share one name; each keeps its own strength.
    std::vector<float> strengths;
    for (const Mesh& mesh : scene.meshes)
        if (const float e = scene.materials[mesh.material].emission.x; e > 0) strengths.push_back(e);
    std::sort(strengths.begin(), strengths.end());
    ASSERT_EQ(strengths.size(), 3u);
    EXPECT_FLOAT_EQ(strengths[0], 7.59909f);
    EXPECT_FLOAT_EQ(strengths[1], 30.3964f);
}

TEST_F(SharedScenes, WaterCaustic) {
    const Scene scene = load("water-caustic/water-caustic.glb");
    EXPECT_NEAR(double(triangleCount(scene)), 103e3, 1e3);
    expectNear(brightest(scene), Vec3f(541127, 381972, 127324));
    size_t glass = 0;
    for (const Material& m : scene.materials) {
        if (m.kind != MaterialKind::Dielectric) continue;
        ++glass;
        EXPECT_FLOAT_EQ(m.ior, 1.8f);
    }
    EXPECT_EQ(glass, 1u);
}

}  // namespace
}  // namespace antipode
