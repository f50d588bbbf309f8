#include "proto/schema_values.h"

#include <cmath>
#include <numbers>

#include "renderengine/error.h"

namespace antipode {

void failAt(const std::string& where, const std::string& what) { throw Error(ErrorCode::Input, where + " " + what); }

Vec3f readVec3(const FloatList& list, const std::string& where, std::optional<Vec3f> otherwise) {
    if (list.empty() && otherwise) return *otherwise;
    if (list.size() != 3) failAt(where, "needs three numbers, not " + std::to_string(list.size()));
    return {list[0], list[1], list[2]};
}

Vec3f unitVector(const Vec3f& v, const std::string& where) {
    const double squared = dot(Vec3d(v), Vec3d(v));
    if (!(squared > 0) || !std::isfinite(squared)) failAt(where, "must be a finite vector other than zero");
    // Three roundings of unit components move the square by no more than this.
    return std::abs(squared - 1) <= 4e-7 ? v : Vec3f(Vec3d(v) / std::sqrt(squared));
}

Vec3f readDirection(const FloatList& list, const std::string& where) {
    return unitVector(readVec3(list, where), where);
}

Affine readTransform(const schema::Transform& transform, const std::string& where) {
    Affine map;
    if (transform.scale_size() == 1) {
        const double s = transform.scale(0);
        map = {{s, 0, 0}, {0, s, 0}, {0, 0, s}, {}};
    } else if (transform.scale_size() > 0) {
        const Vec3d s(readVec3(transform.scale(), where + ".scale"));
        map = {{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, {}};
    }
    if (map.determinant() == 0 || !std::isfinite(map.determinant()))
        failAt(where + ".scale", "must be finite and not zero");
    for (const schema::Rotation& turn : transform.rotate()) {
        if (!std::isfinite(turn.degrees())) failAt(where + ".rotate.degrees", "must be finite");
        const Vec3d axis = normalize(Vec3d(readDirection(turn.axis(), where + ".rotate.axis")));
        map = rotation(axis, turn.degrees() * std::numbers::pi / 180) * map;
    }
    map.offset = Vec3d(readVec3(transform.translate(), where + ".translate", Vec3f{}));
    if (!isFinite(Vec3f(map.offset))) failAt(where + ".translate", "must be finite");
    return map;
}

double toDegrees(float radians) { return double(radians) * 180 / std::numbers::pi; }
float toRadians(double degrees) { return float(degrees * std::numbers::pi / 180); }

}  // namespace antipode
