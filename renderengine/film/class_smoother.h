// Classes of iterations with their noise smoothed away as far as it is noise.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "film/class_contrasts.h"

namespace antipode {

/// The classes of a pixel with their noise shrunk, and what variance that leaves to the mean of all; by channel.
struct Smooth {
    std::array<ClassContrasts::Means, 3> classes;
    std::array<double, 3> variance;
};

/// Shrinks differences between means over windows of 17², 9², 5², 3² and 1 pixels, from the mean of the image on: each
/// by the positive part of James and Stein's factor, 1 − λ·noise²/size², over all channels together (Efron & Morris
/// 1973; as wavelets are shrunk: Donoho & Johnstone 1995). How large the noise is the classes tell.
class ClassSmoother {
public:
    /// What is kept of the differences, by window.
    using Kept = std::array<double, 5>;

    /// Of a layer with so many channels, 3 at most, in whose classes the contrasts are. Both must outlive it.
    ClassSmoother(const FilmLayout& layout, const ClassContrasts& contrasts, uint32_t channels);

    /// Calls use(pixel, Smooth) for every pixel, in any order.
    template <class Use>
    void forEachPixel(const Use& use) {
        forEach([&](uint32_t x, uint32_t y) { use(size_t(y) * layout_.width + x, smooth(x, y, nullptr)); });
    }

    /// By the same factors in all pixels: of squares that are weighted and added up over the image, with λ = 1. For
    /// layers of one channel that are mostly noise: a pixel's few classes do not tell how much.
    template <class Use>
    void forEachPixelAlike(std::span<const float> weights, const Use& use) {
        Kept sizes{}, noises{}, kept;
        forEach([&](uint32_t x, uint32_t y) { addDetails(x, y, weights, sizes, noises); });
        for (size_t i = 0; i < kept.size(); ++i) kept[i] = noises[i] < sizes[i] ? 1 - noises[i] / sizes[i] : 0;
        forEach([&](uint32_t x, uint32_t y) { use(size_t(y) * layout_.width + x, smooth(x, y, &kept)); });
    }

private:
    using Means = ClassContrasts::Means;
    using Cell = std::array<Means, 3>;
    static constexpr std::array<uint32_t, 5> radii{8, 4, 2, 1, 0};
    static constexpr uint32_t halo = radii[0], core = 64;

    /// What a window's means differ by from the wider one's.
    struct Detail {
        std::array<Means, 3> classes;
        std::array<double, 3> noise;
        double size = 0, noises = 0;
    };

    template <class Use>
    void forEach(const Use& use) {
        for (uint32_t top = 0; top < layout_.height; top += core)
            for (uint32_t left = 0; left < layout_.width; left += core) {
                const uint32_t right = std::min(left + core, layout_.width);
                const uint32_t bottom = std::min(top + core, layout_.height);
                sumUp(left > halo ? left - halo : 0, top > halo ? top - halo : 0, std::min(right + halo, layout_.width),
                      std::min(bottom + halo, layout_.height));
                for (uint32_t y = top; y < bottom; ++y)
                    for (uint32_t x = left; x < right; ++x) use(x, y);
            }
    }

    /// Sums over rectangles of each class and channel, over a part of the image.
    void sumUp(uint32_t left, uint32_t top, uint32_t right, uint32_t bottom);
    /// Means of channel c over the part of the window within the image.
    Means means(uint32_t x, uint32_t y, uint32_t radius, uint32_t c) const;
    /// `coarse`: means of the wider window, which become those of this one.
    Detail detailOf(uint32_t x, uint32_t y, uint32_t radius, std::array<Means, 3>& coarse) const;
    void addDetails(uint32_t x, uint32_t y, std::span<const float> weights, Kept& sizes, Kept& noises) const;
    /// By factors of its own without `kept`.
    Smooth smooth(uint32_t x, uint32_t y, const Kept* kept) const;

    Cell& at(uint32_t x, uint32_t y) { return sums_[size_t(y - top_) * stride_ + (x - left_)]; }
    const Cell& at(uint32_t x, uint32_t y) const { return sums_[size_t(y - top_) * stride_ + (x - left_)]; }

    const FilmLayout& layout_;
    const ClassContrasts& contrasts_;
    const uint32_t channels_;
    std::array<Means, 3> image_{};  ///< means of all pixels
    uint32_t left_ = 0, top_ = 0, stride_ = 0;
    std::vector<Cell> sums_;
};

}  // namespace antipode
