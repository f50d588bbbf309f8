// A scene of a chosen number of triangles: the inside of a rough, closed, star-shaped cave.
#pragma once

#include <cstdint>
#include <string>

#include "renderengine/scene.h"

namespace antipode::test {

/// Cells along a cube edge that give a little more than a million triangles (12·cells²).
constexpr uint32_t millionTriangleCells = 289;

/// A cube of cells² squares a face, blown up to the unit sphere and displaced by up to ±amplitude (in [0, 1)) of its
/// radius by fractal value noise, which is the same on every machine. Closed to the bit: faces share their vertices.
/// The front faces the centre, which sees every point. Material 0.
Mesh caveMesh(uint32_t cells, double amplitude);

/// The cave with grey walls, lit by a point light above its centre, seen from the centre.
Scene caveScene(uint32_t cells);

/// Writes a mesh's positions and triangles as a binary PLY file.
void writePly(const std::string& path, const Mesh& mesh);

}  // namespace antipode::test
