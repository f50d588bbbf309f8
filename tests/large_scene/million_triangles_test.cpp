// The client on a closed cave of a million triangles, every one of them a light.
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "renderengine/film.h"
#include "tests/client/run_client.h"
#include "tests/film/temporary_folder.h"
#include "tests/large_scene/cave.h"

using namespace antipode;
using test::runClient;

TEST(MillionTriangles, AClosedFurnaceShowsItsClosedForm) {
    const test::TemporaryFolder folder;
    if (runClient(folder.file("."), "devices").exitCode != 0) GTEST_SKIP() << "This machine has no usable device.";
    test::writePly(folder.file("cave.ply"), test::caveMesh(test::millionTriangleCells, 0.3));
    std::ofstream(folder.file("furnace.textproto"))
        << "camera { position: [0, 0, 0] forward: [0, 0, -1] vertical_fov: 70 }\n"
           "material { name: 'glow' base_color: [0.5, 0.5, 0.5] emission: [1, 2, 3] one_sided: true }\n"
           "model { file: 'cave.ply' override { replace: '*' material: 'glow' } }\n";

    const auto run = runClient(folder.file("."),
                               "render furnace.textproto --width 64 --height 64 --technique pt --max-path-length 4 "
                               "--iterations 1 --quiet --stats stats.json");
    ASSERT_EQ(run.exitCode, 0) << run.errors;

    std::ifstream file(folder.file("stats.json"));
    const auto stats = nlohmann::json::parse(file);
    EXPECT_EQ(stats["bvh_primitives"], 12ull * test::millionTriangleCells * test::millionTriangleCells);
    EXPECT_EQ(stats["counters"],
              (nlohmann::json{{"non_finite", 0}, {"negative", 0}, {"saturated", 0}, {"loop_limit", 0}}));

    // Le(1 - ρ⁴)/(1 - ρ) = 1.875 Le whatever the walls' shape. H₀: that is the image's mean; a t-test over the 4096
    // pixels at α = .001, seed 1. A hole of one pixel in 150 would fail it.
    const Image image = readExr(folder.file("furnace.exr"));
    double sum = 0, squares = 0;
    for (const Vec3f& pixel : image.pixels) {
        // All channels of a path see the same random numbers.
        EXPECT_NEAR(pixel.y, 2 * pixel.x, 1e-5 * pixel.y);
        EXPECT_NEAR(pixel.z, 3 * pixel.x, 1e-5 * pixel.z);
        sum += pixel.x;
        squares += double(pixel.x) * pixel.x;
    }
    const double count = double(image.pixels.size()), mean = sum / count;
    const double error = std::sqrt((squares / count - mean * mean) / (count - 1));
    EXPECT_LT(std::abs(mean - 1.875), 3.29 * error) << "mean " << mean << " ± " << error;
    EXPECT_LT(error, 0.01 * mean) << "too noisy to tell anything";
}
