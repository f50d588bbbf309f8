#include "gpu/body_contact.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include "scene/mesh_fronts.h"
#include "scene/bounds.h"

namespace antipode {
namespace {

using Triangle = std::array<Vec3d, 3>;

Triangle triangleOf(const Mesh& mesh, size_t i) {
    const auto& t = mesh.triangles[i];
    return {Vec3d(mesh.positions[t[0]]), Vec3d(mesh.positions[t[1]]), Vec3d(mesh.positions[t[2]])};
}

Bounds3d boxOf(const Triangle& t) {
    Bounds3d box;
    for (const Vec3d& p : t) box.add(p);
    return box;
}

bool holds(const Bounds3d& outer, const Bounds3d& inner, double slack) {
    for (int axis = 0; axis < 3; ++axis)
        if (inner.lower[axis] < outer.lower[axis] - slack || inner.upper[axis] > outer.upper[axis] + slack)
            return false;
    return true;
}

/// Whether the boxes reach into each other by more than the slack along every axis on which neither is flat.
bool overlap(const Bounds3d& a, const Bounds3d& b, double slack) {
    for (int axis = 0; axis < 3; ++axis) {
        const double depth = std::min(a.upper[axis], b.upper[axis]) - std::max(a.lower[axis], b.lower[axis]);
        const bool flat = std::min(a.size()[axis], b.size()[axis]) <= 2 * slack;
        if (depth < -slack || (!flat && depth <= slack)) return false;
    }
    return true;
}

/// Boxes of the mesh's triangles that reach into the region, by their lower x.
std::vector<Bounds3d> boxesIn(const Mesh& mesh, const Bounds3d& region, double slack) {
    std::vector<Bounds3d> boxes;
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Bounds3d box = boxOf(triangleOf(mesh, i));
        if (boxesMeet(box, region, slack)) boxes.push_back(box);
    }
    std::ranges::sort(boxes, {}, [](const Bounds3d& b) { return b.lower.x; });
    return boxes;
}

bool anyMeet(const std::vector<Bounds3d>& a, const std::vector<Bounds3d>& b, double slack) {
    size_t first = 0;
    double widest = 0;
    for (const Bounds3d& box : b) widest = std::max(widest, box.size().x);
    for (const Bounds3d& box : a) {
        while (first < b.size() && b[first].lower.x + widest + slack < box.lower.x) ++first;
        for (size_t i = first; i < b.size() && b[i].lower.x <= box.upper.x + slack; ++i)
            if (boxesMeet(box, b[i], slack)) return true;
    }
    return false;
}

/// Parity of what a ray from the point crosses; its direction meets no edge of what people build.
bool isInside(const Mesh& mesh, const Vec3d& point) {
    const Vec3d direction{0.5773, 0.6181, 0.5332};
    bool inside = false;
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto [p0, p1, p2] = triangleOf(mesh, i);
        const Vec3d e1 = p1 - p0, e2 = p2 - p0, h = cross(direction, e2), s = point - p0, q = cross(s, e1);
        const double determinant = dot(e1, h);
        if (determinant == 0) continue;
        const double u = dot(s, h) / determinant, v = dot(direction, q) / determinant;
        if (u >= 0 && v >= 0 && u + v <= 1 && dot(e2, q) / determinant > 0) inside = !inside;
    }
    return inside;
}

/// Square of the distance between a point and a triangle (Ericson, "Real-Time Collision Detection", 2005, 5.1.5).
double squaredDistance(const Vec3d& p, const Triangle& t) {
    const Vec3d ab = t[1] - t[0], ac = t[2] - t[0], n = cross(ab, ac);
    const auto toSegment = [&](const Vec3d& a, const Vec3d& b) {
        const Vec3d d = b - a;
        const double length2 = dot(d, d);
        const Vec3d off = p - a - d * (length2 > 0 ? std::clamp(dot(p - a, d) / length2, 0.0, 1.0) : 0.0);
        return dot(off, off);
    };
    const double edges = std::min({toSegment(t[0], t[1]), toSegment(t[1], t[2]), toSegment(t[2], t[0])});
    const double n2 = dot(n, n);
    if (n2 == 0) return edges;
    const double v = dot(cross(p - t[0], ac), n) / n2, w = dot(cross(ab, p - t[0]), n) / n2;
    const double height = dot(p - t[0], n);
    return v >= 0 && w >= 0 && v + w <= 1 ? height * height / n2 : edges;
}

