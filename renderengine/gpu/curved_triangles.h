// Coarse smooth triangles as the curved surface that their vertex normals tell of.
#pragma once

#include <cstdint>
#include <optional>

#include "renderengine/scene.h"

namespace antipode {

/// The scene with smooth triangles cut into smaller ones on curved PN patches, where the normals at an edge's ends
/// differ from its facets by more than 3°: a facet that faces away from a lamp to which its vertex normals point is
/// black from both sides (the shadow terminator), and there is no such facet on a curved surface. Edges that two
/// triangles share are curved, along the crease where their normals differ; borders stay straight, as do triangles
/// without normals, of emitters (their area is their power), with a normal map (made for the facets), with vertex
/// normals more than 60° off, and of transparent bodies in contact and what they touch. Adds at most
/// greatestCurvedTriangles(): for that the angle is doubled as often as needed. Nothing where nothing is coarse.
std::optional<Scene> curvedScene(const Scene& scene);

/// By how many triangles a scene of so many can grow.
uint64_t greatestCurvedTriangles(uint64_t triangles);

}  // namespace antipode
