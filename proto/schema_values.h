// The small values of the schema (vectors, directions, angles, maps) to and from the engine's.
#pragma once

#include <google/protobuf/repeated_field.h>

#include <optional>
#include <string>

#include "proto/scene.pb.h"
#include "renderengine/vec.h"
#include "scene/affine.h"

namespace antipode {

using FloatList = google::protobuf::RepeatedField<float>;

/// Throws Error(Input): "`where` `what`".
[[noreturn]] void failAt(const std::string& where, const std::string& what);

/// Three numbers, or `otherwise` for an empty list; an empty list without `otherwise` and any other length throw
/// Error(Input) naming the field `where`.
Vec3f readVec3(const FloatList& list, const std::string& where, std::optional<Vec3f> otherwise = {});

/// One that is unit to float precision keeps every bit. Throws Error(Input) for zero.
Vec3f unitVector(const Vec3f& v, const std::string& where);
Vec3f readDirection(const FloatList& list, const std::string& where);

/// Throws Error(Input) for a list of the wrong length, a zero axis and a scale that is zero.
Affine readTransform(const schema::Transform& transform, const std::string& where);

/// Float → double degrees → float gives the same float back: the double's roundings are 2^29 times finer.
double toDegrees(float radians);
float toRadians(double degrees);

}  // namespace antipode
