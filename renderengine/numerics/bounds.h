// Axis-aligned boxes around points.
#pragma once

#include <limits>

#include "renderengine/vec.h"

namespace antipode {

/// The box from `lower` to `upper`; a flat one, or a point, is fine. Holds nothing until something is added.
template <class T>
struct Bounds3 {
    Vec3<T> lower{std::numeric_limits<T>::infinity()}, upper{-std::numeric_limits<T>::infinity()};

    /// Coordinates that are NaN are passed over.
    constexpr void add(const Vec3<T>& p) {
        for (int axis = 0; axis < 3; ++axis) {
            lower[axis] = std::min(lower[axis], p[axis]);
            upper[axis] = std::max(upper[axis], p[axis]);
        }
    }
    constexpr void add(const Bounds3& other) {
        for (int axis = 0; axis < 3; ++axis) {
            lower[axis] = std::min(lower[axis], other.lower[axis]);
            upper[axis] = std::max(upper[axis], other.upper[axis]);
        }
    }
    constexpr bool isEmpty() const { return !(lower.x <= upper.x); }
    constexpr Vec3<T> size() const { return upper - lower; }
    /// Halved before the sum, which could overflow.
    constexpr Vec3<T> center() const { return lower * T(0.5) + upper * T(0.5); }
    /// Of the sphere about the centre that holds the box.
    double radius() const { return 0.5 * length(Vec3d(upper) - Vec3d(lower)); }
};

using Bounds3f = Bounds3<float>;
using Bounds3d = Bounds3<double>;

}  // namespace antipode
