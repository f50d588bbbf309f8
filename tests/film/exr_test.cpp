#include <bit>
#include <filesystem>
#include <fstream>
#include <limits>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfTiledRgbaFile.h>

#include "renderengine/film.h"
#include "tests/film/expect_error.h"
#include "tests/film/temporary_folder.h"

using namespace antipode;
using test::expectError;
using test::TemporaryFolder;

namespace {

Image gradient(uint32_t width, uint32_t height) {
    Image image{width, height, {}};
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x)
            image.pixels.push_back({float(x) / 7.0f, float(y) * 1e6f, 0.1f * float(x * height + y)});
    return image;
}

std::vector<Imf::Rgba> halfPixels(int count) {
    std::vector<Imf::Rgba> pixels;
    for (int i = 0; i < count; ++i) pixels.push_back({float(i), 0.5f, -1.0f, 1.0f});
    return pixels;
}

void expectHalfPixels(const Image& image, size_t count) {
    ASSERT_EQ(image.pixels.size(), count);
    for (size_t i = 0; i < count; ++i) EXPECT_EQ(image.pixels[i], Vec3f(float(i), 0.5f, -1.0f)) << i;
}

}  // namespace

TEST(Exr, RoundTripKeepsEveryBitAndTheMetadata) {
    TemporaryFolder folder;
    Image image = gradient(13, 37);  // more rows than one ZIP block, no multiple of it
    image.pixels[0] = {std::numeric_limits<float>::infinity(), -0.0f, std::numeric_limits<float>::denorm_min()};
    image.pixels[1].x = std::numeric_limits<float>::quiet_NaN();
    const ImageMetadata metadata{{"antipode.technique", "vcm"}, {"antipode.sceneHash", ""}};
    writeExr(folder.file("a.exr"), image, metadata);

    ImageMetadata metadataRead;
    const Image read = readExr(folder.file("a.exr"), &metadataRead);
    EXPECT_EQ(read.width, 13u);
    EXPECT_EQ(read.height, 37u);
    ASSERT_EQ(read.pixels.size(), image.pixels.size());
    for (size_t i = 0; i < image.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            ASSERT_EQ(std::bit_cast<uint32_t>(read.pixels[i][c]), std::bit_cast<uint32_t>(image.pixels[i][c])) << i;
    EXPECT_EQ(metadataRead, metadata);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.exr"});
}

TEST(Exr, APartLiesInItsFrame) {
    TemporaryFolder folder;
    const std::string path = folder.file("part.exr");
    const Image image = gradient(3, 2);
    const std::vector<float> depths{1, 2, 3, 4, 5, 6};
    writeExr(path, image, {}, {{"", "Z", depths}}, FramePlacement{20, 10, {7, 4, 10, 6}});

    Imf::InputFile file(path.c_str());
    EXPECT_EQ(file.header().displayWindow(), Imath::Box2i({0, 0}, {19, 9}));
    EXPECT_EQ(file.header().dataWindow(), Imath::Box2i({7, 4}, {9, 5}));
    std::vector<float> read(6);
    Imf::FrameBuffer buffer;
    buffer.insert("Z", Imf::Slice::Make(Imf::FLOAT, read.data(), file.header().dataWindow()));
    file.setFrameBuffer(buffer);
    file.readPixels(4, 5);
    EXPECT_EQ(read, depths);
    EXPECT_EQ(readExr(path).pixels, image.pixels);
}

TEST(Exr, ReadsHalfChannelsAndShiftedDataWindows) {
    TemporaryFolder folder;
    const std::string path = folder.file("half.exr");
    {
        const Imath::Box2i window({-5, 10}, {-2, 12});
        Imf::RgbaOutputFile file(path.c_str(), Imath::Box2i({0, 0}, {99, 99}), window);
        const auto pixels = halfPixels(12);
        file.setFrameBuffer(pixels.data() + 5 - 10 * 4, 1, 4);
        file.writePixels(3);
    }
    const Image image = readExr(path);
    EXPECT_EQ(image.width, 4u);
    EXPECT_EQ(image.height, 3u);
    expectHalfPixels(image, 12);
}

TEST(Exr, ReadsTiledFiles) {
    TemporaryFolder folder;
    const std::string path = folder.file("tiled.exr");
    {
        Imf::TiledRgbaOutputFile file(path.c_str(), 6, 5, 4, 4, Imf::ONE_LEVEL);
        const auto pixels = halfPixels(30);
        file.setFrameBuffer(pixels.data(), 1, 6);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    }
    expectHalfPixels(readExr(path), 30);
}

TEST(Exr, NamesTheChannelThatIsMissing) {
    TemporaryFolder folder;
    const std::string path = folder.file("luminance.exr");
    {
        Imf::Header header(1, 1);
        header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
        Imf::OutputFile file(path.c_str(), header);
        float value = 1;
        Imf::FrameBuffer buffer;
        buffer.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&value), sizeof value, sizeof value));
        file.setFrameBuffer(buffer);
        file.writePixels(1);
    }
    expectError(ErrorCode::Input, "no channel R (it has: Y)", [&] { readExr(path); });
}

TEST(Exr, RefusesFilesThatAreNone) {
    TemporaryFolder folder;
    std::ofstream(folder.file("text.exr")) << "This is no image.";
    std::ofstream(folder.file("empty.exr"));
    expectError(ErrorCode::Input, "text.exr", [&] { readExr(folder.file("text.exr")); });
    expectError(ErrorCode::Input, "empty.exr", [&] { readExr(folder.file("empty.exr")); });
    expectError(ErrorCode::Input, "missing.exr", [&] { readExr(folder.file("missing.exr")); });
}

TEST(Exr, RefusesEveryTruncation) {
    TemporaryFolder folder;
    const std::string path = folder.file("a.exr");
    writeExr(path, gradient(9, 20), {{"key", "value"}});
    const auto fullSize = std::filesystem::file_size(path);
    for (auto size = fullSize - 1; size > 0; size -= std::min<uintmax_t>(size, 37)) {
        std::filesystem::resize_file(path, size);
        expectError(ErrorCode::Input, "a.exr", [&] { readExr(path); });
    }
}

TEST(Exr, RefusesInconsistentImages) {
    TemporaryFolder folder;
    Image image = gradient(2, 2);
    image.pixels.pop_back();
    expectError(ErrorCode::Usage, "2x2 with 3 pixels", [&] { writeExr(folder.file("a.exr"), image, {}); });
    expectError(ErrorCode::Usage, "0x0", [&] { writeExr(folder.file("a.exr"), Image{}, {}); });
    EXPECT_TRUE(folder.names().empty());
}

TEST(Exr, ReportsMetadataThatOpenExrReserves) {
    TemporaryFolder folder;
    expectError(ErrorCode::Output, "a.exr", [&] {
        writeExr(folder.file("a.exr"), gradient(2, 2), {{"channels", "x"}});
    });
    EXPECT_TRUE(folder.names().empty());
}
