// Sums of radiance samples in fixed point, and the floating-point image that they stand for.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "renderengine/events.h"
#include "renderengine/film_layout.h"
#include "renderengine/vec.h"

namespace antipode {

/// Linear RGB, row 0 on top, width·height pixels.
struct Image {
    uint32_t width = 0, height = 0;
    std::vector<Vec3f> pixels;
};

/// A layer as files hold it.
struct LayerImage {
    std::string name;           ///< prefix of its channels; "" for none
    std::string channels;       ///< one letter each
    std::vector<float> values;  ///< row-major, channels side by side
};

/// Σ over iterations of samples·2^scaleExponent per pixel and channel, each rounded at random to one of the two whole
/// numbers around it, so that its mean is kept. Integer sums do not depend on the order in which they are added: the
/// same iterations give the same bytes on any farm.
struct FilmSums {
    FilmLayout layout;
    uint64_t iterations = 0;
    std::vector<int64_t> values;  ///< layout.values() of them, or none
    EventCounts events;
    std::vector<uint64_t> residueIterations = {};  ///< of each residue class; nothing where there is but one

    std::span<int64_t> layer(size_t index);
    std::span<const int64_t> layer(size_t index) const;
    /// How many iterations the layer has sums of.
    uint64_t iterationsOf(size_t layer) const;
    /// The sums of all layers of the kind, added up. Throws Error(Device) where one does not fit.
    std::vector<int64_t> summed(LayerKind kind) const;

    /// Adds another set of iterations. Throws Error(Usage) where layouts differ, and Error(Device) where a sum, or the
    /// image's sum over its residue classes, would leave 64 bits; then changes nothing.
    void merge(const FilmSums& other);
    /// The same for one whose image, and blur, is in one layer and is all of this class of
    /// renderengine/error_classes.h.
    void merge(const FilmSums& other, uint32_t residueClass);
    /// The film of the image in one layer: the sums that a render without residue classes and other layers has.
    /// Throws Error(Device) where one does not fit.
    FilmSums imageAlone() const;
    /// The mean image: sums / (iterations·2^scaleExponent), computed in double. Throws Error(Usage) without iterations.
    Image image() const;
    /// Means of all layers that are not the whole image: over the iterations that they sum; depth and position over
    /// those that met a surface, 0 where none did. Classes of iterations without a name are not among them, nor is the
    /// blur (see biasLayer() of error_estimate.h).
    std::vector<LayerImage> layerImages() const;
    /// Lower-case hexadecimal SHA-256 over the layers, of each: width, height, scaleExponent (uint32 LE), iterations
    /// (uint64 LE), then the sums as little-endian int64.
    std::string sha256() const;
};

using ImageMetadata = std::map<std::string, std::string>;

/// Where an image lies in the frame that it is a part of.
struct FramePlacement {
    uint32_t frameWidth = 0, frameHeight = 0;
    PixelWindow window;  ///< of the image's size
};

/// Writes linear RGB, and further layers of the same size, as 32-bit float OpenEXR, complete or not at all (temporary
/// file, then rename). A part of a frame is the data window in the frame's display window. Throws Error(Output).
void writeExr(const std::string& path, const Image& image, const ImageMetadata& metadata,
              const std::vector<LayerImage>& layers = {}, const std::optional<FramePlacement>& placement = {});
/// Reads the R, G, B channels of any OpenEXR file (half, float). Throws Error(Input).
Image readExr(const std::string& path, ImageMetadata* metadata = nullptr);
/// Writes the image through the tone curve as an 8-bit sRGB PNG, complete or not at all. Throws Error(Output).
void writePng(const std::string& path, const Image& image);

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
