#include "proto/wire/scene_package.h"

#include <filesystem>
#include <map>

#include "proto/scene_loader.h"
#include "proto/scene_translation.h"
#include "proto/wire/job_messages.h"
#include "renderengine/io/text.h"
#include "tests/film/expect_error.h"
#include "tests/scene/full_scene.h"

namespace antipode::wire {
namespace {

using test::expectError;
using testing::richScene;
using Found = std::shared_ptr<const std::string>;

farm::SceneRoot rootOf(const ScenePackage& package) { return parseSceneRoot(*package.blobs.front().bytes); }

/// Finds the package's blobs, as a server's cache does.
auto finder(const ScenePackage& package) {
    std::map<std::string, Found> blobs;
    for (const Blob& blob : package.blobs) blobs[blob.reference.sha256()] = blob.bytes;
    return [blobs](const farm::BlobRef& blob) { return blobs.at(blob.sha256()); };
}

Scene throughPackage(const Scene& scene) {
    const ScenePackage package = packageScene(scene);
    return assembleScene(rootOf(package), finder(package));
}

void expectEqual(const Scene& a, const Scene& b) {
    EXPECT_EQ(sceneHash(a), sceneHash(b));
    // The message holds every field (tests/scene/scene_translation_test.cpp).
    EXPECT_EQ(toProto(a).SerializeAsString(), toProto(b).SerializeAsString());
}

TEST(Sha256, OfKnownText) {
    EXPECT_EQ(hexadecimal(sha256Of("abc")), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(ScenePackage, EveryFieldSurvives) {
    const Scene scene = richScene(), back = throughPackage(scene);
    expectEqual(back, scene);
    ASSERT_EQ(back.meshes.size(), scene.meshes.size());
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        EXPECT_EQ(back.meshes[i].positions, scene.meshes[i].positions);
        EXPECT_EQ(back.meshes[i].normals, scene.meshes[i].normals);
        EXPECT_EQ(back.meshes[i].uvs, scene.meshes[i].uvs);
        EXPECT_EQ(back.meshes[i].moreUvs, scene.meshes[i].moreUvs);
        EXPECT_EQ(back.meshes[i].colors, scene.meshes[i].colors);
        EXPECT_EQ(back.meshes[i].tangents, scene.meshes[i].tangents);
        EXPECT_EQ(back.meshes[i].triangles, scene.meshes[i].triangles);
    }
    EXPECT_EQ(back.textures[1].rgba, scene.textures[1].rgba);
    EXPECT_EQ(back.environment->map, scene.environment->map);
}

TEST(ScenePackage, EveryShippedSceneSurvives) {
    size_t count = 0;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(ANTIPODE_SOURCE_DIR) / "scenes")) {
        if (entry.path().extension() != ".textproto") continue;
        SCOPED_TRACE(entry.path().string());
        const Scene scene = loadScene(entry.path().string());
        expectEqual(throughPackage(scene), scene);
        EXPECT_EQ(packageScene(scene).sceneHash, sceneHash(scene));
        ++count;
    }
    EXPECT_EQ(count, 14u);
}

TEST(ScenePackage, ConstantEnvironmentsHaveNoBlob) {
    Scene scene = richScene();
    scene.environment.emplace().radiance = {1, 2, 3};
    expectEqual(throughPackage(scene), scene);
    EXPECT_FALSE(rootOf(packageScene(scene)).has_environment());
}

TEST(ScenePackage, BlobsAreWhatTheyAreCalled) {
    const ScenePackage package = packageScene(richScene());
    EXPECT_EQ(package.root().sha256(), package.blobs[0].reference.sha256());
    for (const Blob& blob : package.blobs) {
        EXPECT_EQ(blob.reference.sha256(), sha256Of(*blob.bytes));
        EXPECT_EQ(blob.reference.size(), blob.bytes->size());
    }
    const auto named = blobsOf(rootOf(package));
    ASSERT_EQ(named.size() + 1, package.blobs.size());
    for (size_t i = 0; i < named.size(); ++i)
        EXPECT_EQ(named[i].sha256(), package.blobs[i + 1].reference.sha256()) << "in the root's order";
}

TEST(ScenePackage, EqualBlobsAreOneButCountAsOftenAsTheyAreNamed) {
    Scene scene = richScene();
    const ScenePackage before = packageScene(scene);
    scene.textures.push_back(scene.textures[0]);
    const ScenePackage after = packageScene(scene);
    EXPECT_EQ(after.blobs.size(), before.blobs.size());
    expectEqual(throughPackage(scene), scene);
    const uint64_t skeleton = rootOf(after).skeleton().ByteSizeLong() - rootOf(before).skeleton().ByteSizeLong();
    EXPECT_EQ(sceneBytes(rootOf(after)), sceneBytes(rootOf(before)) + skeleton + scene.textures[0].rgba.size());
}

TEST(ScenePackage, TenThousandSmallMeshesAreFewBlobs) {
    Scene scene = richScene();
    for (int i = 0; i < 10000; ++i) {
        scene.meshes.push_back(scene.meshes[1]);
        scene.meshes.back().name = "part " + std::to_string(i);
        scene.meshes.back().positions[0].x = float(i);
    }
    const ScenePackage package = packageScene(scene);
    EXPECT_LE(package.blobs.size(), 7u) << "the root, three of a MiB at most, two textures, a map";
    EXPECT_LE(package.blobs[0].bytes->size(), 500'000u);
    expectEqual(throughPackage(scene), scene);
}

TEST(ScenePackage, LargeMeshesHaveTheirOwnBlobs) {
    Scene scene = richScene();
    Mesh large = scene.meshes[1];
    large.moreUvs.clear(), large.colors.clear(), large.tangents.clear();
    large.positions.resize(40000), large.normals.resize(40000, large.normals[0]), large.uvs.resize(40000);
    scene.meshes.insert(scene.meshes.begin() + 1, large);
    const farm::SceneRoot root = rootOf(packageScene(scene));
    ASSERT_EQ(root.mesh_size(), 3);
    EXPECT_EQ(root.mesh(0).mesh_size(), 1);
    EXPECT_EQ(root.mesh(1).mesh_size(), 1);
    EXPECT_EQ(root.mesh(2).mesh_size(), 3);
    expectEqual(throughPackage(scene), scene);
}

TEST(ScenePackage, NamesBecomeUtf8) {
    Scene scene = richScene();
    scene.meshes[0].name = "M\xFCll";
    scene.materials[0].name = scene.textures[0].name = scene.name = scene.notices[0] = "\xC3";
    const Scene back = throughPackage(scene);
    EXPECT_EQ(back.meshes[0].name, "M\xC3\xBCll") << "taken for Latin-1";
    EXPECT_EQ(back.materials[0].name, "\xC3\x83");
    EXPECT_EQ(sceneHash(back), sceneHash(scene));
}

TEST(ScenePackage, InvalidScenesAreNotPackaged) {
    Scene scene = richScene();
    scene.meshes[0].triangles = {{0, 1, 3}};
    EXPECT_THROW(packageScene(scene), Error);
}

TEST(ScenePackage, TooManyPartsAreNotPackaged) {
    Scene scene = richScene();
    scene.pointLights.resize(maxSceneRootParts + 1, scene.pointLights[0]);
    expectError(ErrorCode::Input, "too many meshes", [&] { packageScene(scene); });
}

TEST(AssembleScene, MissingOrShortBlobsAreRefused) {
    const ScenePackage package = packageScene(richScene());
    const farm::SceneRoot root = rootOf(package);
    const auto find = finder(package);
    for (const farm::BlobRef& absent : blobsOf(root)) {
        const auto without = [&](Found instead) {
            return [&, instead](const farm::BlobRef& blob) {
                return blob.sha256() == absent.sha256() ? instead : find(blob);
            };
        };
        const std::string words = "blob " + hexadecimal(absent.sha256());
        expectError(ErrorCode::Input, words, [&] { assembleScene(root, without(nullptr)); });
        const auto bytes = find(absent);
        expectError(ErrorCode::Input, words,
                    [&] { assembleScene(root, without(std::make_shared<const std::string>(bytes->substr(1)))); });
    }
}

TEST(AssembleScene, InvalidContentsAreRefused) {
    const ScenePackage package = packageScene(richScene());
    const farm::SceneRoot root = rootOf(package);
    const auto find = finder(package);
    // Ones everywhere: indices out of range, coordinates that are no numbers.
    expectError(ErrorCode::Input, "mesh", [&] {
        assembleScene(root, [&](const farm::BlobRef& blob) {
            return blob.sha256() == root.mesh(0).blob().sha256()
                       ? std::make_shared<const std::string>(blob.size(), '\xFF')
                       : find(blob);
        });
    });
}

farm::JobSettings settings(const std::string& technique) {
    RenderSettings s;
    s.width = 100, s.height = 50, s.technique = technique, s.initialRadius = 1;
    return toMessage(s);
}

TEST(JobSizeOfRoot, CountsEverything) {
    const farm::SceneRoot root = rootOf(packageScene(richScene()));
    const JobSize size = jobSize(root, settings("vcm"));
    EXPECT_EQ(size.triangles, 7u);
    EXPECT_EQ(size.spheres, 1u);
    EXPECT_EQ(size.texels, 6u);
    EXPECT_EQ(size.pixels, 5000u);
    EXPECT_EQ(size.lightPaths, 5000u);
}

TEST(JobSizeOfRoot, LightPathsDependOnTheTechnique) {
    const farm::SceneRoot root = rootOf(packageScene(richScene()));
    for (const char* technique : {"vcm", "bpt", "lt", "ppm", "bpm"})
        EXPECT_EQ(jobSize(root, settings(technique)).lightPaths, 5000u) << technique;
    for (const char* technique : {"pt", "pt-naive"})
        EXPECT_EQ(jobSize(root, settings(technique)).lightPaths, 0u) << technique;
    farm::JobSettings given = settings("vcm");
    given.set_light_path_count(77);
    EXPECT_EQ(jobSize(root, given).lightPaths, 77u);
}

TEST(JobSizeOfRoot, HasTheJobsPrecision) {
    const farm::SceneRoot root = rootOf(packageScene(richScene()));
    EXPECT_EQ(jobSize(root, settings("vcm")).precision, Precision::Float);
    farm::JobSettings twice = settings("vcm");
    twice.set_precision(farm::JobSettings::DOUBLE);
    EXPECT_EQ(jobSize(root, twice).precision, Precision::Double);
}

TEST(JobSizeOfRoot, RefusesInvalidSettings) {
    const farm::SceneRoot root = rootOf(packageScene(richScene()));
    farm::JobSettings invalid = settings("vcm");
    invalid.set_width(0);
    expectError(ErrorCode::Usage, "width", [&] { jobSize(root, invalid); });
}

}  // namespace
}  // namespace antipode::wire
