// Where textures are looked for, what stands in for those that cannot be had, and the kinds of pictures that are read.
#include "scene/texture_table.h"

#include <algorithm>

#include "renderengine/film.h"
#include "renderengine/import_options.h"
#include "scene/image_decode.h"
#include "tests/scene/model_files.h"

namespace antipode {
namespace {

using testing::inputErrorOf;

class Textures : public testing::ModelFiles {
protected:
    /// A triangle whose colour and bumps come from the images of these names.
    std::string model(const std::string& color, const std::string& color2 = "") {
        write("m.mtl", "newmtl a\nKd 1 1 1\nmap_Kd " + color + "\nnewmtl b\nKd 1 1 1\nmap_Kd " +
                           (color2.empty() ? color : color2) + "\n");
        return write("m.obj",
                     "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                     "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 3/3 2/2 1/1\n");
    }
    static std::vector<std::string> noticesOf(const Scene& scene, const std::string& word) {
        std::vector<std::string> found;
        for (const std::string& notice : scene.notices)
            if (notice.find(word) != std::string::npos) found.push_back(notice);
        return found;
    }
};

TEST_F(Textures, MissingOneIsACheckerAndOneNotice) {
    const Scene scene = importModel(model("gone.png"));
    ASSERT_EQ(scene.textures.size(), 1u);
    const Texture& texture = scene.textures[0];
    EXPECT_EQ(scene.materials[0].baseColorTexture, TextureIndex(0));
    EXPECT_EQ(scene.materials[1].baseColorTexture, TextureIndex(0));
    EXPECT_EQ(std::vector<uint8_t>(texture.rgba.begin(), texture.rgba.begin() + 8),
              (std::vector<uint8_t>{255, 0, 255, 255, 0, 0, 0, 255}));
    EXPECT_EQ(noticesOf(scene, "gone.png").size(), 1u);
    EXPECT_EQ(noticesOf(scene, "magenta").size(), 1u);
}

TEST_F(Textures, BrokenOneIsACheckerThatSaysWhy) {
    std::vector<uint8_t> png = testing::makePng();
    png.resize(png.size() / 2);
    write("half.png", png);
    const Scene scene = importModel(model("half.png"));
    ASSERT_EQ(noticesOf(scene, "half.png").size(), 1u);
    EXPECT_NE(noticesOf(scene, "half.png")[0].find("cut short"), std::string::npos) << scene.notices[0];
}

TEST_F(Textures, StrictRefusesBoth) {
    write("words.png", "words");
    ImportOptions strict;
    strict.strict = true;
    for (const char* name : {"gone.png", "words.png"}) {
        const std::string message = inputErrorOf([&] { importModel(model(name), strict); });
        EXPECT_NE(message.find(name), std::string::npos) << message;
    }
}

TEST_F(Textures, MissingDataAreLeftOut) {
    Scene scene;
    TextureTable table(directory_.string(), false, scene);
    EXPECT_FALSE(table.findFile("bumps.png", {TextureUse::Data}).has_value());
    EXPECT_FALSE(table.findFile("bumps.png", {TextureUse::Data}).has_value());
    EXPECT_TRUE(scene.textures.empty());
    EXPECT_EQ(scene.notices.size(), 1u);
}

TEST_F(Textures, FoundByBareNameAndWithoutCase) {
    std::filesystem::create_directory(directory_ / "Textures");
    std::filesystem::create_directory(directory_ / "Maps");
    write("Wood.PNG", testing::makePng());
    write("Textures/brick.png", testing::makePng());
    write("Maps/Moss.png", testing::makePng());
    const std::string folder = directory_.string();
    EXPECT_EQ(findImageFile(folder, "Wood.PNG"), folder + "/Wood.PNG");
    EXPECT_EQ(findImageFile(folder, "wood.png"), folder + "/Wood.PNG");
    EXPECT_EQ(findImageFile(folder, "C:\\Users\\artist\\Desktop\\wood.png"), folder + "/Wood.PNG");
    EXPECT_EQ(findImageFile(folder, "/home/artist/wood.png"), folder + "/Wood.PNG");
    EXPECT_EQ(findImageFile(folder, "../other/Brick.png"), folder + "/Textures/brick.png");
    EXPECT_EQ(findImageFile(folder, "maps\\moss.PNG"), folder + "/Maps/Moss.png");
    EXPECT_EQ(findImageFile(folder, "stone.png"), "");
    EXPECT_EQ(findImageFile(folder, "Maps"), "");
    EXPECT_EQ(findImageFile(folder, ""), "");
}

TEST_F(Textures, ExactNameGoesFirst) {
    write("a.png", testing::makePng());
    write("A.png", testing::makePng());
    EXPECT_EQ(findImageFile(directory_.string(), "A.png"), (directory_ / "A.png").string());
    EXPECT_EQ(findImageFile(directory_.string(), "a.png"), (directory_ / "a.png").string());
}

/// 2×2, uncompressed or in runs, stored from the bottom row up: blue, green / red, half-transparent white.
std::vector<uint8_t> makeTga(bool runs) {
    std::vector<uint8_t> tga = {0, 0, uint8_t(runs ? 10 : 2), 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 2, 0, 32, 8};
    if (runs) tga.push_back(3);  // four pixels that are written out
    for (uint8_t v : {0, 0, 255, 255, 255, 255, 255, 128, 255, 0, 0, 255, 0, 255, 0, 255}) tga.push_back(v);
    return tga;
}
const std::vector<uint8_t> kTgaTexels = {0, 0, 255, 255, 0, 255, 0, 255, 255, 0, 0, 255, 255, 255, 255, 128};

TEST(Pictures, Tga) {
    for (bool runs : {false, true}) {
        const Texture t = decodeImage(makeTga(runs), "t.tga");
        EXPECT_EQ(t.width, 2u);
        EXPECT_EQ(t.rgba, kTgaTexels) << runs;
    }
}

TEST(Pictures, TgaCutShortIsAnErrorAtEveryLength) {
    for (bool runs : {false, true}) {
        const std::vector<uint8_t> tga = makeTga(runs);
        for (size_t size = 0; size < tga.size(); ++size)
            EXPECT_THROW(decodeImage(std::span(tga).first(size), "t.tga"), Error) << size << " of " << tga.size();
    }
}

/// 1×2, 24 bits, rows of four bytes from the bottom up: blue / red.
std::vector<uint8_t> makeBmp() {
    std::vector<uint8_t> bmp = {'B', 'M', 62, 0, 0, 0, 0, 0, 0, 0, 54, 0, 0, 0,  40,
                                0,   0,   0,  1, 0, 0, 0, 2, 0, 0, 0,  1, 0, 24, 0};
    bmp.resize(54);
    for (uint8_t v : {0, 0, 255, 0, 255, 0, 0, 0}) bmp.push_back(v);
    return bmp;
}

TEST(Pictures, Bmp) {
    EXPECT_EQ(decodeImage(makeBmp(), "t.bmp").rgba, (std::vector<uint8_t>{0, 0, 255, 255, 255, 0, 0, 255}));
    const std::vector<uint8_t> bmp = makeBmp();
    for (size_t size = 0; size + 1 < bmp.size(); ++size)  // the last byte pads its row
        EXPECT_THROW(decodeImage(std::span(bmp).first(size), "t.bmp"), Error) << size;
}

TEST_F(Textures, FloatPicturesBecomeEightBits) {
    const std::string path = (directory_ / "t.exr").string();
    writeExr(path, {2, 1, {Vec3f(0.5f, 0.0f, 1.0f), Vec3f(2.0f, 0.25f, 0.0f)}}, {});
    std::vector<std::string> notices;
    // sRGB of 0.5 is 187.5 of 255, of 0.25 it is 136.96 (IEC 61966-2-1).
    EXPECT_EQ(readTexture(path, true, notices).rgba, (std::vector<uint8_t>{188, 0, 255, 255, 255, 137, 0, 255}));
    EXPECT_EQ(readTexture(path, false, notices).rgba, (std::vector<uint8_t>{128, 0, 255, 255, 255, 64, 0, 255}));
    EXPECT_EQ(notices.size(), 2u);
    writeExr(path, {1, 1, {Vec3f(0.5f)}}, {});
    readTexture(path, true, notices);
    EXPECT_EQ(notices.size(), 2u) << "nothing was lost but the last bits";
}

}  // namespace
}  // namespace antipode
