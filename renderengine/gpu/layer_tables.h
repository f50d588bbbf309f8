// Tables of what the layers of a material reflect: what the kernels read (lib/albedos.glsl), and the same look-ups on
// the host. The values are computed as the project is built (make_loss_tables.cpp).
#pragma once

#include <vector>

#include "kernels/shared/layout.h"

namespace antipode {

/// Roughness of sheen, perceptual, below which the model would reflect more than arrives.
constexpr double leastSheenRoughness = shared::SHEEN_LEAST_PERCENT / 100.0;

/// What BIND_LOSSES has behind packLosses(): of clear coats the cells of the table, row after row of roughness, and for
/// each pair of nodes the two means; then the cells of sheen.
std::vector<shared::vec4> packLayerAlbedos();

/// Interpolated as the kernels do: what a clear coat of this perceptual roughness in [0,1] reflects of light from a
/// direction of this cosine in (0,1]; its cosine-weighted mean; and the mean of its product with (1 − cosine)⁵.
double tabulatedCoatAlbedo(double cosine, double roughness);
double tabulatedCoatMeanAlbedo(double roughness);
double tabulatedCoatSchlickMean(double roughness);

/// The same of white sheen, of roughness in [leastSheenRoughness,1].
double tabulatedSheenAlbedo(double cosine, double roughness);

}  // namespace antipode
