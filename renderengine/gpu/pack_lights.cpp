#include "gpu/pack_lights.h"

#include <bit>
#include <cmath>
#include <numbers>

#include "gpu/near_lights.h"
#include "numerics/alias_table.h"

namespace antipode {
namespace {

using namespace shared;
using std::numbers::pi;

/// How much brighter than that a lamp may make what is close to it before the film's scale gives way: the room for 10^6
/// iterations is then one for 10^4 there. And by how much it gives way at most: sums then still count 2^-18 of the
/// greatest radiance, each sample with its mean kept.
constexpr double spotTolerated = 0x1p6, spotHeld = 0x1p24;

uint bits(float value) { return std::bit_cast<uint>(value); }
/// 1 − cos of an angle, also where the cosine rounds to 1.
double versine(double angle) { return 2.0 * std::sin(0.5 * angle) * std::sin(0.5 * angle); }
double mean(const Vec3d& c) { return (c.x + c.y + c.z) / 3.0; }

struct LightRecord {
    uint kind = 0, primitiveOrVersineInner = 0, material = 0;
    Vec3f positionOrDirection, value, axis;
    float versineOuter = 0;
    double power = 0;
};

/// Radiance per texel with the density of drawing it: power (radiance × solid angle) picks the texel, inside it the
/// direction is uniform in solid angle. Returns the mean radiance over the sphere times 4π.
double packEnvironmentMap(const Environment& e, PackedScene& packed) {
    const uint width = e.width, height = e.height;
    std::vector<double> power(e.map.size());
    double total = 0;
    for (uint y = 0; y < height; ++y) {
        const double solidAngle = 2.0 * pi / width * (std::cos(pi * y / height) - std::cos(pi * (y + 1) / height));
        for (uint x = 0; x < width; ++x) {
            const size_t i = size_t(y) * width + x;
            power[i] = mean(Vec3d(e.map[i] * e.radiance)) * solidAngle;
            total += power[i];
        }
    }
    const auto table = buildAliasTable(power);
    for (uint y = 0; y < height; ++y) {
        const double solidAngle = 2.0 * pi / width * (std::cos(pi * y / height) - std::cos(pi * (y + 1) / height));
        for (uint x = 0; x < width; ++x) {
            const size_t i = size_t(y) * width + x;
            packed.environmentMap.push_back({e.map[i].x, e.map[i].y, e.map[i].z, float(power[i] / total / solidAngle)});
            packed.environmentAlias.push_back({bits(table[i].threshold), table[i].alias, 0, 0});
        }
    }
    return total;
}

}  // namespace

void packLights(const Scene& scene, const std::vector<EmitterPrimitive>& emitters, const SetUpStep& step,
                PackedScene& packed) {
    std::vector<LightRecord> records;
    const double radius = packed.bounds.radius();
    double& greatest = packed.greatestRadiance;

    const std::vector<double> powers = emittedPowers(scene, emitters, [&] { step("weighing emitters"); });
    for (size_t i = 0; i < emitters.size(); ++i) {
        const EmitterPrimitive& e = emitters[i];
        const Material& m = scene.materials[e.material];
        greatest = std::max(greatest, double(maxComponent(m.emission)));
        if (powers[i] == 0.0) continue;
        LightRecord r;
        r.kind = e.sphere ? LIGHT_SPHERE : LIGHT_TRIANGLE;
        r.primitiveOrVersineInner = e.primitive;
        r.material = e.material;
        r.power = powers[i];
        packed.primitives[size_t(e.primitive) * 3 + 1].w = uint(records.size());
        packed.features |= e.sphere ? FEATURE_LIGHT_SPHERES : FEATURE_LIGHT_TRIANGLES;
        records.push_back(r);
    }
    // A surface a quarter of the scene's radius from a point light: brighter spots are small.
    const auto nearRadiance = [&](const Vec3f& intensity) {
        return 16.0 * maxComponent(intensity) / (radius * radius);
    };
    for (const PointLight& l : scene.pointLights) {
        LightRecord r;
        r.kind = LIGHT_POINT;
        r.positionOrDirection = l.position;
        r.value = l.intensity;
        r.power = mean(Vec3d(l.intensity)) * 4.0 * pi;
        greatest = std::max(greatest, nearRadiance(l.intensity));
        packed.features |= FEATURE_LIGHT_POINTS;
        records.push_back(r);
    }
    for (const SpotLight& l : scene.spotLights) {
        LightRecord r;
        r.kind = LIGHT_SPOT;
        r.positionOrDirection = l.position;
        r.value = l.intensity;
        r.axis = l.direction;
        r.versineOuter = float(versine(double(l.outerHalfAngle)));
        r.primitiveOrVersineInner = bits(float(versine(double(l.innerHalfAngle))));
        r.power = mean(Vec3d(l.intensity)) * 2.0 * pi * double(r.versineOuter);
        greatest = std::max(greatest, nearRadiance(l.intensity));
        packed.features |= FEATURE_LIGHT_SPOTS;
        records.push_back(r);
    }
    for (const DirectionalLight& l : scene.directionalLights) {
        LightRecord r;
        r.kind = LIGHT_DIRECTIONAL;
        r.positionOrDirection = l.direction;
        r.value = l.irradiance;
        r.power = mean(Vec3d(l.irradiance)) * pi * radius * radius;
        greatest = std::max(greatest, double(maxComponent(l.irradiance)));
        packed.features |= FEATURE_LIGHT_DIRECTIONALS;
        records.push_back(r);
    }
    if (scene.environment) {
        const Environment& e = *scene.environment;
        LightRecord r;
        r.kind = LIGHT_ENVIRONMENT;
        r.value = e.radiance;
        double flux = mean(Vec3d(e.radiance)) * 4.0 * pi;
        greatest = std::max(greatest, double(maxComponent(e.radiance)));
        if (!e.map.empty()) {
            packed.features |= FEATURE_ENVIRONMENT_MAP;
            flux = packEnvironmentMap(e, packed);
            for (const Vec3f& texel : e.map) greatest = std::max(greatest, double(maxComponent(texel * e.radiance)));
        }
        r.power = flux * pi * radius * radius;
        if (r.power > 0.0) {
            packed.features |= FEATURE_ENVIRONMENT;
            packed.environmentLight = uint(records.size());
            records.push_back(r);
        }
    }

    const double spot = brightestSpot(scene, spotTolerated * greatest);
    if (spot > spotTolerated * greatest) greatest = std::min(spot, spotHeld * greatest);

    std::vector<double> weights;
    double total = 0;
    for (const LightRecord& r : records) {
        weights.push_back(r.power);
        total += r.power;
    }
    if (!(total > 0.0)) return;
    const auto table = buildAliasTable(weights);
    packed.lightCount = uint(records.size());
    for (size_t i = 0; i < records.size(); ++i) {
        const LightRecord& r = records[i];
        const float pick = float(r.power / total);
        if (i == packed.environmentLight) packed.environmentPick = pick;
        const auto texel = [](const Vec3f& v, uint w) { return uvec4{bits(v.x), bits(v.y), bits(v.z), w}; };
        packed.lights.push_back({r.kind, r.primitiveOrVersineInner, r.material, bits(pick)});
        packed.lights.push_back(texel(r.positionOrDirection, bits(table[i].threshold)));
        packed.lights.push_back(texel(r.value, table[i].alias));
        packed.lights.push_back(texel(r.axis, bits(r.versineOuter)));
    }
}

}  // namespace antipode
