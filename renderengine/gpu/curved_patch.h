// A smooth triangle as a curved patch, and the triangles that show it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderengine/vec.h"

namespace antipode {

/// A cubic Bézier curve between two vertices, and into how many parts it is cut: a power of two, 1 for a straight edge.
struct CurvedEdge {
    std::array<Vec3d, 4> controls;
    uint32_t parts = 1;

    /// At j/parts of the way. All triangles at the edge get the same bits.
    Vec3d point(uint32_t j) const;
};

/// Curved PN triangles (Vlachos, Peters, Boyd and Mitchell 2001): a cubic patch between three curves.
/// Edges lie from corner 0 to 1, 0 to 2 and 1 to 2.
class CurvedPatch {
public:
    static constexpr uint32_t mostParts = 16;

    CurvedPatch(const std::array<Vec3d, 3>& corners, const std::array<Vec3d, 3>& normals,
                const std::array<CurvedEdge, 3>& edges);

    struct Vertex {
        std::array<double, 3> weights;  ///< of the corners
        Vec3d position, normal;         ///< the normal of unit length
    };
    struct Triangles {
        std::vector<Vertex> vertices;                    ///< the three corners first
        std::vector<std::array<uint32_t, 3>> triangles;  ///< turning as the corners do
    };
    Triangles triangles() const;

private:
    Vertex vertexAt(uint32_t i, uint32_t j) const;

    std::array<Vec3d, 3> corners_, normals_, middleNormals_;
    std::array<CurvedEdge, 3> edges_;
    Vec3d middle_;
    uint32_t parts_;
};

/// How many triangles a patch is cut into whose edges are cut into so many parts.
uint64_t patchTriangles(const std::array<uint32_t, 3>& parts);

}  // namespace antipode
