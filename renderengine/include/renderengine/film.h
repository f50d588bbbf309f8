// Sums of radiance samples in fixed point, and the floating-point image that they stand for.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "renderengine/events.h"
#include "renderengine/vec.h"

namespace antipode {

/// Linear RGB, row 0 on top, width·height pixels.
struct Image {
    uint32_t width = 0, height = 0;
    std::vector<Vec3f> pixels;
};

/// Σ over iterations of samples·2^scaleExponent per pixel and channel, each rounded at random to one of the two whole
/// numbers around it, so that its mean is kept. Integer sums do not depend on the order in which they are added: the
/// same iterations give the same bytes on any farm.
struct FilmSums {
    uint32_t width = 0, height = 0;
    int32_t scaleExponent = 0;
    uint64_t iterations = 0;
    std::vector<int64_t> rgb;  ///< width·height·3, row-major, channels interleaved
    EventCounts events;

    /// Adds another set of iterations. Throws Error(Usage) where sizes or scales differ or a sum would overflow, and
    /// then changes nothing.
    void merge(const FilmSums& other);
    /// The mean image: sums / (iterations·2^scaleExponent), computed in double. Throws Error(Usage) without iterations.
    Image image() const;
    /// Lower-case hexadecimal SHA-256 over width, height, scaleExponent (uint32 LE), iterations (uint64 LE), then the
    /// sums as little-endian int64.
    std::string sha256() const;
};

using ImageMetadata = std::map<std::string, std::string>;

/// Writes linear RGB as 32-bit float OpenEXR, complete or not at all (temporary file, then rename). Throws
/// Error(Output).
void writeExr(const std::string& path, const Image& image, const ImageMetadata& metadata);
/// Reads the R, G, B channels of any OpenEXR file (half, float). Throws Error(Input).
Image readExr(const std::string& path, ImageMetadata* metadata = nullptr);
/// Writes the image through the tone curve as an 8-bit sRGB PNG, complete or not at all. Throws Error(Output).
void writePng(const std::string& path, const Image& image);
/// Throws Error(Output) unless a file can be created or replaced at `path`; leaves nothing behind.
void checkWritable(const std::string& path);
/// Writes the bytes as the file's whole content, complete or not at all: temporary file in the same folder, fsync,
/// rename. Throws Error(Output).
void writeFileAtomically(const std::string& path, std::string_view bytes);
/// The same for content that comes in pieces: `write` is called with a function that appends to the file. What was at
/// `path` before is kept as `path` + `previousSuffix`, in place of what was there. Killed at any instant it leaves the
/// old or the new content whole at `path`; where the file system has no hard links, at one of the two names.
void writeFileAtomically(const std::string& path, const std::string& previousSuffix,
                         const std::function<void(const std::function<void(std::string_view)>& append)>& write);

struct WorstPixel {
    uint32_t x, y;
    Vec3f a, b;
    double relativeSquaredError;
};

/// A measured against the reference B. relMSE = mean over pixels and channels of (a−b)²/(b²+ε), ε = 0.01, on linear
/// RGB. Non-finite pixels are counted in either image and left out of the means.
struct ImageComparison {
    Vec3d meanA, meanB, ratio;
    double rmse = 0, relMse = 0;
    uint64_t nonFiniteA = 0, nonFiniteB = 0, negativeA = 0, negativeB = 0;
    std::vector<WorstPixel> worst;  ///< up to ten, worst first
};

/// Throws Error(Usage) where the sizes differ.
ImageComparison compareImages(const Image& a, const Image& b);

}  // namespace antipode
