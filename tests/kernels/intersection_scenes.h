// Triangles and spheres to trace rays against.
#pragma once

#include "renderengine/scene.h"
#include "support/random.h"

namespace antipode {

/// An empty scene of one white material.
Scene emptyScene();
/// Adds one triangle of material 0.
void addTriangle(Scene& scene, const Vec3f& a, const Vec3f& b, const Vec3f& c);
/// `triangles` and `spheres` of sizes from 10⁻³ to 1 in the cube [-1, 1]³.
Scene randomSoup(uint32_t triangles, uint32_t spheres, Random& random);
/// A closed mesh: an icosahedron, each face cut into 4^levels, with every vertex moved to a random distance from
/// `center` between (1 − roughness)·radius and radius. Star-shaped, so that every ray from the centre meets it once.
Scene closedMesh(uint32_t levels, const Vec3f& center, float radius, float roughness, Random& random);
/// The scene with every coordinate multiplied by `factor`.
Scene scaled(Scene scene, float factor);
/// The scene moved.
Scene moved(Scene scene, const Vec3f& offset);

/// Uniform on the unit sphere.
Vec3d randomDirection(Random& random);

}  // namespace antipode
