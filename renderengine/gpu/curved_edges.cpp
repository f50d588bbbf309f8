#include "gpu/curved_edges.h"

#include <bit>
#include <cmath>
#include <tuple>

namespace antipode {
namespace {

/// Cosine up to which normals are one, whichever way they point: 2½°. Exporters round them apart at seams.
constexpr double sameNormal = 0.999;

bool same(const Vec3d& a, const Vec3d& b) { return std::abs(dot(a, b)) > sameNormal; }

/// How the curve leaves an end towards the other one, `chord` away: in the surface's plane (Vlachos et al. 2001), and
/// where two surfaces meet in a crease along both.
Vec3d tangent(const Vec3d& chord, const Vec3d& n, const Vec3d& otherSide) {
    if (same(n, otherSide)) return chord - n * dot(chord, n);
    const Vec3d crease = normalize(cross(n, otherSide));
    return crease * dot(chord, crease);
}

}  // namespace

double bend(const Vec3d& p0, const Vec3d& p1, const Vec3d& n0, const Vec3d& n1) {
    const Vec3d along = normalize(p1 - p0);
    const double bend = 0.5 * length(n1 - n0);
    return std::max(std::abs(dot(along, n0)), std::abs(dot(along, n1))) <= greatestBend && bend <= greatestBend ? bend
                                                                                                                : 0;
}

uint32_t partsOf(double bend, double threshold) {
    uint32_t parts = 1;
    while (parts < CurvedPatch::mostParts && bend > threshold * parts) parts *= 2;
    return parts;
}

bool isBefore(const Vec3f& a, const Vec3f& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

CurvedEdges::Key CurvedEdges::keyOf(const Vec3f& a, const Vec3f& b) { return isBefore(a, b) ? Key{a, b} : Key{b, a}; }

size_t CurvedEdges::Hash::operator()(const Key& key) const {
    uint64_t h = 0xcbf29ce484222325u;
    for (const Vec3f& p : {key.first, key.second})
        for (int axis = 0; axis < 3; ++axis) {
            h = (h ^ std::bit_cast<uint32_t>(p[axis] + 0.0f)) * 0x9e3779b97f4a7c15u;  // −0 is 0
            h ^= h >> 29;
        }
    return size_t(h);
}

void CurvedEdges::want(const Vec3f& a, const Vec3f& b) { meetings_.try_emplace(keyOf(a, b)); }

void CurvedEdges::meet(const Vec3f& a, const Vec3f& b, const std::optional<Normals>& normals) {
    const auto found = meetings_.find(keyOf(a, b));
    if (found == meetings_.end()) return;
    Meeting& meeting = found->second;
    ++meeting.triangles;
    if (!normals) {
        meeting.straight = true;
        return;
    }
    const bool forward = isBefore(a, b);
    const Side side{Vec3d(forward ? normals->atA : normals->atB), Vec3d(forward ? normals->atB : normals->atA)};
    for (uint32_t i = 0; i < meeting.sideCount; ++i)
        if (same(side.first, meeting.sides[i].first) && same(side.second, meeting.sides[i].second)) return;
    if (meeting.sideCount == 2)
        meeting.straight = true;
    else
        meeting.sides[meeting.sideCount++] = side;
}

CurvedEdge CurvedEdges::edge(const Vec3f& a, const Vec3f& b, double threshold) const {
    const Key key = keyOf(a, b);
    const Vec3d p0(key.first), p1(key.second), chord = p1 - p0;
    CurvedEdge result{{p0, p0 + chord / 3.0, p1 - chord / 3.0, p1}, 1};
    const auto found = meetings_.find(key);
    if (found == meetings_.end()) return result;
    const Meeting& meeting = found->second;
    if (meeting.straight || meeting.triangles < 2) return result;
    const Side &one = meeting.sides[0], &other = meeting.sides[meeting.sideCount - 1];
    const Vec3d leaves = tangent(chord, one.first, other.first), arrives = tangent(chord, one.second, other.second);
    const double off = std::max(length(chord - leaves), length(chord - arrives)) / length(chord);
    if (!(off <= greatestBend)) return result;
    result.parts =
        partsOf(std::max(bend(p0, p1, one.first, one.second), bend(p0, p1, other.first, other.second)), threshold);
    if (result.parts > 1) result.controls = {p0, p0 + leaves / 3.0, p1 - arrives / 3.0, p1};
    return result;
}

}  // namespace antipode
