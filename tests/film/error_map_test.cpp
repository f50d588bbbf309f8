#include <cmath>
#include <limits>

#include <png.h>

#include "renderengine/pictures.h"
#include "tests/film/expect_error.h"

using namespace antipode;

namespace {

std::vector<uint8_t> decoded(const std::string& bytes, uint32_t pixels) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    EXPECT_TRUE(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()));
    png.format = PNG_FORMAT_RGB;
    EXPECT_EQ(uint64_t(png.width) * png.height, pixels);
    std::vector<uint8_t> rgb(3 * size_t(pixels));
    EXPECT_TRUE(png_image_finish_read(&png, nullptr, rgb.data(), 0, nullptr));
    return rgb;
}

}  // namespace

TEST(ErrorMap, RelativeErrorsAreWorkedOutByHand) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Image a{3, 1, {{1, 2, 3}, {0, 0, 0.5f}, {nan, 0, 0}}}, b{3, 1, {{1, 1, 1}, {0, 0, 0}, {0, 0, 0}}};
    const std::vector<float> errors = relativeErrors(a, b);
    EXPECT_FLOAT_EQ(errors[0], float(std::sqrt((1 + 4) / 1.01 / 3)));
    EXPECT_FLOAT_EQ(errors[1], float(std::sqrt(0.25 / 0.01 / 3)));
    EXPECT_TRUE(std::isnan(errors[2]));
}

TEST(ErrorMap, TheirMeanSquareIsRelMse) {
    const Image a{2, 1, {{1, 2, 3}, {0, 0, 0.5f}}}, b{2, 1, {{1, 1, 1}, {0, 0, 0}}};
    const std::vector<float> errors = relativeErrors(a, b);
    EXPECT_NEAR((errors[0] * errors[0] + errors[1] * errors[1]) / 2, compareImages(a, b).relMse, 1e-6);
}

TEST(ErrorMap, ColoursRunOverTheDecadesAndShowWhatIsBroken) {
    // From .001 to 1: both ends and beyond, a third of the way (.01: exactly the fourth of ten colours), and NaN.
    const std::vector<float> values{0, 1e-3f, 1e-2f, 1, 7, std::numeric_limits<float>::quiet_NaN()};
    const std::vector<uint8_t> rgb = decoded(encodeErrorMap(3, 2, values, 1e-3, 1), 6);
    const std::vector<uint8_t> expected{0, 0, 4, 0, 0, 4, 120, 28, 109, 252, 255, 164, 252, 255, 164, 255, 0, 255};
    EXPECT_EQ(rgb, expected);
}

TEST(ErrorMap, TakesOneValueAPixel) {
    test::expectError(ErrorCode::Usage, "one value a pixel", [] { encodeErrorMap(2, 2, {1, 2, 3}, 1e-3, 1); });
}
