#include "scene/image_decode.h"

#include <turbojpeg.h>

#include <limits>

#include "renderengine/film.h"
#include "scene/environment_map.h"
#include "scene/radiance_hdr.h"
#include "tests/scene/model_files.h"

namespace antipode {
namespace {

using testing::inputErrorOf;
using testing::makePng;

TEST(ImageDecode, PngKeepsBytesAndAlpha) {
    const Texture t = decodeImage(makePng(), "two.png");
    EXPECT_EQ(t.width, 2u);
    EXPECT_EQ(t.height, 1u);
    EXPECT_EQ(t.rgba, (std::vector<uint8_t>{255, 0, 0, 255, 0, 128, 0, 64}));
}

TEST(ImageDecode, PngCutShortIsAnErrorAtEveryLength) {
    const std::vector<uint8_t> png = makePng();
    // The last twelve bytes are the empty end chunk, which carries no pixels.
    for (size_t size = 0; size + 12 < png.size(); ++size)
        EXPECT_THROW(decodeImage(std::span(png).first(size), "cut"), Error) << size << " of " << png.size();
}

std::vector<uint8_t> makeJpeg() {
    std::vector<uint8_t> rgb(64 * 64 * 3);
    for (size_t i = 0; i < rgb.size(); ++i) rgb[i] = i % 3 == 0 ? 200 : uint8_t(i / 3 % 64);
    unsigned char* data = nullptr;
    unsigned long size = 0;
    const tjhandle encoder = tjInitCompress();
    tjCompress2(encoder, rgb.data(), 64, 0, 64, TJPF_RGB, &data, &size, TJSAMP_444, 95, 0);
    std::vector<uint8_t> bytes(data, data + size);
    tjFree(data);
    tjDestroy(encoder);
    return bytes;
}

TEST(ImageDecode, Jpeg) {
    const Texture t = decodeImage(makeJpeg(), "grey.jpg");
    EXPECT_EQ(t.width, 64u);
    EXPECT_NEAR(t.rgba[0], 200, 6);
    EXPECT_EQ(t.rgba[3], 255);
}

TEST(ImageDecode, JpegCutInHalfIsAnError) {
    const std::vector<uint8_t> jpeg = makeJpeg();
    inputErrorOf([&] { decodeImage(std::span(jpeg).first(jpeg.size() / 2), "half.jpg"); });
}

TEST(ImageDecode, OtherDataAreNamed) {
    const std::vector<uint8_t> text = {'h', 'i'};
    EXPECT_NE(inputErrorOf([&] { decodeImage(text, "hi.tga"); }).find("hi.tga"), std::string::npos);
}

std::vector<uint8_t> bytesOf(const std::string& header, const std::vector<int>& pixels) {
    std::vector<uint8_t> bytes(header.begin(), header.end());
    for (int value : pixels) bytes.push_back(uint8_t(value));
    return bytes;
}

const std::string kHeader = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";

TEST(RadianceHdr, FlatPixels) {
    const Image image = decodeRadianceHdr(bytesOf(kHeader + "-Y 1 +X 2\n", {128, 64, 32, 129, 9, 9, 9, 0}), "a.hdr");
    ASSERT_EQ(image.pixels.size(), 2u);
    EXPECT_EQ(image.pixels[0], Vec3f(1, 0.5f, 0.25f));
    EXPECT_EQ(image.pixels[1], Vec3f(0, 0, 0));
}

TEST(RadianceHdr, ComponentRuns) {
    // Eight pixels: red a run of 128, green eight literals, blue a run of zeros, exponent a run of 129.
    const std::vector<int> row = {2, 2, 0, 8, 128 + 8, 128, 8, 0, 16, 32, 48, 64, 80, 96, 112, 136, 0, 136, 129};
    const std::vector<uint8_t> bytes = bytesOf(kHeader + "-Y 1 +X 8\n", row);
    const Image image = decodeRadianceHdr(bytes, "runs.hdr");
    ASSERT_EQ(image.pixels.size(), 8u);
    EXPECT_EQ(image.pixels[4], Vec3f(1, 0.5f, 0));
    for (size_t size = 0; size < bytes.size(); ++size)
        EXPECT_THROW(decodeRadianceHdr(std::span(bytes).first(size), "cut"), Error) << size;
}

TEST(RadianceHdr, PixelRuns) {
    const Image image = decodeRadianceHdr(bytesOf(kHeader + "-Y 1 +X 4\n", {128, 0, 0, 129, 1, 1, 1, 3}), "old.hdr");
    ASSERT_EQ(image.pixels.size(), 4u);
    EXPECT_EQ(image.pixels[3], Vec3f(1, 0, 0));
}

TEST(RadianceHdr, RefusesRunsThatLeaveTheRowAndHugeHeaders) {
    EXPECT_THROW(decodeRadianceHdr(bytesOf(kHeader + "-Y 1 +X 2\n", {1, 0, 0, 129, 1, 1, 1, 9}), "x"), Error);
    EXPECT_THROW(decodeRadianceHdr(bytesOf(kHeader + "-Y 999999999 +X 999999999\n", {1, 0, 0, 129}), "x"), Error);
}

TEST(RadianceHdr, HeadersWithCarriageReturns) {
    const std::string header = "#?RADIANCE\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n-Y 1 +X 1\r\n";
    EXPECT_EQ(decodeRadianceHdr(bytesOf(header, {128, 64, 32, 129}), "crlf.hdr").pixels.at(0), Vec3f(1, 0.5f, 0.25f));
}

TEST(RadianceHdr, ExposuresMultiply) {
    const std::string header = "#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\nEXPOSURE= 4.0\n\n-Y 1 +X 1\n";
    EXPECT_EQ(decodeRadianceHdr(bytesOf(header, {128, 64, 32, 129}), "e.hdr").pixels.at(0),
              Vec3f(1, 0.5f, 0.25f) * 0.125f);
    inputErrorOf([&] {
        decodeRadianceHdr(bytesOf("#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\n", {128, 64, 32, 129}), "zero.hdr");
    });
}

class EnvironmentMap : public testing::ModelFiles {};

TEST_F(EnvironmentMap, ReadsOpenExr) {
    Image image{2, 1, {{1, 2, 3}, {4, 5, 6}}};
    const std::string path = (directory_ / "sky.exr").string();
    writeExr(path, image, {});
    const Environment environment = readEnvironmentMap(path);
    EXPECT_EQ(environment.width, 2u);
    EXPECT_EQ(environment.map, image.pixels);
    EXPECT_EQ(environment.radiance, Vec3f(1.0f));
}

TEST_F(EnvironmentMap, SuffixesInAnyCase) {
    EXPECT_EQ(readEnvironmentMap(write("UP.HDR", bytesOf(kHeader + "-Y 1 +X 1\n", {128, 0, 0, 129}))).width, 1u);
}

TEST_F(EnvironmentMap, NamesTheTexelThatIsNotFinite) {
    Image image{3, 2, std::vector<Vec3f>(6, Vec3f(1.0f))};
    image.pixels[4].y = std::numeric_limits<float>::infinity();
    const std::string path = (directory_ / "sun.exr").string();
    writeExr(path, image, {});
    const std::string message = inputErrorOf([&] { readEnvironmentMap(path); });
    EXPECT_NE(message.find("column 1, row 1"), std::string::npos) << message;
}

TEST_F(EnvironmentMap, RefusesOtherFiles) {
    EXPECT_NE(inputErrorOf([&] { readEnvironmentMap(write("sky.bmp", "")); }).find("sky.bmp"), std::string::npos);
    EXPECT_NE(inputErrorOf([&] { readEnvironmentMap((directory_ / "none.hdr").string()); }).find("none.hdr"),
              std::string::npos);
}

}  // namespace
}  // namespace antipode
