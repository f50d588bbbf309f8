#include "tests/large_scene/cave_furnace.h"

#include <cmath>
#include <fstream>

#include <nlohmann/json.hpp>

#include "support/worst.h"
#include "tests/client/run_client.h"

namespace antipode::test {

void CaveFurnace::SetUp() {
    ASSERT_EQ(runClient(folder_.file("."), "devices").exitCode, 0) << "no usable device";
    writePly(folder_.file("cave.ply"), caveMesh(cells_, 0.3));
    std::ofstream(folder_.file("furnace.textproto"))
        << "camera { position: [0, 0, 0] forward: [0, 0, -1] vertical_fov: 70 }\n"
           "material { name: 'glow' base_color: [0.5, 0.5, 0.5] emission: [1, 2, 3] one_sided: true }\n"
           "model { file: 'cave.ply' override { replace: '*' material: 'glow' } }\n";
}

void CaveFurnace::render(const std::string& options) {
    const auto run = runClient(folder_.file("."),
                               "render furnace.textproto --width 64 --height 64 --max-path-length 4 --iterations 1 "
                               "--quiet --stats stats.json " +
                                   options);
    ASSERT_EQ(run.exitCode, 0) << run.errors;
    std::ifstream file(folder_.file("stats.json"));
    const auto stats = nlohmann::json::parse(file);
    EXPECT_EQ(stats["bvh_primitives"], 12ull * cells_ * cells_);
    EXPECT_EQ(stats["events"], nlohmann::json::array());
    device = stats["device"];
    image = readExr(folder_.file("furnace.exr"));
}

double CaveFurnace::largestRelativeError() const {
    Worst error;
    for (const Vec3f& pixel : image.pixels)
        for (int channel = 0; channel < 3; ++channel)
            error.add(std::abs(pixel[channel] / ((channel + 1) * expected) - 1));
    return error.value;
}

}  // namespace antipode::test