bool meet(const Sphere& a, const Sphere& b, double slack) {
    return length(Vec3d(a.center) - Vec3d(b.center)) <= double(a.radius) + double(b.radius) + slack;
}

bool meet(const Mesh& mesh, const Sphere& sphere, double slack) {
    const double reach = double(sphere.radius) + slack;
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
        if (squaredDistance(Vec3d(sphere.center), triangleOf(mesh, i)) <= reach * reach) return true;
    return isInside(mesh, Vec3d(sphere.center));
}

bool meet(const Mesh& a, const Mesh& b, double slack) {
    const Bounds3d boundsA = boundsOf(a), boundsB = boundsOf(b);
    const std::vector<Bounds3d> inA = boxesIn(a, boundsB, slack), inB = boxesIn(b, boundsA, slack);
    if (anyMeet(inA, inB, slack)) return true;
    // Apart, or one within the other: its first vertex tells.
    const auto first = [](const Mesh& m) { return Vec3d(m.positions[m.triangles[0][0]]); };
    return (holds(boundsA, boundsB, slack) && isInside(a, first(b))) ||
           (holds(boundsB, boundsA, slack) && isInside(b, first(a)));
}

Bounds3d boundsOfSurface(const BodySurface& s) {
    return std::visit([](const auto* surface) { return boundsOf(*surface); }, s);
}

/// A triangle's plane, n·x = offset, with n unit and of positive first non-zero component.
struct Plane {
    Vec3d normal;
    double offset;
    Bounds3d box;
};

std::vector<Plane> planesOf(const Mesh& mesh, const Bounds3d& region, double slack) {
    std::vector<Plane> planes;
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle t = triangleOf(mesh, i);
        const Bounds3d box = boxOf(t);
        Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
        const double size = length(n);
        if (size == 0 || !boxesMeet(box, region, slack)) continue;
        const double first = n.x != 0 ? n.x : n.y != 0 ? n.y : n.z;
        n = n / (first < 0 ? -size : size);
        planes.push_back({n, dot(n, t[0]), box});
    }
    std::ranges::sort(planes, {}, &Plane::offset);
    return planes;
}

}  // namespace

double contactSlack(const Bounds3d& a, const Bounds3d& b) { return 0x1p-16 * std::max(a.radius(), b.radius()); }

bool boxesMeet(const Bounds3d& a, const Bounds3d& b, double slack) {
    for (int axis = 0; axis < 3; ++axis)
        if (a.lower[axis] > b.upper[axis] + slack || b.lower[axis] > a.upper[axis] + slack) return false;
    return true;
}

bool bodiesMeet(const BodySurface& a, const BodySurface& b) {
    const Bounds3d boundsA = boundsOfSurface(a), boundsB = boundsOfSurface(b);
    const double slack = contactSlack(boundsA, boundsB);
    if (!boxesMeet(boundsA, boundsB, slack)) return false;
    const auto *meshA = std::get_if<const Mesh*>(&a), *meshB = std::get_if<const Mesh*>(&b);
    if (meshA && meshB) return meet(**meshA, **meshB, slack);
    if (meshA) return meet(**meshA, *std::get<const Sphere*>(b), slack);
    if (meshB) return meet(**meshB, *std::get<const Sphere*>(a), slack);
    return meet(*std::get<const Sphere*>(a), *std::get<const Sphere*>(b), slack);
}

bool sharesPlane(const Mesh& a, const Mesh& b) {
    const Bounds3d boundsA = boundsOf(a), boundsB = boundsOf(b);
    const double slack = 0x1p-16 * boundsA.radius();
    if (!boxesMeet(boundsA, boundsB, slack)) return false;
    const std::vector<Plane> planesA = planesOf(a, boundsB, slack), planesB = planesOf(b, boundsA, slack);
    size_t first = 0;
    for (const Plane& p : planesA) {
        while (first < planesB.size() && planesB[first].offset < p.offset - slack) ++first;
        for (size_t i = first; i < planesB.size() && planesB[i].offset <= p.offset + slack; ++i)
            if (dot(p.normal, planesB[i].normal) > 1 - 1e-6 && overlap(p.box, planesB[i].box, slack)) return true;
    }
    return false;
}

}  // namespace antipode
