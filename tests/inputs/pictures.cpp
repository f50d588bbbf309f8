#include "tests/inputs/pictures.h"

#include <png.h>
#include <turbojpeg.h>

#include <memory>
#include <stdexcept>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfTiledOutputFile.h>

namespace antipode::test {
namespace {

constexpr uint32_t kPixels = kPictureWidth * kPictureHeight;

void putPngSample(Bytes& row, int bitDepth, uint8_t value) {
    row.push_back(value);
    if (bitDepth == 16) row.push_back(0x5a);  // the lower byte, which decoding drops
}

Bytes pngRow(const PngKind& kind, uint32_t y) {
    Bytes row;
    for (uint32_t x = 0; x < kPictureWidth; ++x) {
        const uint8_t grey = greyAt(x, y);
        const bool rgb = kind.colorType & PNG_COLOR_MASK_COLOR && kind.colorType != PNG_COLOR_TYPE_PALETTE;
        for (int channel = 0; channel < (rgb ? 3 : 1); ++channel) putPngSample(row, kind.bitDepth, grey);
        if (kind.colorType & PNG_COLOR_MASK_ALPHA) putPngSample(row, kind.bitDepth, uint8_t(255 - grey));
    }
    return row;
}

void appendTo(png_structp png, png_bytep data, size_t size) {
    auto& bytes = *static_cast<Bytes*>(png_get_io_ptr(png));
    bytes.insert(bytes.end(), data, data + size);
}

void putLine(Bytes& bytes, const std::string& text) { bytes.insert(bytes.end(), text.begin(), text.end()); }

Imf::Compression compressionOf(const std::string& kind) {
    if (kind == "rle") return Imf::RLE_COMPRESSION;
    if (kind == "zip" || kind == "half" || kind == "tiled") return Imf::ZIP_COMPRESSION;
    if (kind == "piz") return Imf::PIZ_COMPRESSION;
    if (kind == "pxr24") return Imf::PXR24_COMPRESSION;
    if (kind == "b44") return Imf::B44_COMPRESSION;
    if (kind == "dwaa") return Imf::DWAA_COMPRESSION;
    return Imf::NO_COMPRESSION;
}

}  // namespace

uint8_t greyAt(uint32_t x, uint32_t y) { return uint8_t(20 + 6 * x + 7 * y); }

const std::vector<PngKind>& pngKinds() {
    static const std::vector<PngKind> kinds = {{"Grey8", PNG_COLOR_TYPE_GRAY, 8, false},
                                               {"Grey16", PNG_COLOR_TYPE_GRAY, 16, false},
                                               {"GreyAlpha8", PNG_COLOR_TYPE_GRAY_ALPHA, 8, false},
                                               {"GreyAlpha16Interlaced", PNG_COLOR_TYPE_GRAY_ALPHA, 16, true},
                                               {"Palette8", PNG_COLOR_TYPE_PALETTE, 8, false},
                                               {"Palette8Interlaced", PNG_COLOR_TYPE_PALETTE, 8, true},
                                               {"Rgb8", PNG_COLOR_TYPE_RGB, 8, false},
                                               {"Rgb16Interlaced", PNG_COLOR_TYPE_RGB, 16, true},
                                               {"Rgba8", PNG_COLOR_TYPE_RGBA, 8, false},
                                               {"Rgba8Interlaced", PNG_COLOR_TYPE_RGBA, 8, true},
                                               {"Rgba16", PNG_COLOR_TYPE_RGBA, 16, false}};
    return kinds;
}

Bytes makePng(const PngKind& kind, double gamma) {
    Bytes bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &bytes, appendTo, nullptr);
    png_set_IHDR(png, info, kPictureWidth, kPictureHeight, kind.bitDepth, kind.colorType,
                 kind.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    std::vector<png_color> palette;
    for (int i = 0; i < 256; ++i) palette.push_back({uint8_t(i), uint8_t(i), uint8_t(i)});
    if (kind.colorType == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette.data(), 256);
    if (gamma > 0) png_set_gAMA(png, info, gamma);
    png_write_info(png, info);
    std::vector<Bytes> rows;
    std::vector<png_bytep> pointers;
    for (uint32_t y = 0; y < kPictureHeight; ++y) rows.push_back(pngRow(kind, y));
    for (Bytes& row : rows) pointers.push_back(row.data());
    png_write_image(png, pointers.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

const std::vector<JpegKind>& jpegKinds() {
    static const std::vector<JpegKind> kinds = {{"Grey", TJSAMP_GRAY, false, false},
                                                {"Full", TJSAMP_444, false, false},
                                                {"Subsampled", TJSAMP_420, false, false},
                                                {"Progressive", TJSAMP_420, true, false},
                                                {"Cmyk", TJSAMP_444, false, true}};
    return kinds;
}

Bytes makeJpeg(const JpegKind& kind) {
    Bytes pixels;
    for (uint32_t i = 0; i < kPixels; ++i)
        for (int c = 0; c < (kind.cmyk ? 4 : 3); ++c)
            pixels.push_back(c < 3 ? greyAt(i % kPictureWidth, i / kPictureWidth) : 255);  // Adobe's inks are inverted
    const std::unique_ptr<void, decltype(&tjDestroy)> encoder(tjInitCompress(), tjDestroy);
    unsigned char* data = nullptr;
    unsigned long size = 0;
    if (tjCompress2(encoder.get(), pixels.data(), kPictureWidth, 0, kPictureHeight, kind.cmyk ? TJPF_CMYK : TJPF_RGB,
                    &data, &size, kind.subsampling, 95, kind.progressive ? TJFLAG_PROGRESSIVE : 0) != 0)
        throw std::runtime_error(tjGetErrorStr2(encoder.get()));
    const Bytes bytes(data, data + size);
    tjFree(data);
    return bytes;
}

Bytes makeHdr(const std::string& coding) {
    Bytes bytes;
    putLine(bytes, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 13 +X 19\n");
    for (uint32_t y = 0; y < kPictureHeight; ++y) {
        if (coding == "components") {
            putLine(bytes, {2, 2, 0, char(kPictureWidth)});
            for (int component = 0; component < 3; ++component) {
                bytes.push_back(uint8_t(kPictureWidth));
                for (uint32_t x = 0; x < kPictureWidth; ++x) bytes.push_back(greyAt(x, y));
            }
            bytes.push_back(uint8_t(128 + kPictureWidth));
            bytes.push_back(128);
            continue;
        }
        for (uint32_t x = 0; x < kPictureWidth; ++x) {
            const uint8_t grey = coding == "pixels" ? greyAt(0, y) : greyAt(x, y);
            bytes.insert(bytes.end(), {grey, grey, grey, 128});
            if (coding != "pixels") continue;
            bytes.insert(bytes.end(), {1, 1, 1, uint8_t(kPictureWidth - 1)});
            break;
        }
    }
    return bytes;
}

const std::vector<std::string>& exrKinds() {
    static const std::vector<std::string> kinds = {"none", "rle",  "zip",  "piz",  "pxr24",
                                                   "b44",  "dwaa", "half", "tiled"};
    return kinds;
}

Bytes makeExr(const std::string& kind) {
    const bool half = kind == "half" || kind == "b44";
    std::vector<float> floats;
    for (uint32_t i = 0; i < kPixels; ++i) floats.push_back(float(greyAt(i % kPictureWidth, i / kPictureWidth)));
    std::vector<Imath::half> halfValues(floats.begin(), floats.end());
    char* data = half ? reinterpret_cast<char*>(halfValues.data()) : reinterpret_cast<char*>(floats.data());
    const size_t size = half ? 2 : 4;
    const Imf::PixelType type = half ? Imf::HALF : Imf::FLOAT;
    Imf::Header header(kPictureWidth, kPictureHeight);
    header.compression() = compressionOf(kind);
    Imf::FrameBuffer buffer;
    for (const char* name : {"R", "G", "B"}) {
        header.channels().insert(name, Imf::Channel(type));
        buffer.insert(name, Imf::Slice(type, data, size, size * kPictureWidth));
    }
    Imf::StdOSStream stream;
    if (kind == "tiled") {
        header.setTileDescription(Imf::TileDescription(8, 8));
        Imf::TiledOutputFile file(stream, header);
        file.setFrameBuffer(buffer);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    } else {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(buffer);
        file.writePixels(kPictureHeight);
    }
    const std::string text = stream.str();
    return Bytes(text.begin(), text.end());
}

}  // namespace antipode::test
