// The kernels' arithmetic: float, or double where ANTIPODE_DOUBLE is defined. Literals are floats either way: what a
// float does not hold exactly must be written as a quotient of `real` numbers or here.
#ifndef ANTIPODE_REAL_ARITHMETIC
#define ANTIPODE_REAL_ARITHMETIC

#ifdef ANTIPODE_DOUBLE
#define real double
#define real2 dvec2
#define real3 dvec3
#define real4 dvec4
const real PI = 3.14159265358979323846lf;
const real UNIT_ROUNDOFF = 1.1102230246251565404e-16lf;  // 2^-53
#else
#define real float
#define real2 vec2
#define real3 vec3
#define real4 vec4
const real PI = 3.14159265358979323846;
const real UNIT_ROUNDOFF = 5.9604645e-8;  // 2^-24
#endif

const real INFINITE_DISTANCE = 1e29;  // beyond any scene in its own units, before the boxes of empty BVH slots (1e30)

/// Higham's bound on the relative error of n rounded operations.
real errorGamma(real n) { return n * UNIT_ROUNDOFF / (1.0 - n * UNIT_ROUNDOFF); }

/// The next number away from zero or towards it, as the signs of `value` and `step_` say, per component; in double the
/// next or the one after.
real3 nudge(real3 value, real3 step_) {
    bvec3 away = equal(greaterThan(value, real3(0.0)), greaterThan(step_, real3(0.0)));
#ifdef ANTIPODE_DOUBLE
    real3 moved = value * mix(real3(1.0 - 2.0 * UNIT_ROUNDOFF), real3(1.0 + 2.0 * UNIT_ROUNDOFF), away);
#else
    real3 moved = intBitsToFloat(floatBitsToInt(value) + mix(ivec3(-1), ivec3(1), away));
#endif
    bvec3 still =
        bvec3(value.x == 0.0 || step_.x == 0.0, value.y == 0.0 || step_.y == 0.0, value.z == 0.0 || step_.z == 0.0);
    return mix(moved, value, still);
}
#endif
