// lib/frame.glsl: packed directions and tangent frames, at random directions and where the maps have seams.
#include <cmath>

#include "tests/kernels/intersection_scenes.h"
#include "tests/kernels/kernel_harness.h"

namespace antipode {
namespace {

/// Poles, axes, the octahedron's edges and corners with components that vanish or nearly do, of either sign; then
/// random.
std::vector<Vec3f> testDirections(size_t random_) {
    std::vector<Vec3f> directions;
    const float values[] = {0.0f, 1e-30f, 1e-8f, 1e-7f, 1e-4f, 0.3f, 1.0f};
    for (float x : values)
        for (float y : values)
            for (float z : values)
                for (int signs = 0; signs < 8; ++signs) {
                    if (x + y + z == 0) continue;
                    const Vec3d d{signs & 1 ? -x : x, signs & 2 ? -y : y, signs & 4 ? -z : z};
                    directions.push_back(Vec3f(normalize(d)));
                }
    Random random(1);
    for (size_t i = 0; i < random_; ++i) directions.push_back(Vec3f(randomDirection(random)));
    return directions;
}

class FrameTest : public DeviceTest {
protected:
    ProbeData run(const std::vector<Vec3f>& directions) {
        ProbeData inputs;
        for (size_t i = 0; i < directions.size(); ++i) inputs.a.push_back(texel(directions[i]));
        return KernelHarness(*device).run(kernel_probes::frame_probe(), inputs);
    }
};

TEST_F(FrameTest, PackedDirectionsComeBack) {
    const auto directions = testDirections(1000000);
    const ProbeData outputs = run(directions);
    double worst = 0, worstLength = 0;
    const auto axis = [](const Vec3f& d) { return (d.x != 0) + (d.y != 0) + (d.z != 0) == 1; };
    for (size_t i = 0; i < directions.size(); ++i) {
        const Vec3d unpacked(xyz(outputs.c[i]));
        worst = std::max(worst, length(unpacked - normalize(Vec3d(directions[i]))));
        if (axis(directions[i])) {
            EXPECT_EQ(xyz(outputs.c[i]), directions[i]) << "an axis must come back exactly";
        }
        worstLength = std::max(worstLength, std::abs(length(unpacked) - 1));
    }
    // Four roundings of 6e-8, two on the way in and two on the way out, on a map that the octahedron's faces stretch by
    // √3.
    EXPECT_LE(worst, 4 * 0x1p-24 * std::sqrt(3.0));
    EXPECT_LE(worstLength, 2e-7);
}

TEST_F(FrameTest, TangentFramesAreOrthonormalAndRightHanded) {
    const auto directions = testDirections(1000000);
    const ProbeData outputs = run(directions);
    double worst = 0, worstHandedness = 0;
    for (size_t i = 0; i < directions.size(); ++i) {
        const Vec3d n = normalize(Vec3d(directions[i])), t(xyz(outputs.a[i])), b(xyz(outputs.b[i]));
        for (double error : {dot(n, t), dot(n, b), dot(t, b), length(t) - 1, length(b) - 1})
            worst = std::max(worst, std::abs(error));
        worstHandedness = std::max(worstHandedness, length(cross(t, b) - n));
    }
    EXPECT_LE(worst, 3e-7);
    EXPECT_LE(worstHandedness, 5e-7);
}

}  // namespace
}  // namespace antipode
