// Renders against images that other renderers made, found through the environment variable ANTIPODE_SHARED (the folder
// that holds scenes/ and reference/).
//
// Statistics. The references are fixed, with noise and small errors of their own (reference/README.md,
// scenes/README.md), so that no hypothesis test applies; tolerances are stated instead. The mean of an image of 256²
// pixels after 64 iterations has a relative standard error of about 5e-4 (each sample's σ/μ is below 1, fireflies
// apart), that of the references is of the same size, and cornell-area is about 1e-3 dark by its renderer's fault:
// means must agree to 3e-3 per channel. relMSE (ε = .01) contains the reference's own noise, which is taken off; the
// bound on the rest is 1.5 times what was measured when the test was written. Seed 1 throughout.
#include <cstdlib>

#include "proto/scene_loader.h"
#include "tests/techniques/engine_fixture.h"

namespace antipode::test {
namespace {

constexpr double kMeanTolerance = 3e-3;
constexpr uint32_t kSize = 256;

class EngineSharedReference : public EngineTest {
protected:
    void SetUp() override {
        const char* folder = std::getenv("ANTIPODE_SHARED");
        if (!folder) GTEST_SKIP() << "ANTIPODE_SHARED does not name the folder that holds scenes/ and reference/.";
        shared_ = folder;
    }

    std::string shared(const std::string& path) const { return shared_ + "/" + path; }

    Image render(const Scene& scene, std::optional<uint32_t> maxPathLength, uint64_t iterations) {
        RenderSettings settings;
        settings.width = settings.height = kSize;
        settings.maxPathLength = maxPathLength;
        Engine engine(scene, settings);
        for (uint64_t i = 1; i <= iterations; ++i) engine.render(i);
        expectHealthy(engine);
        return engine.sums().image();
    }

    static void expectSameMean(const ImageComparison& c) {
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(c.ratio[channel], 1, kMeanTolerance)
                << "channel " << channel << ": " << c.meanA[channel] << " instead of " << c.meanB[channel];
    }

    /// @param noise  relMSE of the reference itself
    void expectReference(const std::string& scene, const std::string& reference, double noise, double relMse) {
        const Image image = render(loadScene(ANTIPODE_SOURCE_DIR "/scenes/cornell/" + scene), 10, 64);
        const ImageComparison c = compareImages(image, readExr(shared("reference/" + reference)));
        expectSameMean(c);
        EXPECT_LT(c.relMse - noise, relMse);
    }

private:
    std::string shared_;
};

/// Means of squares of `factor` × `factor` pixels.
Image boxDownsampled(const Image& image, uint32_t factor) {
    Image small{image.width / factor, image.height / factor, {}};
    for (uint32_t y = 0; y < small.height; ++y)
        for (uint32_t x = 0; x < small.width; ++x) {
            Vec3d sum;
            for (uint32_t i = 0; i < factor * factor; ++i)
                sum += Vec3d(image.pixels[size_t(y * factor + i / factor) * image.width + x * factor + i % factor]);
            small.pixels.push_back(Vec3f(sum / double(factor * factor)));
        }
    return small;
}

TEST_F(EngineSharedReference, CornellArea) { expectReference("area.textproto", "cornell-area.exr", 0.00034, 0.0055); }

TEST_F(EngineSharedReference, CornellSky) { expectReference("sky.textproto", "cornell-sky.exr", 0.00071, 0.0155); }

/// The reference, 1024² and 16 bits a channel, is brought down to our size; its mean is that of an independent path
/// tracer to 7e-4. The same room in the other format has no camera of its own, and must then give the same image.
TEST_F(EngineSharedReference, CornellBoxInBothFormats) {
    const Scene glb = loadScene(shared("scenes/cornell-box/cornell-box.glb"));
    const Image fromGlb = render(glb, {}, 32);
    const Image reference = readExr(shared("scenes/cornell-box/reference.exr"));
    ASSERT_EQ(reference.width % kSize, 0u);
    const ImageComparison toReference = compareImages(fromGlb, boxDownsampled(reference, reference.width / kSize));
    expectSameMean(toReference);
    EXPECT_LT(toReference.relMse, 0.0067);

    Scene obj = loadScene(shared("scenes/cornell-box/cornell-box.obj"));
    obj.camera = glb.camera;
    expectSameMean(compareImages(render(obj, {}, 32), fromGlb));
}

}  // namespace
}  // namespace antipode::test
