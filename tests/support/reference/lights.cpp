#include "support/reference/lights.h"

#include <algorithm>
#include <cmath>

#include "renderengine/error.h"

namespace antipode::reference {
namespace {

Vec3d uniformDirection(Random& random) {
    const double z = random.uniform(-1, 1), r = std::sqrt(1 - z * z), phi = 2 * kPi * random.uniform();
    return {r * std::cos(phi), r * std::sin(phi), z};
}

bool emitsTowards(const Light& light, const LightPoint& point) {
    return light.twoSided || dot(point.normal, point.directionFromLight) > 0;
}

double spotFalloff(const Light& light, double cosine) {
    if (cosine >= light.cosInner) return 1;
    const double t = std::clamp((cosine - light.cosOuter) / (light.cosInner - light.cosOuter), 0.0, 1.0);
    return t * t;
}

}  // namespace

bool Light::isDelta() const {
    return kind == LightKind::Point || kind == LightKind::Spot || kind == LightKind::Directional;
}

double Light::area() const {
    return kind == LightKind::Triangle ? triangle.area() : 4 * kPi * sphere.radius * sphere.radius;
}

double Light::power() const {
    const double e = maxComponent(emission), disk = kPi * sceneRadius * sceneRadius;
    switch (kind) {
        case LightKind::Point: return 4 * kPi * e;
        case LightKind::Spot: return 2 * kPi * (1 - cosOuter) * e;
        case LightKind::Directional: return disk * e;
        case LightKind::Environment: return 4 * kPi * disk * e;
        default: return kPi * area() * (twoSided ? 2 : 1) * e;
    }
}

Vec3d emitted(const Light& light, const LightPoint& point) {
    switch (light.kind) {
        case LightKind::Triangle:
        case LightKind::Sphere: return emitsTowards(light, point) ? light.emission : Vec3d();
        case LightKind::Spot:
            return light.emission * spotFalloff(light, dot(light.direction, point.directionFromLight));
        default: return light.emission;
    }
}

double cosineAtLight(const Light& light, const LightPoint& point) {
    const bool surface = light.kind == LightKind::Triangle || light.kind == LightKind::Sphere;
    return surface ? std::abs(dot(point.normal, point.directionFromLight)) : 1;
}

double pdfEmit(const Light& light, const LightPoint& point) {
    const double disk = kPi * light.sceneRadius * light.sceneRadius;
    switch (light.kind) {
        case LightKind::Point: return 1 / (4 * kPi);
        case LightKind::Spot:
            return dot(light.direction, point.directionFromLight) > light.cosOuter
                       ? 1 / (2 * kPi * (1 - light.cosOuter))
                       : 0;
        case LightKind::Directional: return 1 / disk;
        case LightKind::Environment: return 1 / (4 * kPi) / disk;
        default:
            if (!emitsTowards(light, point)) return 0;
            return cosineAtLight(light, point) / (kPi * light.area() * (light.twoSided ? 2 : 1));
    }
}

double pdfDirect(const Light& light, const LightPoint&) {
    switch (light.kind) {
        case LightKind::Triangle:
        case LightKind::Sphere: return 1 / light.area();
        case LightKind::Environment: return 1 / (4 * kPi);
        default: return 1;
    }
}

LightPoint sampleLightPoint(const Light& light, Random& random) {
    LightPoint point;
    switch (light.kind) {
        case LightKind::Triangle: {
            const double root = std::sqrt(random.uniform()), v = random.uniform();
            const TrianglePrimitive& t = light.triangle;
            point.position = t.a * (1 - root) + t.b * (root * (1 - v)) + t.c * (root * v);
            point.normal = t.normal();
            break;
        }
        case LightKind::Sphere:
            point.normal = uniformDirection(random);
            point.position = light.sphere.center + point.normal * light.sphere.radius;
            break;
        case LightKind::Directional: point.directionFromLight = light.direction; break;
        case LightKind::Environment: point.directionFromLight = uniformDirection(random); break;
        default: point.position = light.position;
    }
    return point;
}

std::optional<DirectSample> sampleDirect(const Light& light, const Vec3d& receiver, Random& random) {
    LightPoint point = sampleLightPoint(light, random);
    DirectSample sample;
    if (light.isInfinite()) {
        sample.wi = -point.directionFromLight;
        sample.distance = kInfinity;
        sample.pdf = light.isDelta() ? 0 : pdfDirect(light, point);
        sample.weight = emitted(light, point) / (light.isDelta() ? 1 : sample.pdf);
        return sample;
    }
    const Vec3d toLight = point.position - receiver;
    sample.distance = length(toLight);
    if (sample.distance == 0) return {};
    sample.wi = toLight / sample.distance;
    point.directionFromLight = -sample.wi;
    const double squaredDistance = sample.distance * sample.distance;
    if (light.isDelta()) {
        sample.weight = emitted(light, point) / squaredDistance;
    } else {
        const double cosine = cosineAtLight(light, point);
        if (cosine == 0) return {};
        sample.pdf = pdfDirect(light, point) * squaredDistance / cosine;
        sample.weight = emitted(light, point) / sample.pdf;
    }
    return maxComponent(sample.weight) > 0 ? std::optional(sample) : std::nullopt;
}

LightSet::LightSet(const Scene& scene, const Geometry& geometry) {
    const auto addEmitter = [&](Light light, PrimitiveId primitive, uint32_t materialIndex) {
        const Material& material = scene.materials[materialIndex];
        if (!material.emits()) return;
        light.emission = Vec3d(material.emission);
        light.twoSided = material.emitsBothSides;
        light.primitive = primitive;
        lights_.push_back(light);
    };
    for (size_t i = 0; i < geometry.triangles().size(); ++i) {
        Light light{.kind = LightKind::Triangle, .triangle = geometry.triangles()[i]};
        if (light.area() > 0) addEmitter(light, PrimitiveId(i), light.triangle.material);
    }
    for (size_t i = 0; i < geometry.spheres().size(); ++i) {
        const Light light{.kind = LightKind::Sphere, .sphere = geometry.spheres()[i]};
        addEmitter(light, geometry.sphereId(i), light.sphere.material);
    }
    for (const PointLight& p : scene.pointLights)
        lights_.push_back({.kind = LightKind::Point, .emission = Vec3d(p.intensity), .position = Vec3d(p.position)});
    for (const SpotLight& s : scene.spotLights)
        lights_.push_back({.kind = LightKind::Spot,
                           .emission = Vec3d(s.intensity),
                           .position = Vec3d(s.position),
                           .direction = normalize(Vec3d(s.direction)),
                           .cosInner = std::cos(double(s.innerHalfAngle)),
                           .cosOuter = std::cos(double(s.outerHalfAngle))});
    for (const DirectionalLight& d : scene.directionalLights)
        lights_.push_back({.kind = LightKind::Directional,
                           .emission = Vec3d(d.irradiance),
                           .direction = normalize(Vec3d(d.direction)),
                           .sceneRadius = geometry.boundingRadius()});
    if (scene.environment) {
        if (!scene.environment->map.empty())
            throw Error(ErrorCode::Usage, "The reference renderer has no environment maps, only a constant one.");
        lights_.push_back({.kind = LightKind::Environment,
                           .emission = Vec3d(scene.environment->radiance),
                           .sceneRadius = geometry.boundingRadius()});
    }

    double total = 0;
    for (const Light& light : lights_) total += light.power();
    if (!(total > 0)) throw Error(ErrorCode::Usage, "The scene '" + scene.name + "' has no light.");
    for (const Light& light : lights_) pick_.push_back(light.power() / total);
}

size_t LightSet::pick(Random& random) const {
    double u = random.uniform();
    size_t index = 0;
    while (index + 1 < pick_.size() && u >= pick_[index]) u -= pick_[index++];
    return index;
}

std::optional<size_t> LightSet::ofPrimitive(PrimitiveId primitive) const {
    const auto found =
        std::find_if(lights_.begin(), lights_.end(), [&](const Light& l) { return l.primitive == primitive; });
    if (primitive == kNoPrimitive || found == lights_.end()) return {};
    return size_t(found - lights_.begin());
}

std::optional<size_t> LightSet::environment() const {
    if (lights_.empty() || lights_.back().kind != LightKind::Environment) return {};
    return lights_.size() - 1;
}

}  // namespace antipode::reference
