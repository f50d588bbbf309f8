// The client on a closed cave of a million triangles, every one of them a light: a furnace, whose radiance after n
// edges is Le(1 - ρⁿ)/(1 - ρ) whatever the walls' shape.
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "renderengine/film.h"
#include "support/hard_case.h"
#include "support/worst.h"
#include "tests/client/run_client.h"
#include "tests/film/temporary_folder.h"
#include "tests/large_scene/cave.h"

using namespace antipode;
using test::runClient;

namespace {

constexpr double expected = 1.875;  // ρ = 1/2, n = 4, Le = 1 in the red channel

class MillionTriangles : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_EQ(runClient(folder.file("."), "devices").exitCode, 0) << "no usable device";
        test::writePly(folder.file("cave.ply"), test::caveMesh(test::millionTriangleCells, 0.3));
        std::ofstream(folder.file("furnace.textproto"))
            << "camera { position: [0, 0, 0] forward: [0, 0, -1] vertical_fov: 70 }\n"
               "material { name: 'glow' base_color: [0.5, 0.5, 0.5] emission: [1, 2, 3] one_sided: true }\n"
               "model { file: 'cave.ply' override { replace: '*' material: 'glow' } }\n";
    }

    /// One iteration of 64², paths of at most four edges.
    void render(const std::string& options) {
        const auto run = runClient(folder.file("."),
                                   "render furnace.textproto --width 64 --height 64 --max-path-length 4 --iterations 1 "
                                   "--quiet --stats stats.json " +
                                       options);
        ASSERT_EQ(run.exitCode, 0) << run.errors;
        std::ifstream file(folder.file("stats.json"));
        const auto stats = nlohmann::json::parse(file);
        EXPECT_EQ(stats["bvh_primitives"], 12ull * test::millionTriangleCells * test::millionTriangleCells);
        EXPECT_EQ(stats["events"], nlohmann::json::array());
        device = stats["device"];
        image = readExr(folder.file("furnace.exr"));
    }

    test::TemporaryFolder folder;
    std::string device;
    Image image;
};

}  // namespace

/// Cosine-distributed bounces have no variance in a furnace: a single ray that slips through the walls shows.
TEST_F(MillionTriangles, EveryPathOfAClosedFurnaceIsExact) {
    ASSERT_NO_FATAL_FAILURE(render("--technique pt-naive --no-russian-roulette"));
    Worst error;
    for (const Vec3f& pixel : image.pixels)
        for (int channel = 0; channel < 3; ++channel)
            error.add(std::abs(pixel[channel] / ((channel + 1) * expected) - 1));
    antipode::expectWithin({"Intersection", "a closed cave of a million triangles: a ray that slips through would show",
                            "largest relative error of a pixel", 1e-5},
                           error.value, device);
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
    antipode::expectWithin({"Lights", "a million triangles, each of them a light", "|z| of the image's mean", 3.29},
                           std::abs(mean - expected) / error, device);
    EXPECT_LT(error, 0.01 * expected) << "too noisy to tell anything";
}
