// Whether closed surfaces touch, hold or overlap each other: conservative tests of geometry, on the host and in double.
#pragma once

#include <variant>

#include "numerics/bounds.h"
#include "renderengine/scene.h"

namespace antipode {

/// A mesh or a sphere that bounds a volume.
using BodySurface = std::variant<const Mesh*, const Sphere*>;

/// Distances below it count as contact between surfaces of these bounds.
double contactSlack(const Bounds3d& a, const Bounds3d& b);

bool boxesMeet(const Bounds3d& a, const Bounds3d& b, double slack);

/// Whether the closed surfaces touch, overlap, or one holds the other. Never false where they do; true also for some
/// that come very near.
bool bodiesMeet(const BodySurface& a, const BodySurface& b);

/// Whether triangles of both meshes lie in one plane and reach into each other's bounds there: water that fills a cup
/// of something opaque, glass that stands on a table.
bool sharesPlane(const Mesh& a, const Mesh& b);

}  // namespace antipode
