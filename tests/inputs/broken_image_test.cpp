// Pictures that are cut off short, damaged, or promise more than they hold.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "renderengine/error.h"
#include "scene/environment_map.h"
#include "scene/image_decode.h"
#include "scene/radiance_hdr.h"
#include "support/hard_case.h"
#include "tests/inputs/child_process.h"
#include "tests/inputs/pictures.h"
#include "tests/scene/model_files.h"

namespace antipode::test {
namespace {

constexpr int kFlips = 150;  // for each picture; there are 28

/// Small pictures need little memory, broken ones no more.
const ChildLimits kLimits{60, uint64_t(512) << 20};

struct Picture {
    std::string name;
    Bytes bytes;
    size_t needed;  ///< how many of the bytes say something about pixels; what is cut off behind them is not missed
};

std::vector<Picture> allPictures() {
    std::vector<Picture> pictures;
    const auto add = [&](const std::string& name, Bytes bytes) {
        const size_t size = bytes.size();
        pictures.push_back({name, std::move(bytes), size});
    };
    for (const PngKind& kind : pngKinds()) add(std::string(kind.name) + ".png", makePng(kind));
    for (const JpegKind& kind : jpegKinds()) {
        add(std::string(kind.name) + ".jpg", makeJpeg(kind));
        // The last bytes are the end's marker and the padding of the last bits.
        pictures.back().needed -= 16;
    }
    for (const char* coding : {"components", "pixels", "plain"}) add(coding + std::string(".hdr"), makeHdr(coding));
    for (const std::string& kind : exrKinds()) add(kind + ".exr", makeExr(kind));
    return pictures;
}

class BrokenPictures : public testing::ModelFiles {
protected:
    /// Reads the bytes as the product reads a file of that name; the number of pixels.
    size_t read(const std::string& name, const Bytes& bytes) const {
        if (name.ends_with(".png") || name.ends_with(".jpg")) return decodeImage(bytes, name).rgba.size() / 4;
        if (name.ends_with(".hdr")) return decodeRadianceHdr(bytes, name).pixels.size();
        const std::string path = (directory_ / name).string();
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
        return readEnvironmentMap(path).map.size();
    }

    static void expectNoHarm(const std::string& difficulty, const Picture& picture, const Outcome& outcome) {
        SCOPED_TRACE(::testing::Message() << picture.name << " of " << picture.bytes.size() << " bytes: " << outcome);
        expectWithin({"Bad input", difficulty, "picture files that give anything but pixels or one clear sentence", 0},
                     !(outcome.ending == Ending::Returned && outcome.text.empty() && outcome.output.empty()));
    }

