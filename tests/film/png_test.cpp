#include <png.h>

#include "film/tone_curve.h"
#include "renderengine/film.h"
#include "tests/film/expect_error.h"
#include "tests/film/temporary_folder.h"

using namespace antipode;
using test::expectError;
using test::TemporaryFolder;

TEST(Png, HoldsTheDisplayedPixelsRowZeroOnTop) {
    TemporaryFolder folder;
    const std::string path = folder.file("a.png");
    const Image image{3, 2, {{0, 0, 0}, {0.18f, 0.5f, 0}, {2, 1, 0}, {1e6f, 1e6f, 1e6f}, {-1, 0.1f, 0}, {0.01f, 9, 3}}};
    writePng(path, image);

    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    ASSERT_TRUE(png_image_begin_read_from_file(&png, path.c_str())) << png.message;
    EXPECT_EQ(png.format, png_uint_32(PNG_FORMAT_RGB));  // 8-bit sRGB: neither linear nor of another colour space
    EXPECT_EQ(png.flags & PNG_IMAGE_FLAG_COLORSPACE_NOT_sRGB, 0u);
    ASSERT_EQ(png.width, 3u);
    ASSERT_EQ(png.height, 2u);
    std::vector<uint8_t> rgb(PNG_IMAGE_SIZE(png));
    ASSERT_TRUE(png_image_finish_read(&png, nullptr, rgb.data(), 0, nullptr)) << png.message;
    for (size_t i = 0; i < image.pixels.size(); ++i)
        for (size_t c = 0; c < 3; ++c) EXPECT_EQ(rgb[3 * i + c], displayPixel(image.pixels[i])[c]) << i << "," << c;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.png"});
}

TEST(Png, RefusesWhatItCannotWrite) {
    TemporaryFolder folder;
    expectError(ErrorCode::Usage, "0x0", [&] { writePng(folder.file("a.png"), Image{}); });
    const Image pixel{1, 1, {Vec3f(0.5f)}};
    expectError(ErrorCode::Output, "missing/a.png", [&] { writePng(folder.file("missing/a.png"), pixel); });
}
