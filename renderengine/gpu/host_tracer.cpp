#include "gpu/host_tracer.h"

#include <bit>
#include <cmath>

#include "gpu/pack_materials.h"
#include "scene/units.h"

namespace antipode {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// More than three entries a level of the deepest tree that buildBvh makes.
constexpr size_t stackSize = 512;

/// Distances at which the ray enters and leaves the box; enters > leaves where it misses. A NaN, of a ray within a
/// face's plane, loses every comparison and so bounds nothing.
std::pair<double, double> clip(const std::array<float, 4>* node, uint32_t child, const Vec3d& origin,
                               const Vec3d& inverse) {
    double enters = 0, leaves = infinity;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (double(node[2 * axis][child]) - origin[axis]) * inverse[axis];
        const double b = (double(node[2 * axis + 1][child]) - origin[axis]) * inverse[axis];
        const double low = a < b ? a : b, high = a < b ? b : a;
        if (low > enters) enters = low;
        if (high < leaves) leaves = high;
    }
    return {enters, leaves * (1 + 0x1p-50)};
}

}  // namespace

HostTracer::HostTracer(const Scene& scene) : scene_(scene), unit_(std::ldexp(1.0, unitExponent(scene))) {
    const auto inUnits = [&](const Vec3f& p) { return p * float(unit_); };  // rounds nothing
    std::vector<Bounds3f> triangleBoxes, sphereBoxes;
    for (uint32_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        if (isHole(scene.materials[mesh.material])) continue;
        for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            Bounds3f box;
            for (const uint32_t i : mesh.triangles[t]) box.add(inUnits(mesh.positions[i]));
            triangles_.push_back({m, t});
            triangleBoxes.push_back(padded(box));
        }
    }
    for (uint32_t i = 0; i < scene.spheres.size(); ++i) {
        const Sphere& s = scene.spheres[i];
        if (isHole(scene.materials[s.material])) continue;
        const Vec3f center = inUnits(s.center), reach(s.radius * float(unit_));
        spheres_.push_back(i);
        sphereBoxes.push_back(padded({center - reach, center + reach}));
    }
    bvh_ = buildBvh(triangleBoxes, sphereBoxes);
}

std::optional<HostTracer::Hit> HostTracer::closest(const Vec3d& origin, const Vec3d& direction,
                                                   std::optional<uint32_t> left) const {
    const Vec3d inverse{1 / direction.x, 1 / direction.y, 1 / direction.z};
    struct Entry {
        uint32_t reference;
        double enters;
    };
    std::array<Entry, stackSize> stack;
    size_t size = 0;
    stack[size++] = {0, 0};
    double nearest = infinity;
    uint32_t surface = 0;
    while (size > 0) {
        const Entry entry = stack[--size];
        if (entry.enters > nearest) continue;
        if (entry.reference >> 31) {
            const uint32_t first = entry.reference & ((1u << 27) - 1), count = ((entry.reference >> 27) & 7) + 1;
            for (uint32_t i = first; i < first + count; ++i) {
                const uint32_t id = bvh_.primitiveOrder[i];
                const auto distance = distanceTo(id, origin, direction, left);
                if (distance && (*distance < nearest || (*distance == nearest && id < surface)))
                    nearest = *distance, surface = id;
            }
            continue;
        }
        const std::array<float, 4>* node = &bvh_.nodes[size_t(entry.reference) * Bvh::texelsPerNode];
        const size_t before = size;
        for (uint32_t child = 0; child < 4; ++child) {
            const uint32_t reference = std::bit_cast<uint32_t>(node[6][child]);
            if (reference == Bvh::emptyReference) continue;
            const auto [enters, leaves] = clip(node, child, origin, inverse);
            if (enters > leaves || enters > nearest) continue;
            // The nearest child comes last and is taken first.
            size_t place = size++;
            for (; place > before && stack[place - 1].enters < enters; --place) stack[place] = stack[place - 1];
            stack[place] = {reference, enters};
        }
    }
    if (nearest == infinity) return {};
    return describe(surface, nearest, origin + direction * nearest);
}

std::array<Vec3d, 3> HostTracer::verticesOf(const Triangle& t) const {
    const Mesh& mesh = scene_.meshes[t.mesh];
    const auto& corners = mesh.triangles[t.triangle];
    return {Vec3d(mesh.positions[corners[0]]) * unit_, Vec3d(mesh.positions[corners[1]]) * unit_,
            Vec3d(mesh.positions[corners[2]]) * unit_};
}

/// Möller & Trumbore 1997 for triangles.
std::optional<double> HostTracer::distanceTo(uint32_t surface, const Vec3d& origin, const Vec3d& direction,
                                             std::optional<uint32_t> left) const {
    if (surface < triangles_.size()) {
        if (left == surface) return {};
        const auto [p0, p1, p2] = verticesOf(triangles_[surface]);
        const Vec3d edge1 = p1 - p0, edge2 = p2 - p0, p = cross(direction, edge2);
        const double determinant = dot(edge1, p);
        if (determinant == 0) return {};
        const Vec3d fromVertex = origin - p0;
        const double u = dot(fromVertex, p) / determinant;
        if (!(u >= 0 && u <= 1)) return {};
        const Vec3d q = cross(fromVertex, edge1);
        const double v = dot(direction, q) / determinant;
        if (!(v >= 0 && u + v <= 1)) return {};
        const double distance = dot(edge2, q) / determinant;
        return distance > 0 ? std::optional(distance) : std::nullopt;
    }
    const Sphere& s = scene_.spheres[spheres_[surface - triangles_.size()]];
    const Vec3d toOrigin = origin - Vec3d(s.center) * unit_;
    const double radius = double(s.radius) * unit_, b = dot(toOrigin, direction);
    // A ray that leaves the sphere meets it again at −2b, inside; outside it does not.
    if (left == surface) return b < 0 ? std::optional(-2 * b) : std::nullopt;
    const Vec3d off = toOrigin - direction * b;
    const double discriminant = radius * radius - dot(off, off);
    if (discriminant < 0) return {};
    const double root = std::sqrt(discriminant), distance = -b - root > 0 ? -b - root : -b + root;
    return distance > 0 ? std::optional(distance) : std::nullopt;
}

HostTracer::Hit HostTracer::describe(uint32_t surface, double distance, const Vec3d& point) const {
    if (surface < triangles_.size()) {
        const auto [p0, p1, p2] = verticesOf(triangles_[surface]);
        return {distance, surface, scene_.meshes[triangles_[surface].mesh].material,
                normalize(cross(p1 - p0, p2 - p0))};
    }
    const Sphere& s = scene_.spheres[spheres_[surface - triangles_.size()]];
    return {distance, surface, s.material, normalize(point - Vec3d(s.center) * unit_)};
}

}  // namespace antipode
