#include <png.h>
#include <turbojpeg.h>

#include <cmath>

#include "film/tone_curve.h"
#include "renderengine/film.h"
#include "renderengine/pictures.h"
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

/// As they stand in the file: libpng's simplified interface takes 16 bits for a power of 2.2, whatever the file says.
std::vector<uint16_t> storedValues(const std::string& bytes) {
    struct Input {
        const std::string& bytes;
        size_t at;
    } input{bytes, 0};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_read_fn(png, &input, [](png_structp reader, png_bytep data, size_t size) {
        Input& from = *static_cast<Input*>(png_get_io_ptr(reader));
        from.at += from.bytes.copy(reinterpret_cast<char*>(data), size, from.at);
    });
    png_read_png(png, info, PNG_TRANSFORM_SWAP_ENDIAN, nullptr);
    std::vector<uint16_t> values;
    for (png_uint_32 y = 0; y < png_get_image_height(png, info); ++y) {
        const auto* row = reinterpret_cast<const uint16_t*>(png_get_rows(png, info)[y]);
        values.insert(values.end(), row, row + 3 * png_get_image_width(png, info));
    }
    png_destroy_read_struct(&png, &info, nullptr);
    return values;
}

TEST(Png, SixteenBitsAreSrgbToo) {
    const Image image{3, 2, {{0, 0, 0}, {0.18f, 0.5f, 0}, {2, 1, 0}, {1e6f, 1e6f, 1e6f}, {-1, 0.1f, 0}, {0.01f, 9, 3}}};
    const std::string bytes = encodePng16(image);
    EXPECT_EQ(bytes.at(24), 16) << "bits a channel (IHDR)";
    EXPECT_NE(bytes.find("sRGB"), std::string::npos);
    const std::vector<uint16_t> rgb = storedValues(bytes);
    ASSERT_EQ(rgb.size(), 18u);
    for (size_t i = 0; i < image.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double stored = rgb[3 * i + size_t(c)] / 65535.0;
            const double linear = stored <= 0.04045 ? stored / 12.92 : std::pow((stored + 0.055) / 1.055, 2.4);
            EXPECT_NEAR(linear, toneCurve(image.pixels[i])[c], 2e-5) << i << "," << c;
        }
}

TEST(Jpeg, HoldsTheDisplayedPixels) {
    Image image{24, 16, {}};
    for (uint32_t i = 0; i < 24 * 16; ++i) image.pixels.push_back({float(i % 24) / 24, float(i / 24) / 16, 0.5f});
    const std::string bytes = encodeJpeg(image, 95);
    const tjhandle decoder = tjInitDecompress();
    std::vector<uint8_t> rgb(24 * 16 * 3);
    EXPECT_EQ(tjDecompress2(decoder, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), rgb.data(), 24,
                            0, 16, TJPF_RGB, 0),
              0);
    tjDestroy(decoder);
    double squares = 0;
    for (size_t i = 0; i < image.pixels.size(); ++i)
        for (size_t c = 0; c < 3; ++c) squares += std::pow(rgb[3 * i + c] - displayPixel(image.pixels[i])[c], 2);
    EXPECT_LT(std::sqrt(squares / double(rgb.size())), 4) << "levels, root mean square";
    expectError(ErrorCode::Output, "too large for a JPEG", [] {
        encodeJpeg({70000, 1, std::vector<Vec3f>(70000)}, 90);
    });
}
