// Where transparent bodies touch, and their order of precedence: a pure function of the scene.
#include "gpu/interfaces.h"

#include <array>
#include <bit>
#include <cmath>

#include <gtest/gtest.h>

namespace antipode {
namespace {

constexpr uint32_t glass = 0, water = 1, wall = 2;

Scene emptyScene() {
    Scene scene;
    scene.materials.resize(3);
    scene.materials[glass].kind = scene.materials[water].kind = MaterialKind::Dielectric;
    scene.materials[glass].ior = 1.5f;
    scene.materials[water].ior = 1.33f;
    return scene;
}

/// The box's sides, each of its own four vertices unless `open`, which leaves the upper one out.
void addBox(Scene& scene, uint32_t material, const Vec3f& low, const Vec3f& high, bool open = false) {
    Mesh mesh;
    mesh.material = material;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            if (open && axis == 2 && side == 1) continue;
            const auto corner = [&](int i, int j) {
                Vec3f p;
                p[axis] = side != 0 ? high[axis] : low[axis];
                p[(axis + 1) % 3] = i != 0 ? high[(axis + 1) % 3] : low[(axis + 1) % 3];
                p[(axis + 2) % 3] = j != 0 ? high[(axis + 2) % 3] : low[(axis + 2) % 3];
                return p;
            };
            const uint32_t first = uint32_t(mesh.positions.size());
            for (const auto& p : {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)}) mesh.positions.push_back(p);
            const std::array<uint32_t, 3> a{first, first + 1, first + 2}, b{first, first + 2, first + 3};
            const auto turned = [&](std::array<uint32_t, 3> t) {
                return side != 0 ? t : std::array<uint32_t, 3>{t[0], t[2], t[1]};
            };
            mesh.triangles.push_back(turned(a));
            mesh.triangles.push_back(turned(b));
        }
    scene.meshes.push_back(std::move(mesh));
}

TEST(Interfaces, BodiesApartHaveNone) {
    Scene scene = emptyScene();
    addBox(scene, glass, {0, 0, 0}, {1, 1, 1});
    addBox(scene, water, {1.01f, 0, 0}, {2, 1, 1});
    scene.spheres.push_back({{-1, 0, 0}, 0.5f, glass});
    EXPECT_FALSE(findInterfaces(scene).present());
}

/// A body by itself that absorbs is a medium, too; after the bodies stands what a unit of length takes.
TEST(Interfaces, BodiesThatAbsorbAreMedia) {
    Scene scene = emptyScene();
    addBox(scene, glass, {0, 0, 0}, {1, 1, 1});
    scene.spheres.push_back({{-2, 0, 0}, 0.5f, water});
    scene.materials[water].attenuationColor = {0.5f, 1, 0};
    EXPECT_FALSE(findInterfaces(scene).present()) << "without a distance nothing is absorbed";
    scene.materials[water].attenuationDistance = 0.25f;
    const Interfaces found = findInterfaces(scene);
    ASSERT_TRUE(found.absorbs);
    ASSERT_EQ(found.bodies.size(), 6u);
    const uint32_t inWater = 3 + found.sphereRanks[0], inGlass = 3 + found.meshRanks[0];
    EXPECT_FLOAT_EQ(std::bit_cast<float>(found.bodies[inWater].x), 4 * std::log(2.0f));
    EXPECT_EQ(std::bit_cast<float>(found.bodies[inWater].y), 0);
    EXPECT_GT(std::bit_cast<float>(found.bodies[inWater].z), 300);
    EXPECT_EQ(found.bodies[inGlass].x, 0u);
    scene.materials[water].thin = true;
    EXPECT_FALSE(findInterfaces(scene).present()) << "a pane holds nothing";
}

/// One that scatters likewise: what a unit of length takes in all, and behind all bodies what it scatters.
TEST(Interfaces, BodiesThatScatterAreMedia) {
    Scene scene = emptyScene();
    addBox(scene, glass, {0, 0, 0}, {1, 1, 1});
    scene.spheres.push_back({{-2, 0, 0}, 0.5f, water});
    scene.materials[water].scatteringColor = {0.5f, 1, 0};
    scene.materials[water].scatteringAnisotropy = 0.25f;
    EXPECT_FALSE(findInterfaces(scene).present()) << "without a distance nothing is scattered";
    scene.materials[water].scatteringDistance = 0.25f;
    scene.materials[water].attenuationColor = {1, 0.5f, 1};
    scene.materials[water].attenuationDistance = 1.0f;
    const Interfaces found = findInterfaces(scene);
    ASSERT_TRUE(found.scatters && found.absorbs);
    ASSERT_EQ(found.bodies.size(), 9u);
    const auto valuesAt = [&](uint32_t i) {
        const shared::uvec4& t = found.bodies[i];
        return std::array{std::bit_cast<float>(t.x), std::bit_cast<float>(t.y), std::bit_cast<float>(t.z),
                          std::bit_cast<float>(t.w)};
    };
    const uint32_t rank = found.sphereRanks[0];
    EXPECT_EQ(valuesAt(6 + rank), (std::array{2.0f, 4.0f, 0.0f, 0.25f}));
    EXPECT_FLOAT_EQ(valuesAt(3 + rank)[1], 4 + std::log(2.0f));
    EXPECT_EQ(valuesAt(6 + found.meshRanks[0]), (std::array{0.0f, 0.0f, 0.0f, 0.0f}));
    scene.materials[water].thin = true;
    EXPECT_FALSE(findInterfaces(scene).present()) << "a pane holds nothing";
}

