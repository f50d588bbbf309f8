// Random complete paths for the MIS tests: positions, materials, normals, light and camera are random, and normals are
// then chosen so that every vertex scatters with positive density both ways.
#pragma once

#include "support/reference/mis_path.h"

namespace antipode {

struct RandomPathOptions {
    uint32_t edges = 4;                 ///< ≥ 1
    double specularProbability = 0.35;  ///< of every surface vertex
    double mediumProbability = 0;       ///< of every vertex to be a point in a medium; then some edges have one, too
    double logScaleRange = 0;           ///< the path's size is 10^x, x uniform in ±this; segments vary by ±1 decade
};

reference::FullPath randomPath(const RandomPathOptions& options, Random& random);

}  // namespace antipode
