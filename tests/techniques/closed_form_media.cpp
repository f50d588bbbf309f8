#include <cmath>
#include <numbers>

#include "tests/techniques/closed_form_scenes.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

using std::numbers::pi;

// Light tracing alone splats points next to the camera by 1/d², whose square has no mean over a volume; other
// techniques weigh such splats down.

/// A ball of radius 1 that scatters by this in each length, by default in all channels.
uint32_t addMilk(Scene& scene, float ior, float distance, float anisotropy, Vec3f color = Vec3f(1.0f)) {
    const uint32_t milk = addGlass(scene, ior);
    scene.materials[milk].scatteringColor = color;
    scene.materials[milk].scatteringDistance = distance;
    scene.materials[milk].scatteringAnisotropy = anisotropy;
    scene.spheres.push_back({{0, 0, 0}, 1, milk});
    return milk;
}

/// A camera inside a body that scatters and absorbs nothing, under a uniform sky: scattering changes nothing of what is
/// the same everywhere and in all directions, n² times the sky's radiance. Channels scatter unequally.
ClosedFormCase milkFurnace(const std::string& name, float ior, float anisotropy) {
    ClosedFormCase c{.name = name,
                     .difficulty = "inside a body that scatters light unequally, in uniform light from everywhere",
                     .heavyTailed = {"lt"},
                     .lightPaths = 2048};
    addMilk(c.scene, ior, 0.6f, anisotropy, {1, 0.5f, 0.2f});
    setConstantSky(c.scene, Vec3f(1.0f));
    c.scene.camera = lookAt({0.3f, 0.1f, 0.4f}, {0, 0, -1}, {0, 1, 0}, 0.8);
    c.radiance = [ior](double, double) { return double(ior) * double(ior); };
    c.size = 16;
    c.blocks = 1;
    return c;
}

/// A point light in a body that absorbs and scatters: what one turn brings to the camera, by quadrature along its ray,
/// L = ∫ σ_s p(θ) I e^(−σ_t(s + d))/d² ds to the body's surface.
ClosedFormCase singleScattering() {
    ClosedFormCase c{.name = "SingleScattering",
                     .difficulty = "light of a point that fog turns once",
                     .blind = {"pt-naive", "ppm", "bpm"},
                     .heavyTailed = {"lt"},
                     .lightPaths = 2048};
    constexpr double scattered = 0.5, absorbed = 0.4, g = 0.6, height = 0.5;
    const uint32_t fog = addMilk(c.scene, 1, float(1 / scattered), float(g));
    c.scene.materials[fog].attenuationColor = Vec3f(float(std::exp(-absorbed)));
    c.scene.materials[fog].attenuationDistance = 1.0f;
    const Vec3d lamp{0.2, -0.1, 0.1}, eye{0, 0, height};
    addPointLight(c.scene, Vec3f(lamp), Vec3f(1.0f));
    c.scene.camera = lookDownOn(0, 0, height, 0.2);
    c.minPathLength = c.maxPathLength = 2;
    c.mergeRadius = 0.01;
    c.blocks = 1;
    c.radiance = [=](double x, double y) {
        const Vec3d way = normalize(Vec3d(x, y, 0) - eye);
        const double b = dot(way, eye), end = -b + std::sqrt(b * b + 1 - dot(eye, eye));
        constexpr int steps = 200;
        double sum = 0;
        for (int i = 0; i < steps; ++i) {
            const double s = (i + 0.5) / steps * end;
            const Vec3d fromLamp = eye + way * s - lamp;
            const double d = length(fromLamp), turned = -dot(fromLamp, way) / d;
            const double phase = (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * turned, 1.5));
            sum += phase * std::exp(-(scattered + absorbed) * (s + d)) / (d * d);
        }
        return scattered * sum * end / steps;
    };
    return c;
}

}  // namespace

void addMediaCases(std::vector<ClosedFormCase>& cases) {
    cases.push_back(milkFurnace("FogFurnace", 1, 0.7f));
    cases.push_back(milkFurnace("MilkFurnace", 1.3f, -0.4f));
    cases.push_back(singleScattering());
}

}  // namespace antipode::test
