// The reference lights: every emitting triangle and sphere, point, spot and directional lights, the constant
// environment. Each states the densities of vcm.md's light table, without the probability of picking this light:
//   pdfEmit    a light path starts here in this direction: area × solid angle (delta positions: solid angle; infinite
//              lights: solid angle × area of the disk that faces the scene, of its bounding radius)
//   pdfDirect  next event picks this point: per area; 1 for delta lights; per solid angle for the environment
#pragma once

#include <optional>
#include <vector>

#include "support/random.h"
#include "support/reference/geometry.h"

namespace antipode::reference {

enum class LightKind { Triangle, Sphere, Point, Spot, Directional, Environment };

/// Where on a light a path starts. Finite lights use position (and normal); infinite ones only the direction.
struct LightPoint {
    Vec3d position;
    Vec3d normal;              ///< unit; of area lights
    Vec3d directionFromLight;  ///< unit; the way the light travels
};

struct Light {
    LightKind kind = LightKind::Point;
    Vec3d emission{};       ///< radiance, W/sr intensity (point, spot) or irradiance (directional)
    bool twoSided = false;  ///< area lights: emits at the back too
    PrimitiveId primitive = kNoPrimitive;
    TrianglePrimitive triangle{};
    SpherePrimitive sphere{};
    Vec3d position{}, direction{};  ///< point and spot; spot and directional: the way the light shines
    double cosInner = 1, cosOuter = 0;
    double sceneRadius = 1;  ///< infinite lights: radius of the scene's bounding sphere

    bool isDelta() const;  ///< cannot be hit by a scattered ray
    bool isInfinite() const { return kind == LightKind::Directional || kind == LightKind::Environment; }
    double area() const;   ///< of area lights
    double power() const;  ///< largest channel, W; decides how often the light is picked
};

/// Radiance (area, environment), intensity (point, spot) or irradiance (directional) that leaves in the direction.
Vec3d emitted(const Light& light, const LightPoint& point);
/// |cosine| at the light's surface; 1 where there is none.
double cosineAtLight(const Light& light, const LightPoint& point);
double pdfEmit(const Light& light, const LightPoint& point);
double pdfDirect(const Light& light, const LightPoint& point);

/// A uniform point on a finite light, or a direction of an infinite one; leaves directionFromLight of finite ones
/// unset.
LightPoint sampleLightPoint(const Light& light, Random& random);

/// A light as seen from a receiver.
struct DirectSample {
    Vec3d wi;             ///< unit, towards the light
    double distance = 0;  ///< infinite for infinite lights
    Vec3d weight;         ///< incoming radiance/pdf (delta lights: irradiance on a plane that faces the light)
    double pdf = 0;       ///< per solid angle at the receiver; 0 for delta lights; light picking not included
};
/// Empty where the light does not shine on the receiver.
std::optional<DirectSample> sampleDirect(const Light& light, const Vec3d& receiver, Random& random);

/// All lights of a scene, picked with probability ∝ power.
class LightSet {
public:
    /// Throws Error(Usage) for an environment map or where nothing emits.
    LightSet(const Scene& scene, const Geometry& geometry);
    const std::vector<Light>& lights() const { return lights_; }
    double pickProbability(size_t index) const { return pick_[index]; }
    size_t pick(Random& random) const;
    /// Index of the light that is this primitive.
    std::optional<size_t> ofPrimitive(PrimitiveId primitive) const;
    std::optional<size_t> environment() const;

private:
    std::vector<Light> lights_;
    std::vector<double> pick_;
};

}  // namespace antipode::reference
