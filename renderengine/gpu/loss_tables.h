// Tables of what single scattering at rough surfaces loses: what the kernels read (lib/losses.glsl), and the same
// look-ups on the host. The values are computed as the project is built (make_loss_tables.cpp).
#pragma once

#include <vector>

#include "kernels/shared/layout.h"

namespace antipode {

/// The texels of BIND_LOSSES: the loss of white facets, of each cell of the table its four corners, row after row of
/// roughness; behind them, for each pair of nodes, the two means over α. With `glass` there follow the cells of glass,
/// for each index from outside, then from inside, and the means, of each index those from outside and from inside.
std::vector<shared::vec4> packLosses(bool glass);

/// Interpolated as the kernels do: the part of light from a direction of this cosine in (0,1] that white facets of
/// width alpha in (0,1] do not reflect at once, and its cosine-weighted mean.
double tabulatedMetalLoss(double cosine, double alpha);
double tabulatedMetalMeanLoss(double alpha);

/// The same of what glass neither reflects nor passes on. eta: index beyond over index here.
double tabulatedGlassLoss(double cosine, double alpha, double eta);
double tabulatedGlassMeanLoss(double alpha, double eta);

}  // namespace antipode
