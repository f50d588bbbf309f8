// Which classes of light paths can carry light in a scene, and which of them a choice of techniques leaves out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderengine/scene.h"
#include "renderengine/settings.h"

namespace antipode {

/// What decides it, of the lights and surfaces that a scene uses. What could be so is taken to be so: textures and
/// positions are not looked at.
struct LightPathFacts {
    bool sizedLamps = false;     ///< emitting surfaces and skies: paths can meet them
    bool sizelessLamps = false;  ///< points, spots and suns: paths can start there or be aimed at them, never meet them
    bool scattering = false;     ///< surfaces with a density over directions, however narrow
    bool specular = false;       ///< surfaces, or parts of them, that send light one way: mirrors, smooth glass, panes
    bool media = false;          ///< bodies that scatter light inside

    bool operator==(const LightPathFacts&) const = default;
};

/// Takes time in proportion to the number of objects. Needs meshes and spheres whose materials exist.
LightPathFacts lightPathFacts(const Scene& scene);

/// Light paths alike in which techniques can make them, for all techniques of the table. In Heckbert's letters, the way
/// light goes: from a lamp L over scattering (D) and specular (S) surfaces to the camera E. Points in media that
/// scatter (M) are like D but for merging, which takes a surface: where there is a D, the path's M are written D.
struct PathClass {
    bool sizeless = false;       ///< from a lamp without size
    bool scattered = true;       ///< there is a D or an M; otherwise the members below say nothing
    bool specularStart = false;  ///< an S next to the lamp: caustics
    bool specularEnd = false;    ///< an S next to the camera: what is seen in mirrors and through glass
    bool adjacent = false;       ///< somewhere a D or M next to another
    bool mediaAlone = false;     ///< there is no D

    bool operator==(const PathClass&) const = default;
    /// Of the shortest path in the class.
    uint32_t fewestEdges() const;
    /// "LS+DS+E", "LME"
    std::string expression() const;
    /// "caustics of points, spots and suns, seen in mirrors or through glass"
    std::string words() const;
};

/// The classes that can carry light, with paths of at most so many edges.
std::vector<PathClass> pathClasses(const LightPathFacts& facts, std::optional<uint32_t> maxPathLength);

/// Those of them that nothing in the settings' technique, less what is to be left out, can make: they are missing from
/// the image. Throws Error(Usage) as checkSettings(). `settings` are resolved, and not for a single technique.
std::vector<PathClass> missingClasses(const LightPathFacts& facts, const RenderSettings& settings);

/// "caustics of points, spots and suns (LS+DE, LS+D…DE); …": classes of the same words together.
std::string described(const std::vector<PathClass>& classes);

}  // namespace antipode
