// Small pictures of every kind that the decoders claim to read, made by the formats' own libraries.
#pragma once

#include <string>
#include <vector>

#include "tests/inputs/mutations.h"

namespace antipode::test {

constexpr uint32_t kPictureWidth = 19, kPictureHeight = 13;

/// The grey value of a pixel, the same in all pictures: 8 bits, smooth enough for JPEG.
uint8_t greyAt(uint32_t x, uint32_t y);

struct PngKind {
    const char* name;
    int colorType, bitDepth;
    bool interlaced;
};
/// All combinations that PNG allows of colour types with 8 and 16 bits, flat and interlaced.
const std::vector<PngKind>& pngKinds();
/// Alpha is 255 − grey where the kind has it. `gamma`: written as gAMA chunk where it is positive.
Bytes makePng(const PngKind& kind, double gamma = 0);

struct JpegKind {
    const char* name;
    int subsampling;  ///< TJSAMP_…
    bool progressive, cmyk;
};
const std::vector<JpegKind>& jpegKinds();
Bytes makeJpeg(const JpegKind& kind);

/// Radiance pictures: components in runs, whole pixels in runs, no runs. Grey, value greyAt()/256·2^0.
Bytes makeHdr(const std::string& coding);

/// "none", "rle", "zip", "piz", "pxr24", "b44", "dwaa", tiles as "tiled"; half floats for "half".
Bytes makeExr(const std::string& kind);
const std::vector<std::string>& exrKinds();

}  // namespace antipode::test
