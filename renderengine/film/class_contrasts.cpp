#include "film/class_contrasts.h"

#include <bit>
#include <cmath>
#include <numbers>

namespace antipode {
namespace {

/// Row j of an orthonormal basis of R^K whose row 0 is constant: Walsh's, or else the cosine transform's.
double basis(uint32_t j, uint32_t k, uint32_t classes) {
    if (std::has_single_bit(classes)) return (std::popcount(j & k) % 2 ? -1 : 1) / std::sqrt(double(classes));
    if (j == 0) return 1 / std::sqrt(double(classes));
    return std::sqrt(2.0 / classes) * std::cos(std::numbers::pi * j * (k + 0.5) / classes);
}

}  // namespace

ClassContrasts::ClassContrasts(const FilmSums& sums, LayerKind kind) {
    const size_t first = sums.layout.find(kind);
    if (sums.layout.count(kind) != sums.residueIterations.size()) return;
    for (uint32_t k = 0; k < sums.residueIterations.size(); ++k) {
        if (sums.residueIterations[k] == 0) continue;
        layers_.push_back(sums.layer(first + k));
        counts_.push_back(double(sums.residueIterations[k]));
        iterations_ += counts_.back();
        scales_.push_back(std::ldexp(1 / counts_.back(), -sums.layout.layers[first].scaleExponent));
    }
    const uint32_t K = classes();
    if (K < 2) return;
    // The reflection that takes the constant row to √(n_k/N) takes the others to what is orthogonal to that.
    Means mirror{};
    double length = 0;
    for (uint32_t k = 0; k < K; ++k) {
        mirror[k] = basis(0, k, K) - std::sqrt(counts_[k] / iterations_);
        length += mirror[k] * mirror[k];
    }
    for (uint32_t j = 1; j < K; ++j) {
        double along = 0;
        for (uint32_t k = 0; k < K; ++k) along += mirror[k] * basis(j, k, K);
        Means& row = weights_.emplace_back();
        for (uint32_t k = 0; k < K; ++k) {
            const double reflected = basis(j, k, K) - (length > 0 ? 2 * along / length * mirror[k] : 0);
            row[k] = reflected * std::sqrt(counts_[k] / iterations_);
        }
    }
}

double ClassContrasts::variance(const Means& means) const {
    double squares = 0;
    for (uint32_t j = 0; j < count(); ++j) squares += contrast(j, means) * contrast(j, means);
    return squares / count();
}

}  // namespace antipode
