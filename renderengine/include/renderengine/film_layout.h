// What the sums of a film are sums of: a list of layers. Everything that stores, sends, adds, hashes or writes sums
// walks it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "renderengine/iteration_range.h"
#include "renderengine/settings.h"

namespace antipode {

/// One quantity per pixel.
struct FilmLayer {
    LayerKind kind = LayerKind::Image;
    std::string name;           ///< prefix of its channels in files; "" for the image
    std::string channels;       ///< one letter each, "RGB"
    int32_t scaleExponent = 0;  ///< S: sums count 2^-S

    bool operator==(const FilmLayer&) const = default;
};

/// Layer after layer, so that one can be left out, sent or written by itself; within a layer row-major with its
/// channels side by side, so that a film of nothing but the image is the image's sums.
///
/// The image comes first, in one layer or in K: the k-th then sums iterations k, k + K, k + 2K … (from 0), and together
/// they are the image.
struct FilmLayout {
    uint32_t width = 0, height = 0;
    std::vector<FilmLayer> layers;

    uint64_t pixels() const { return uint64_t(width) * height; }
    /// Sums of a pixel, over all layers.
    uint64_t channels() const;
    /// Sums of the film.
    uint64_t values() const { return pixels() * channels(); }
    /// Where the sums of a layer begin.
    uint64_t offset(size_t layer) const;
    /// How many layers the image comes in: K.
    uint32_t residueClasses() const { return count(LayerKind::Image); }
    /// How many layers are of the kind, and which is the first: layers.size() where there is none.
    uint32_t count(LayerKind kind) const;
    size_t find(LayerKind kind) const;
    /// How many iterations of the range are of each residue class; nothing where there is but one.
    std::vector<uint64_t> residueCounts(const IterationRange& range) const;

    /// Whether the films hold the same quantities, at whatever scale.
    bool sameLayers(const FilmLayout& other) const;
    bool operator==(const FilmLayout&) const = default;
};

/// The film with image and blur parted into `classes` layers each, as renderengine/error_classes.h does.
FilmLayout inClasses(const FilmLayout& layout, uint32_t classes);
/// Where its layers lie then: of those two the layer of class `own`.
std::vector<size_t> placesInClasses(const FilmLayout& layout, uint32_t classes, uint32_t own);

/// The layers of a job, which client and servers derive from its settings alone. Scales are 0: the renderer chooses
/// them by what is in the scene.
FilmLayout filmLayout(const RenderSettings& settings);

/// The greatest S at which 10^6 iterations of samples up to `greatest` stay below 2^62, and 2^S is a float.
int32_t filmScaleExponent(double greatest);

}  // namespace antipode
