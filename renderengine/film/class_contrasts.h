// Differences between the residue classes of a pixel: how far they lie apart tells how far their mean is off.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderengine/film.h"

namespace antipode {

/// Classes with iterations, and K − 1 orthonormal contrasts between them: combinations of √n_k·mean_k that are free of
/// the common mean, each of the variance of one iteration, uncorrelated with one another and with the mean of all.
/// Where counts are equal and K is a power of two each weighs all classes alike, as the mean does (Walsh functions):
/// the mean's error and the contrasts then have equal second and fourth moments whatever the samples' distribution.
class ClassContrasts {
public:
    static constexpr uint32_t most = SettingsLimits::residueClasses;
    using Means = std::array<double, most>;

    /// Of the image's classes, or of those of another layer that comes in them: of none where it does not.
    explicit ClassContrasts(const FilmSums& sums, LayerKind kind = LayerKind::Image);

    /// K: how many classes have iterations.
    uint32_t classes() const { return uint32_t(layers_.size()); }
    uint32_t count() const { return classes() - 1; }
    double iterations() const { return iterations_; }
    double iterations(uint32_t k) const { return counts_[k]; }

    /// Means of the classes at value `index` of the layer (of the image: 3·pixel + channel).
    Means means(size_t index) const {
        Means means{};
        for (uint32_t k = 0; k < classes(); ++k) means[k] = double(layers_[k][index]) * scales_[k];
        return means;
    }
    /// Contrast j < count() of them, scaled so that its variance is that of the mean of all iterations.
    double contrast(uint32_t j, const Means& means) const {
        double sum = 0;
        for (uint32_t k = 0; k < classes(); ++k) sum += weights_[j][k] * means[k];
        return sum;
    }
    /// Σ of the squares of all contrasts over their number: unbiased for the variance of the mean.
    double variance(const Means& means) const;

private:
    std::vector<std::span<const int64_t>> layers_;
    std::vector<double> counts_, scales_;
    std::vector<Means> weights_;
    double iterations_ = 0;
};

}  // namespace antipode
