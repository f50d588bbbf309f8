// What white sheen reflects, for the tables of layer_tables.h.
#pragma once

namespace antipode {

/// The part of light from a direction of cosine μ in (0,1] that white sheen of width alpha in (0,1] reflects: the model
/// of lib/lobes/sheen.glsl, by quadrature in double. Within 10^-4 for alpha from .05.
double sheenAlbedo(double cosine, double alpha);

}  // namespace antipode
