#include "gpu/loss_tables.h"

#include <algorithm>
#include <cmath>

#include "gpu/loss_axes.h"
#include "gpu/loss_values.h"
#include "gpu/table_nodes.h"

namespace antipode {
namespace {

template <size_t Rows>
double lookUp(const float (&table)[Rows][LOSS_COSINES], double cosine, double alpha) {
    return lookUpCells(table, lossColumn(cosine, alpha), std::sqrt(alpha));
}

template <size_t Means>
double lookUp(const float (&means)[Means], double alpha) {
    return alpha * lookUpNodes(means, std::sqrt(std::sqrt(alpha)));
}

}  // namespace

std::vector<vec4> packLosses(bool glass) {
    std::vector<vec4> texels;
    packCells(kMetalLosses, texels);
    for (uint i = 0; i + 1 < LOSS_MEANS; ++i) texels.push_back({kMetalMeanLosses[i], kMetalMeanLosses[i + 1], 0, 0});
    if (!glass) return texels;
    for (const auto& side : kGlassLosses)
        for (const auto& table : side) packCells(table, texels);
    for (uint k = 0; k < GLASS_LOSS_INDICES; ++k) {
        const auto &outside = kGlassMeanLosses[k], &inside = kGlassMeanLosses[GLASS_LOSS_INDICES + k];
        for (uint i = 0; i + 1 < GLASS_LOSS_MEANS; ++i)
            texels.push_back({outside[i], outside[i + 1], inside[i], inside[i + 1]});
    }
    return texels;
}

double tabulatedMetalLoss(double cosine, double alpha) { return lookUp(kMetalLosses, cosine, alpha); }

double tabulatedMetalMeanLoss(double alpha) { return lookUp(kMetalMeanLosses, alpha); }

double tabulatedGlassLoss(double cosine, double alpha, double eta) {
    const auto& side = kGlassLosses[eta < 1];
    const Between index(lossIndex(std::max(eta, 1 / eta)), GLASS_LOSS_INDICES);
    return mix(lookUp(side[index.first], cosine, alpha), lookUp(side[index.first + 1], cosine, alpha), index.rest);
}

double tabulatedGlassMeanLoss(double alpha, double eta) {
    const Between index(lossIndex(std::max(eta, 1 / eta)), GLASS_LOSS_INDICES);
    const uint first = index.first + (eta < 1 ? GLASS_LOSS_INDICES : 0);
    return mix(lookUp(kGlassMeanLosses[first], alpha), lookUp(kGlassMeanLosses[first + 1], alpha), index.rest);
}

}  // namespace antipode
