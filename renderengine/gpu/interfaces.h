// Where transparent bodies touch, nest or overlap, and which of them is the medium where they do.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/shared/layout.h"
#include "renderengine/scene.h"

namespace antipode {

/// Transparent bodies: meshes and spheres of a dielectric. Their ranks order them by the material's priority, then by
/// how many others' bounds hold them, then as they are declared, meshes before spheres: where bodies overlap, the
/// greatest rank is the medium. Bodies that are far from all others share the rank of what they are filled with.
struct Interfaces {
    std::vector<uint32_t> meshRanks, sphereRanks;  ///< of each mesh and sphere; 0: opaque
    std::vector<shared::uvec4> bodies;             ///< by rank, as kernels/shared/layout.h has them
    bool absorbs = false, scatters = false;        ///< any of them

    /// False where a surface's own index of refraction says all: no closed body touches another or holds it, none has a
    /// face in the plane of an opaque one, and none absorbs or scatters. All members are empty then.
    bool present() const { return !bodies.empty(); }
};

/// Whether a closed surface of it is a transparent body.
bool isTransparent(const Material& m);

/// Throws Error(InvalidScene) where there are more ranks, or more indices of refraction, than paths can name.
Interfaces findInterfaces(const Scene& scene);

}  // namespace antipode
