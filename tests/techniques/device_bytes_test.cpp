// The estimate of device memory against what engines take, and the kernels' hash.
#include <limits>

#include <gtest/gtest.h>

#include "proto/scene_loader.h"
#include "renderengine/engine.h"

namespace antipode::test {
namespace {

/// An estimate may be this many times the truth: it allows for the batches of a GPU, whichever device the test has, and
/// for rooms brighter than these.
constexpr double kGreatestExcess = 5;

JobSize sizeOf(const Scene& scene, const RenderSettings& settings) {
    JobSize size;
    for (const Mesh& mesh : scene.meshes) size.triangles += mesh.triangles.size();
    size.spheres = scene.spheres.size();
    for (const Texture& texture : scene.textures) size.texels += uint64_t(texture.width) * texture.height;
    if (scene.environment) size.texels += scene.environment->map.size();
    size.pixels = size.lightPaths = uint64_t(settings.width) * settings.height;
    return size;
}

TEST(DeviceBytes, EstimateIsGenerousButNotAbsurd) {
    for (const char* name : {"glass_caustics.textproto", "cornell/area.textproto"}) {
        const Scene scene = loadScene(std::string(ANTIPODE_SOURCE_DIR "/scenes/") + name);
        for (const auto& [width, height] : {std::pair(256u, 192u), std::pair(640u, 480u)}) {
            SCOPED_TRACE(std::string(name) + " at width " + std::to_string(width));
            RenderSettings settings;
            settings.technique = "vcm";
            settings.width = width;
            settings.height = height;
            Engine engine(scene, settings);
            engine.render(1);
            const double taken = double(engine.statistics().deviceBytes);
            const double estimate = double(estimateDeviceBytes(sizeOf(scene, settings)));
            EXPECT_GE(estimate, taken);
            EXPECT_LE(estimate, kGreatestExcess * taken);
        }
    }
}

TEST(DeviceBytes, EstimateGrowsWithEverythingAndNeverWraps) {
    const JobSize base{1000, 10, 100, 1u << 18, 1u << 18};
    const uint64_t bytes = estimateDeviceBytes(base);
    for (uint64_t JobSize::*field :
         {&JobSize::triangles, &JobSize::spheres, &JobSize::texels, &JobSize::pixels, &JobSize::lightPaths}) {
        JobSize larger = base;
        larger.*field += 1u << 20;
        EXPECT_GT(estimateDeviceBytes(larger), bytes);
        larger.*field = std::numeric_limits<uint64_t>::max();
        EXPECT_EQ(estimateDeviceBytes(larger), std::numeric_limits<uint64_t>::max());
    }
    JobSize withoutLight = base;
    withoutLight.lightPaths = 0;
    EXPECT_LT(estimateDeviceBytes(withoutLight), bytes);
}

TEST(DeviceBytes, VerticesAreBoundedByWhatTheDeviceBinds) {
    // 4K with one path a pixel on lavapipe: 128 MiB a binding, 2 GiB in all.
    const uint64_t pixels = 3840ull * 2160;
    const JobSize size{100, 10, 0, pixels, pixels};
    EXPECT_GT(estimateDeviceBytes(size), 2ull << 30);
    EXPECT_LT(estimateDeviceBytes(size, 128u << 20), 2ull << 30);
    EXPECT_EQ(estimateDeviceBytes(size, 128ull << 30), estimateDeviceBytes(size));
}

TEST(KernelHash, IsOneSha256) {
    const std::string hash = kernelHash();
    EXPECT_EQ(hash.size(), 64u);
    EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos);
    EXPECT_EQ(kernelHash(), hash);
}

}  // namespace
}  // namespace antipode::test
