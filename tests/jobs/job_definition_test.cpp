#include "farm/jobs/job_definition.h"

#include <functional>
#include <set>

#include <gtest/gtest.h>

#include "proto/scene_loader.h"
#include "renderengine/engine.h"
#include "tests/film/expect_error.h"
#include "tests/support/fake_renderer.h"

using namespace antipode;

TEST(JobDefinition, ResolvesWhatDependsOnTheScene) {
    Scene scene = test::tinyScene();
    scene.maxPathLength = 7;
    const RenderSettings settings;
    const JobDefinition job = resolveJob(scene, settings);
    EXPECT_EQ(job.settings.initialRadius, initialRadius(scene, settings));
    EXPECT_EQ(job.settings.maxPathLength, 7u);
    EXPECT_EQ(job.sceneHash, sceneHash(scene));
    EXPECT_EQ(job.kernelHash, kernelHash());
}

TEST(JobDefinition, KeepsWhatIsGiven) {
    Scene scene = test::tinyScene();
    scene.maxPathLength = 7;
    RenderSettings settings;
    settings.maxPathLength = 3;
    settings.initialRadius = 0.5;
    const JobDefinition job = resolveJob(scene, settings);
    EXPECT_EQ(job.settings.maxPathLength, 3u);
    EXPECT_EQ(job.settings.initialRadius, 0.5);
}

TEST(JobDefinition, TakesTheSizeFromTheSceneWhereItIsOpen) {
    Scene scene = test::tinyScene();
    scene.imageWidth = 300, scene.imageHeight = 200;
    const auto sizeOf = [&](const RequestedSize& size) {
        const RenderSettings settings = resolveJob(scene, {}, size).settings;
        return std::pair(settings.width, settings.height);
    };
    EXPECT_EQ(sizeOf({}), std::pair(300u, 200u));
    EXPECT_EQ(sizeOf({30, {}}), std::pair(30u, 20u));
    EXPECT_EQ(sizeOf({{}, 30}), std::pair(45u, 30u));
    EXPECT_EQ(sizeOf({1, 7}), std::pair(1u, 7u));
    EXPECT_EQ(sizeOf({1, {}}), std::pair(1u, 1u));
}

TEST(JobDefinition, IsRefusedBeforeAnyDeviceIsAsked) {
    Scene scene = test::tinyScene();
    test::expectError(ErrorCode::Usage, "more than 2^28 pixels", [&] { resolveJob(scene, {}, {65536, 65536}); });
    scene.imageWidth = 1, scene.imageHeight = 4000000000;
    test::expectError(ErrorCode::Usage, "height must be between 1 and 65536", [&] {
        resolveJob(scene, {}, {65536, {}});
    });
    test::expectError(ErrorCode::Usage, "width must be between 1 and 65536", [&] {
        resolveJob(scene, {}, {65537, 1});
    });
    EXPECT_EQ(resolveJob(scene, {}, {65536, 1}).settings.width, 65536u);
    RenderSettings settings;
    settings.connectionsPerVertex = SettingsLimits::connectionsPerVertex + 1;
    test::expectError(ErrorCode::Usage, "between 1 and 16", [&] { resolveJob(scene, settings, {2, 2}); });
}

TEST(JobDefinition, PathsWithoutRouletteNeedABoundWhichTheSceneMayHave) {
    Scene scene = test::tinyScene();
    RenderSettings settings;
    settings.russianRoulette = false;
    test::expectError(ErrorCode::Usage, "needs a limit (--max-path-length)", [&] {
        resolveJob(scene, settings, {2, 2});
    });
    scene.maxPathLength = 7;
    EXPECT_EQ(resolveJob(scene, settings, {2, 2}).settings.maxPathLength, 7u);
}

