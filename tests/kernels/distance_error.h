// Exact distances along rays, and how far float arithmetic may miss them.
#pragma once

#include "support/reference/geometry.h"

namespace antipode {

/// Distance at which the ray meets this primitive alone.
std::optional<double> exactDistance(const reference::Geometry& geometry, const reference::Ray& ray,
                                    reference::PrimitiveId primitive);

/// Bound on the error of the distance that lib/traversal.glsl finds, by counting its roundings. Triangles: as Pharr,
/// Jakob and Humphreys, "Physically Based Rendering", 3rd ed., 3.9.6. Spheres: from the discriminant and from c = f² −
/// r².
double distanceError(const reference::Geometry& geometry, const reference::Ray& ray, reference::PrimitiveId primitive);

}  // namespace antipode
