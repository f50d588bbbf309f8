#include "proto/schema_shapes.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "proto/schema_fields.h"
#include "proto/schema_values.h"

namespace antipode {
namespace {

/// Grids above this are taken for a typing error.
constexpr uint64_t kMaxGridCells = uint64_t(1) << 26;
/// Sines that a grid may take, which is a minute of them.
constexpr uint64_t kMaxGridTerms = uint64_t(1) << 30;

/// "mesh 'floor'", for messages.
template <class Shape>
std::string label(const char* kind, const Shape& shape) {
    return shape.name().empty() ? kind : std::string(kind) + " '" + shape.name() + "'";
}

void addQuadTriangles(Mesh& mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
}

}  // namespace

Mesh makeMesh(const schema::Mesh& from) {
    const std::string where = label("mesh", from);
    Mesh mesh;
    readFields(from, where, {}, mesh);
    if (from.has_transform()) transformMesh(mesh, readTransform(from.transform(), where + ": transform"));
    return mesh;
}

Mesh makeQuad(const schema::Quad& quad) {
    const std::string where = label("quad", quad);
    const Vec3f corner = readVec3(quad.corner(), where + ": corner");
    const Vec3f u = readVec3(quad.edge_u(), where + ": edge_u"), v = readVec3(quad.edge_v(), where + ": edge_v");
    Mesh mesh;
    mesh.name = quad.name();
    mesh.positions = {corner, corner + u, corner + u + v, corner + v};
    if (quad.uv_repeat_size() != 0 && quad.uv_repeat_size() != 2) failAt(where + ": uv_repeat", "needs two numbers");
    const float uEnd = quad.uv_repeat_size() ? quad.uv_repeat(0) : 1,
                vEnd = quad.uv_repeat_size() ? quad.uv_repeat(1) : 1;
    mesh.uvs = {{0, 0}, {uEnd, 0}, {uEnd, vEnd}, {0, vEnd}};
    addQuadTriangles(mesh, 0, 1, 2, 3);
    return mesh;
}

Mesh makeBox(const schema::Box& box) {
    const std::string where = label("box", box);
    const Vec3f low = readVec3(box.low(), where + ": low"), high = readVec3(box.high(), where + ": high");
    for (int axis = 0; axis < 3; ++axis)
        if (!(low[axis] < high[axis])) failAt(where + ":", "low must lie below high on every axis");
    Mesh mesh;
    mesh.name = box.name();
    // Corner i takes its x, y, z from `high` where bit 0, 1, 2 of i is set.
    for (int i = 0; i < 8; ++i)
        mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    addQuadTriangles(mesh, 0, 4, 6, 2);  // −x
    addQuadTriangles(mesh, 1, 3, 7, 5);  // +x
    addQuadTriangles(mesh, 0, 1, 5, 4);  // −y
    addQuadTriangles(mesh, 2, 6, 7, 3);  // +y
    addQuadTriangles(mesh, 0, 2, 3, 1);  // −z
    addQuadTriangles(mesh, 4, 5, 7, 6);  // +z
    if (box.inward())
        for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    if (box.has_transform()) transformMesh(mesh, readTransform(box.transform(), where + ": transform"));
    return mesh;
}

Mesh makeDisk(const schema::Disk& disk) {
    const std::string where = label("disk", disk);
    const Vec3d center(readVec3(disk.center(), where + ": center"));
    const Vec3d normal(readDirection(disk.normal(), where + ": normal"));
    const uint32_t segments = disk.has_segments() ? disk.segments() : 64;
    if (!(disk.radius() > 0)) failAt(where + ": radius", "must be positive");
    if (segments < 3 || segments > 65536) failAt(where + ": segments", "must lie in 3 … 65536");
    const Vec3d helper = std::abs(normal.x) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    const Vec3d u = normalize(cross(helper, normal)), v = cross(normal, u);
    Mesh mesh;
    mesh.name = disk.name();
    for (uint32_t i = 0; i < segments; ++i) {
        const double angle = 2 * std::numbers::pi * i / segments;
        mesh.positions.emplace_back(center + (u * std::cos(angle) + v * std::sin(angle)) * double(disk.radius()));
        mesh.triangles.push_back({segments, i, (i + 1) % segments});
    }
    mesh.positions.emplace_back(center);
    return mesh;
}

Mesh makeRippleGrid(const schema::RippleGrid& grid) {
    const std::string where = label("ripple_grid", grid);
    const Vec3d center(readVec3(grid.center(), where + ": center", Vec3f{}));
    if (!(grid.size_x() > 0 && grid.size_z() > 0)) failAt(where + ":", "size_x and size_z must be positive");
    if (grid.cells_x() == 0 || grid.cells_z() == 0 || uint64_t(grid.cells_x()) * grid.cells_z() > kMaxGridCells)
        failAt(where + ":", "cells_x and cells_z must be positive, their product at most 2^26");
    if (uint64_t(grid.cells_x()) * grid.cells_z() * uint64_t(grid.wave_size()) > kMaxGridTerms)
        failAt(where + ": wave", "is repeated too often for so many cells: cells times waves must not exceed 2^30");
    for (const schema::Wave& wave : grid.wave())
        if (!(wave.wavelength() > 0) || !std::isfinite(wave.wavelength()))
            failAt(where + ": wave.wavelength", "must be positive and finite");
    Mesh mesh;
    mesh.name = grid.name();
    for (uint32_t row = 0; row <= grid.cells_z(); ++row) {
        for (uint32_t column = 0; column <= grid.cells_x(); ++column) {
            const double s = double(column) / grid.cells_x(), t = double(row) / grid.cells_z();
            const double x = (s - 0.5) * grid.size_x(), z = (t - 0.5) * grid.size_z();
            double height = 0, slopeX = 0, slopeZ = 0;
            for (const schema::Wave& wave : grid.wave()) {
                const double direction = wave.direction() * std::numbers::pi / 180;
                const double k = 2 * std::numbers::pi / wave.wavelength();
                const double kx = k * std::cos(direction), kz = k * std::sin(direction);
                const double argument = kx * x + kz * z + wave.phase() * std::numbers::pi / 180;
                height += wave.amplitude() * std::sin(argument);
                slopeX += wave.amplitude() * kx * std::cos(argument);
                slopeZ += wave.amplitude() * kz * std::cos(argument);
            }
            mesh.positions.emplace_back(center + Vec3d(x, height, z));
            mesh.normals.emplace_back(normalize(Vec3d(-slopeX, 1, -slopeZ)));
            mesh.uvs.push_back({float(s), float(t)});
        }
    }
    const uint32_t stride = grid.cells_x() + 1;
    for (uint32_t row = 0; row < grid.cells_z(); ++row) {
        for (uint32_t column = 0; column < grid.cells_x(); ++column) {
            const uint32_t i = row * stride + column;
            addQuadTriangles(mesh, i, i + stride, i + stride + 1, i + 1);
        }
    }
    if (grid.has_transform()) transformMesh(mesh, readTransform(grid.transform(), where + ": transform"));
    return mesh;
}

}  // namespace antipode
