// The renderer's way to the same weights: two running quantities per sub-path, and a few products where two meet.
// Follows Georgiev, "Implementing Vertex Connection and Merging" (2012), with three changes that the enumerator
// demands:
//   * Sample counts. dVCM stays free of them; the count of the technique that it stands for is multiplied in where it
//     is used: for a sub-path's first surface vertex next event (light side) or the splat (camera side), after that
//     connections, and at an emitter hit always next event.
//   * dVM is dVC/η at every vertex, so it is not kept.
//   * At a smooth interface dVC takes the factor c_in·(n_in/n_out)² instead of the report's cosθ_o [53], which is the
//     same for reflection only.
// Real is the precision of the recursion; densities arrive in double.
#pragma once

#include <vector>

#include "support/reference/mis_path.h"

namespace antipode::reference {

/// What a sub-path carries, at its newest vertex, after the arrival update.
template <class Real>
struct SubPathState {
    Real dVCM = 0;  ///< 1/(area density of this vertex), relative to the technique that ends one vertex earlier
    Real dVC = 0;   ///< Σ of n·p of all techniques further back, per unit of reverse solid-angle density
    uint32_t edges = 0;
};

/// Weights in the order of enumerateWeights, computed technique by technique as the renderer does.
template <class Real>
std::vector<TechniqueWeight> recursiveWeights(const FullPath& path, const TechniqueCounts& counts);

extern template std::vector<TechniqueWeight> recursiveWeights<double>(const FullPath&, const TechniqueCounts&);
extern template std::vector<TechniqueWeight> recursiveWeights<float>(const FullPath&, const TechniqueCounts&);

}  // namespace antipode::reference