    /// In a child: what is wrong with how `bytes` are taken; "" for pixels, or a sentence that names the file.
    std::string objection(const std::string& name, const Bytes& bytes, bool mustFail) const {
        try {
            read(name, bytes);
            return mustFail ? "it was taken" : "";
        } catch (const Error& e) {
            const std::string sentence = e.what();
            if (e.code() != ErrorCode::Input || sentence.find(name) == std::string::npos) return sentence;
            return "";
        }
    }
};

/// Every byte; of OpenEXR pictures, which take a file each, every seventh behind the header.
TEST_F(BrokenPictures, CutOff) {
    for (const Picture& picture : allPictures()) {
        const Outcome outcome = runInChild(
            [&] {
                for (size_t size = 0; size < picture.bytes.size();
                     size += picture.name.ends_with(".exr") && size > 400 ? 7 : 1) {
                    const Bytes cut(picture.bytes.begin(), picture.bytes.begin() + std::ptrdiff_t(size));
                    const std::string why = objection(picture.name, cut, size < picture.needed);
                    if (!why.empty()) return "at byte " + std::to_string(size) + ": " + why;
                }
                return std::string();
            },
            kLimits);
        expectNoHarm("a PNG, JPEG, HDR or EXR file that is cut off at any byte", picture, outcome);
    }
}

TEST_F(BrokenPictures, BitsTurnedOver) {
    for (const Picture& picture : allPictures()) {
        const Outcome outcome = runInChild(
            [&] {
                for (uint64_t seed = 0; seed < kFlips; ++seed) {
                    const std::string why = objection(picture.name, withFlippedBits(picture.bytes, seed), false);
                    if (!why.empty()) return "seed " + std::to_string(seed) + ": " + why;
                }
                return std::string();
            },
            kLimits);
        expectNoHarm("a PNG, JPEG, HDR or EXR file with bits turned over", picture, outcome);
    }
}

void putBigEndian(Bytes& bytes, size_t at, uint32_t value, int count) {
    for (int i = 0; i < count; ++i) bytes[at + size_t(i)] = uint8_t(value >> (8 * (count - 1 - i)));
}

uint32_t crcOf(const uint8_t* data, size_t size) {
    uint32_t crc = 0xffffffffu;
    for (size_t i = 0; i < size; ++i) {
        crc ^= data[i];
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    return ~crc;
}

Bytes claimingPng(uint32_t width, uint32_t height) {
    Bytes png = makePng(pngKinds()[8]);
    putBigEndian(png, 16, width, 4);
    putBigEndian(png, 20, height, 4);
    putBigEndian(png, 29, crcOf(&png[12], 17), 4);
    return png;
}

Bytes claimingJpeg(uint32_t width, uint32_t height) {
    Bytes jpeg = makeJpeg(jpegKinds()[1]);
    for (size_t i = 2; i + 9 < jpeg.size(); ++i) {
        if (jpeg[i] != 0xff || jpeg[i + 1] != 0xc0) continue;
        putBigEndian(jpeg, i + 5, height, 2);
        putBigEndian(jpeg, i + 7, width, 2);
        break;
    }
    return jpeg;
}

Bytes claimingHdr(uint32_t width, uint32_t height) {
    const std::string text = "#?RADIANCE\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
    Bytes bytes(text.begin(), text.end());
    bytes.resize(bytes.size() + 4 * 4096, 1);
    return bytes;
}

/// The data window of a sound file, overwritten.
Bytes claimingExr(uint32_t width, uint32_t height) {
    Bytes exr = makeExr("zip");
    const std::string key("dataWindow\0box2i\0\x10\0\0\0", 21);
    const auto found = std::search(exr.begin(), exr.end(), key.begin(), key.end());
    for (size_t i = 0; i < 4; ++i) {
        found[std::ptrdiff_t(key.size() + 8 + i)] = uint8_t((width - 1) >> (8 * i));
        found[std::ptrdiff_t(key.size() + 12 + i)] = uint8_t((height - 1) >> (8 * i));
    }
    return exr;
}

TEST_F(BrokenPictures, SizesThatTheBytesCannotFill) {
    const struct {
        const char* name;
        Bytes (*make)(uint32_t, uint32_t);
    } formats[] = {{"claim.png", claimingPng},
                   {"claim.jpg", claimingJpeg},
                   {"claim.hdr", claimingHdr},
                   {"claim.exr", claimingExr}};
    const uint32_t sizes[][2] = {{65535, 65535},           {65535, 1},    {1, 65535},
                                 {16384, 16384},           {65535, 4096}, {0x7fffffff, 1},
                                 {0x7fffffff, 0x7fffffff}, {0, 0},        {0xffffffff, 0xffffffff}};
    for (const auto& format : formats) {
        for (const auto& [width, height] : sizes) {
            const Bytes bytes = format.make(width, height);
            const Outcome outcome = runInChild(
                [&, w = width, h = height] {
                    try {
                        return std::string("taken: ") + std::to_string(read(format.name, bytes));
                    } catch (const Error& e) {
                        if (std::string(e.what()).find("bad_alloc") != std::string::npos) return std::string(e.what());
                        throw;
                    }
                },
                kLimits);
            // OpenEXR takes a chunk that unpacks to less than its row; what is missing is no memory, at least.
            const bool taken = format.make == claimingExr && outcome.ending == Ending::Returned;
            EXPECT_TRUE(outcome.ending == Ending::InputError || (taken && uint64_t(width) * height <= 65535))
                << format.name << " " << width << "x" << height << ": " << outcome;
            EXPECT_EQ(objectionTo(outcome, format.name), "") << outcome;
        }
    }
}

TEST_F(BrokenPictures, RunsOfRadiancePicturesThatLeaveTheirRow) {
    const std::string header = "#?RADIANCE\n\n-Y 1 +X 8\n";
    const std::vector<std::vector<int>> rows = {
        {2, 2, 0, 8, 128 + 9, 1},                                                    // a run too long
        {2, 2, 0, 8, 9, 1, 2, 3, 4, 5, 6, 7, 8, 9},                                  // literals too many
        {2, 2, 0, 8, 0, 0, 0, 0},                                                    // nothing, forever
        {2, 2, 0, 8, 128},                                                           // 128 literals
        {2, 2, 0, 9, 128 + 8, 1, 128 + 8, 1, 128 + 8, 1, 128 + 8, 1},                // another width
        {1, 1, 1, 1, 1, 1, 1, 1},                                                    // repeats what is not there
        {9, 9, 9, 9, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 255},  // shifts beyond all bits
        {9, 9, 9, 9, 1, 1, 1, 255},
    };
    for (size_t i = 0; i < rows.size(); ++i) {
        Bytes bytes(header.begin(), header.end());
        for (int value : rows[i]) bytes.push_back(uint8_t(value));
        testing::inputErrorOf([&] { decodeRadianceHdr(bytes, "run.hdr"); });
    }
}

}  // namespace
}  // namespace antipode::test