TEST(JobDefinition, ItsHashFollowsEverythingThatDecidesTheImage) {
    const Scene scene = test::tinyScene();
    const JobDefinition job = resolveJob(scene, {}, {4, 4});
    EXPECT_EQ(job.hash(), resolveJob(scene, {}, {4, 4}).hash());
    std::set<std::string> hashes{job.hash()};
    const auto expectNew = [&](const char* what, const std::function<void(JobDefinition&)>& change) {
        JobDefinition other = job;
        change(other);
        EXPECT_TRUE(hashes.insert(other.hash()).second) << what;
    };
    expectNew("scene", [](auto& j) { j.sceneHash[0] ^= 1; });
    expectNew("kernels", [](auto& j) { j.kernelHash[0] ^= 1; });
    expectNew("width", [](auto& j) { ++j.settings.width; });
    expectNew("height", [](auto& j) { ++j.settings.height; });
    expectNew("technique", [](auto& j) { j.settings.technique = "pt"; });
    expectNew("seed", [](auto& j) { ++j.settings.seed; });
    expectNew("radius", [](auto& j) { *j.settings.initialRadius *= 2; });
    expectNew("alpha", [](auto& j) { j.settings.alpha = 0.5; });
    expectNew("length", [](auto& j) { j.settings.maxPathLength = 9; });
    expectNew("roulette", [](auto& j) { j.settings.russianRoulette = false; });
    expectNew("light paths", [](auto& j) { j.settings.lightPathCount = 9; });
    expectNew("connections", [](auto& j) { j.settings.connectionsPerVertex = 2; });
    expectNew("curving", [](auto& j) { j.settings.curvedTriangles = false; });
    expectNew("sampler", [](auto& j) { j.settings.sampler = Sampler::Independent; });
    expectNew("precision", [](auto& j) { j.settings.precision = Precision::Double; });
}

TEST(JobDefinition, LeavesOutNothingThatAloneRendersLight) {
    Scene scene = test::tinyScene();
    scene.pointLights.push_back({{0, 9, 0}, Vec3f(1.0f)});
    RenderSettings settings;
    settings.without.add(Transport::Merging);
    EXPECT_TRUE(resolveJob(scene, settings).missing.empty()) << "nothing specular: merging takes time alone";
    Material mirror;
    mirror.kind = MaterialKind::Mirror;
    scene.materials.push_back(mirror);
    scene.spheres.push_back({{0, 5, 0}, 1, uint32_t(scene.materials.size() - 1)});
    EXPECT_TRUE(resolveJob(scene, {}).missing.empty());
    test::expectError(ErrorCode::Usage, "seen in mirrors or through glass (LS+DS+E)",
                      [&] { resolveJob(scene, settings); });
    EXPECT_EQ(resolveJob(scene, settings, {}, {.allowMissing = true}).missing.size(), 1u);
    // What a technique lacks anyway is told, not refused.
    settings.without = {};
    settings.technique = "bpt";
    EXPECT_EQ(resolveJob(scene, settings).missing.size(), 1u);
    settings.without.add(Transport::NextEvent);
    test::expectError(ErrorCode::Usage, "renders no direct light of points, spots and suns, seen in mirrors",
                      [&] { resolveJob(scene, settings); });
}

TEST(JobDefinition, ItsHashFollowsWhatIsLeftOut) {
    const Scene scene = test::tinyScene();
    RenderSettings settings;
    settings.without.add(Transport::Connections);
    EXPECT_NE(resolveJob(scene, settings, {}, {.allowMissing = true}).hash(), resolveJob(scene, {}).hash());
}

TEST(JobDefinition, HoldsTheTechniqueThatWasChosen) {
    const Scene scene = test::tinyScene();
    RenderSettings settings;
    settings.technique = automaticTechnique;
    const JobDefinition chosen = resolveJob(scene, settings, {4, 4});
    ASSERT_TRUE(chosen.choice);
    EXPECT_EQ(chosen.settings.technique, "bpt");
    settings.technique = "bpt";
    const JobDefinition named = resolveJob(scene, settings, {4, 4});
    EXPECT_FALSE(named.choice);
    EXPECT_EQ(named.hash(), chosen.hash()) << "the same image";
}
