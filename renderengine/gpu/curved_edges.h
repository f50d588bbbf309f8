// Which edges of a scene's triangles are curves. An edge is decided by itself, from all triangles that meet in it, so
// that they agree to the bit and no crack opens.
#pragma once

#include <optional>
#include <unordered_map>

#include "gpu/curved_patch.h"
#include "renderengine/scene.h"

namespace antipode {

/// By how much a smooth edge bends: half the chord between the normals at its ends, sin θ/2 for an arc of angle θ, by
/// which its facets deviate from them. 0 where that is too much for a smooth surface.
double bend(const Vec3d& p0, const Vec3d& p1, const Vec3d& n0, const Vec3d& n1);

/// What bends more, or lies further off the planes across its normals, is no coarse smooth surface: the edges of a cube
/// with smooth normals have .577, those of an icosahedron .526.
constexpr double greatestBend = 0.55;
/// Edges that bend more are cut: 3°, arcs of 6°.
constexpr double leastBend = 0.0523;

/// The parts of an edge, each of which bends by at most `threshold`.
uint32_t partsOf(double bend, double threshold);

class CurvedEdges {
public:
    /// Asks for a curve between two vertices.
    void want(const Vec3f& a, const Vec3f& b);
    /// A triangle with these normals at the vertices meets in the edge. No normals: the edge has to be straight.
    /// Nothing where no curve was asked for.
    struct Normals {
        Vec3f atA, atB;
    };
    void meet(const Vec3f& a, const Vec3f& b, const std::optional<Normals>& normals);
    /// From the lesser end (x, then y, then z) to the other; straight unless a curve was asked for and makes sense.
    CurvedEdge edge(const Vec3f& a, const Vec3f& b, double threshold) const;

private:
    struct Key {
        Vec3f first, second;
        bool operator==(const Key&) const = default;
    };
    struct Hash {
        size_t operator()(const Key& key) const;
    };
    /// A side of the edge: triangles that agree in their normals.
    struct Side {
        Vec3d first, second;
    };
    struct Meeting {
        std::array<Side, 2> sides;
        uint32_t sideCount = 0, triangles = 0;
        bool straight = false;
    };
    static Key keyOf(const Vec3f& a, const Vec3f& b);

    std::unordered_map<Key, Meeting, Hash> meetings_;
};

/// Whether `a` is the lesser one: x, then y, then z.
bool isBefore(const Vec3f& a, const Vec3f& b);

}  // namespace antipode
