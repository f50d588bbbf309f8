// Balance-heuristic weights from first principles: the full-path density of every technique in the product area
// measure, times its sample count, over the sum of all of them. No recursion, no cancellation by hand: O(k²),
// logarithms throughout, so that paths of any length and scale neither overflow nor underflow.
//
// Densities through smooth interfaces: a delta distribution is written per projected solid angle times n², n the index
// on the outgoing side, because n² dσ⊥ is what refraction conserves; the remaining delta is then the same seen from
// both ends and cancels between techniques (Veach 1997, 5.2 and 5.3).
#pragma once

#include <vector>

#include "support/reference/mis_path.h"

namespace antipode::reference {

/// Weights of all techniques that can sample the path with the given counts, in the order s = 0 … k for connections,
/// then merges at x_1 … x_{k−1}; impossible techniques are left out. Empty where none can.
std::vector<TechniqueWeight> enumerateWeights(const FullPath& path, const TechniqueCounts& counts);

}  // namespace antipode::reference