TEST(Interfaces, SpheresWhoseBoundsOverlapNeedNotTouch) {
    Scene scene = emptyScene();
    scene.spheres = {{{0, 0, 0}, 1, glass}, {{1.2f, 1.2f, 1.2f}, 1, water}};
    EXPECT_FALSE(findInterfaces(scene).present());
    scene.spheres[1].center = Vec3f(1.1f);
    EXPECT_TRUE(findInterfaces(scene).present());
}

TEST(Interfaces, SharedAndPartlySharedFacesTouch) {
    for (const float far : {1.0f, 0.25f, 3.0f}) {
        Scene scene = emptyScene();
        addBox(scene, glass, {0, 0, 0}, {1, 1, 1});
        addBox(scene, water, {1, 0, 0}, {2, far, far});
        const Interfaces found = findInterfaces(scene);
        ASSERT_TRUE(found.present());
        EXPECT_EQ(found.meshRanks, (std::vector<uint32_t>{1, 2}));
        ASSERT_EQ(found.bodies.size(), 3u);
        EXPECT_EQ(found.bodies[1].x, std::bit_cast<uint32_t>(1.5f));
        EXPECT_EQ(found.bodies[2].x, std::bit_cast<uint32_t>(1.33f));
        EXPECT_EQ(found.bodies[2].z, std::bit_cast<uint32_t>(1.33f));  // of medium 2, the third: after none and glass
        EXPECT_EQ(found.bodies[1].w, 1u);
    }
}

/// Bodies of one index that spread it differently are different media; after the bodies stands by how much.
TEST(Interfaces, MediaSpreadTheirIndices) {
    Scene scene = emptyScene();
    scene.materials[water] = scene.materials[glass];
    scene.materials[water].abbeNumber = 20;
    addBox(scene, glass, {0, 0, 0}, {1, 1, 1});
    addBox(scene, water, {0.5f, 0, 0}, {2, 1, 1});
    const Interfaces found = findInterfaces(scene);
    ASSERT_EQ(found.bodies.size(), 6u);
    EXPECT_FALSE(found.absorbs);
    EXPECT_EQ(found.bodies[2].y, 2u) << "a medium of its own";
    EXPECT_EQ(found.bodies[3].w, 0u);
    EXPECT_EQ(found.bodies[4].w, 0u);
    EXPECT_EQ(found.bodies[5].w, std::bit_cast<uint32_t>(0.5f / 20));
}

TEST(Interfaces, TheMoreDeeplyNestedWinsThenTheLaterThenThePriority) {
    Scene scene = emptyScene();
    addBox(scene, water, {0.2f, 0.2f, 0.2f}, {0.8f, 0.8f, 0.8f});
    addBox(scene, glass, {0, 0, 0}, {1, 1, 1});
    EXPECT_EQ(findInterfaces(scene).meshRanks, (std::vector<uint32_t>{2, 1}));
    scene.materials[glass].priority = 1;
    EXPECT_EQ(findInterfaces(scene).meshRanks, (std::vector<uint32_t>{1, 2}));
}

TEST(Interfaces, BodiesFarFromAllOthersShareTheRankOfTheirIndex) {
    Scene scene = emptyScene();
    for (int i = 0; i < 1000; ++i) scene.spheres.push_back({{float(i), 50, 0}, 0.1f, i % 2 != 0 ? glass : water});
    addBox(scene, glass, {0, 0, 0}, {1, 1, 1});
    addBox(scene, water, {1, 0, 0}, {2, 1, 1});
    const Interfaces found = findInterfaces(scene);
    EXPECT_EQ(found.bodies.size(), 5u);
    EXPECT_EQ(found.sphereRanks[0], found.sphereRanks[998]);
    EXPECT_NE(found.sphereRanks[0], found.meshRanks[1]);
}

TEST(Interfaces, AFaceInTheSamePlaneAsAWallIsOne) {
    Scene scene = emptyScene();
    addBox(scene, water, {0, 0, 0}, {1, 1, 1});
    addBox(scene, wall, {-1, -1, -1}, {2, 2, -0.01f});
    EXPECT_FALSE(findInterfaces(scene).present());
    scene.meshes.pop_back();
    addBox(scene, wall, {-1, -1, -1}, {2, 2, 0});
    EXPECT_TRUE(findInterfaces(scene).present());
    // A ball that stands on the floor touches it in a point, which no light passes.
    scene.meshes.erase(scene.meshes.begin());
    scene.spheres.push_back({{0, 0, 1}, 1, glass});
    EXPECT_FALSE(findInterfaces(scene).present());
}

TEST(Interfaces, OpenSurfacesBoundNothing) {
    Scene scene = emptyScene();
    addBox(scene, glass, {0, 0, 0}, {1, 1, 1}, true);
    addBox(scene, water, {0, 0, 0.5f}, {1, 1, 2});
    EXPECT_FALSE(findInterfaces(scene).present());
}

TEST(Interfaces, RoomIsNothingWhereAllFacesFollowTheAxes) {
    Scene scene = emptyScene();
    addBox(scene, glass, {0, 0, 0}, {1, 1, 1});
    addBox(scene, water, {1, 0, 0}, {2, 1, 1});
    EXPECT_EQ(findInterfaces(scene).bodies[0].w, 0u);
    for (Vec3f& p : scene.meshes[1].positions) p.x += 0.125f * p.y;
    EXPECT_GT(std::bit_cast<float>(findInterfaces(scene).bodies[0].w), 16 * 0x1p-24f);
    EXPECT_LT(std::bit_cast<float>(findInterfaces(scene).bodies[0].w), 1e-5f);
}

}  // namespace
}  // namespace antipode
