#include <cmath>

#include "support/hard_case.h"
#include "tests/large_scene/cave_furnace.h"

namespace antipode::test {
namespace {

class MillionTriangles : public CaveFurnace {
protected:
    MillionTriangles() : CaveFurnace(millionTriangleCells) {}
};

/// Cosine-distributed bounces have no variance in a furnace: a single ray that slips through the walls shows.
TEST_F(MillionTriangles, EveryPathOfAClosedFurnaceIsExact) {
    ASSERT_NO_FATAL_FAILURE(render("--technique pt-naive --no-russian-roulette"));
    expectWithin({"Intersection", "a closed cave of a million triangles: a ray that slips through would show",
                  "largest relative error of a pixel", 1e-5},
                 largestRelativeError(), device);
}

/// H₀: the pixels' mean is the furnace's radiance; a t-test over the 4096 pixels at α = .001, seed 1. Its error of
/// .8 % tells it from an image that is 2.5 % too dark.
TEST_F(MillionTriangles, AMillionLightsAreSampled) {
    ASSERT_NO_FATAL_FAILURE(render("--technique pt"));
    double sum = 0, squares = 0;
    for (const Vec3f& pixel : image.pixels) {
        EXPECT_GE(pixel.x, 1.0f - 1e-5f) << "the light that the camera sees directly is missing";
        sum += pixel.x;
        squares += double(pixel.x) * pixel.x;
    }
    const double count = double(image.pixels.size()), mean = sum / count;
    const double error = std::sqrt((squares / count - mean * mean) / (count - 1));
    SCOPED_TRACE(testing::Message() << "mean " << mean << " ± " << error);
    expectWithin({"Lights", "a million triangles, each of them a light", "|z| of the image's mean", 3.29},
                 std::abs(mean - expected) / error, device);
    EXPECT_LT(error, 0.01 * expected) << "too noisy to tell anything";
}

}  // namespace
}  // namespace antipode::test
