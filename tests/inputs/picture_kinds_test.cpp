// Sound pictures of every kind give the values that are in them, or a sentence about what is not supported.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "renderengine/error.h"
#include "renderengine/film.h"
#include "scene/environment_map.h"
#include "scene/image_decode.h"
#include "scene/radiance_hdr.h"
#include "tests/inputs/pictures.h"
#include "tests/scene/full_scene.h"
#include "tests/scene/model_files.h"

namespace antipode::test {
namespace {

/// Compares with greyAt(); alpha is 255 − grey where there is one.
void expectGrey(const Texture& texture, bool alpha, int tolerance) {
    ASSERT_EQ(texture.width, kPictureWidth);
    ASSERT_EQ(texture.height, kPictureHeight);
    for (uint32_t y = 0; y < kPictureHeight; ++y) {
        for (uint32_t x = 0; x < kPictureWidth; ++x) {
            const uint8_t* texel = &texture.rgba[(y * kPictureWidth + x) * 4];
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(texel[c], greyAt(x, y), tolerance) << x << ", " << y;
            ASSERT_EQ(texel[3], alpha ? 255 - greyAt(x, y) : 255) << x << ", " << y;
        }
    }
}

TEST(PictureKinds, Png) {
    for (const PngKind& kind : pngKinds()) {
        SCOPED_TRACE(kind.name);
        const bool alpha = std::string(kind.name).find("lpha") != std::string::npos || kind.name[3] == 'a';
        expectGrey(decodeImage(makePng(kind), kind.name), alpha, 0);
    }
}

/// Values are taken as they are stored, whatever the file says about its colour space.
TEST(PictureKinds, PngWithGamma) {
    for (double gamma : {1.0, 0.45455, 0.1}) expectGrey(decodeImage(makePng(pngKinds()[6], gamma), "gamma"), false, 0);
}

TEST(PictureKinds, Jpeg) {
    for (const JpegKind& kind : jpegKinds()) {
        SCOPED_TRACE(kind.name);
        if (!kind.cmyk) {
            expectGrey(decodeImage(makeJpeg(kind), kind.name), false, 6);
            continue;
        }
        const std::string sentence = testing::inputErrorOf([&] { decodeImage(makeJpeg(kind), "ink.jpg"); });
        EXPECT_NE(sentence.find("ink.jpg"), std::string::npos);
        EXPECT_NE(sentence.find("CMYK"), std::string::npos) << sentence;
    }
}

TEST(PictureKinds, RadianceHdr) {
    for (const char* coding : {"components", "pixels", "plain"}) {
        const Image image = decodeRadianceHdr(makeHdr(coding), coding);
        ASSERT_EQ(image.width, kPictureWidth);
        for (uint32_t y = 0; y < kPictureHeight; ++y)
            for (uint32_t x = 0; x < kPictureWidth; ++x)
                ASSERT_EQ(image.pixels[y * kPictureWidth + x].y,
                          float(greyAt(std::string(coding) == "pixels" ? 0 : x, y)) / 256)
                    << coding << x << ", " << y;
    }
}

class PictureKindFiles : public testing::ModelFiles {};

TEST_F(PictureKindFiles, OpenExr) {
    for (const std::string& kind : exrKinds()) {
        const Environment map = readEnvironmentMap(write(kind + ".exr", makeExr(kind)));
        ASSERT_EQ(map.width, kPictureWidth) << kind;
        const float tolerance = kind == "b44" || kind == "dwaa" ? 6 : 0;
        for (uint32_t y = 0; y < kPictureHeight; ++y)
            for (uint32_t x = 0; x < kPictureWidth; ++x)
                ASSERT_NEAR(map.map[y * kPictureWidth + x].z, greyAt(x, y), tolerance) << kind << x << ", " << y;
    }
}

TEST_F(PictureKindFiles, OpenExrWithValuesThatAreNoRadiance) {
    for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1.0f}) {
        Image image{4, 2, std::vector<Vec3f>(8, Vec3f(1.0f))};
        image.pixels[5].y = bad;
        writeExr((directory_ / "sky.exr").string(), image, {});
        const std::string error = testing::inputErrorOf([&] {
            Scene scene = testing::smallScene();
            scene.environment = readEnvironmentMap((directory_ / "sky.exr").string());
            validate(scene);
        });
        EXPECT_NE(error.find(std::isfinite(bad) ? "environment: map" : "the texel at column 1, row 1 is not finite"),
                  std::string::npos)
            << error;
    }
}

}  // namespace
}  // namespace antipode::test
