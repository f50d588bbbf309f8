#include <cmath>
#include <numbers>

#include "support/closed_forms.h"
#include "tests/techniques/closed_form_scenes.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

using std::numbers::pi;

constexpr double kReflectance = 0.5;

/// A row without its light: a floor at z = 0 of which the camera sees the square of half-width `w` about (x, y).
ClosedFormCase floorCase(const std::string& name, const std::string& difficulty, double x, double cameraHeight,
                         double w) {
    ClosedFormCase c{.name = name, .difficulty = difficulty};
    addHorizontalSquare(c.scene, {float(x), 0, 0}, float(w) + 0.5f, addLambert(c.scene, Vec3f(float(kReflectance))));
    c.scene.camera = lookDownOn(x, 0, cameraHeight, w);
    return c;
}

double radianceOf(double irradiance) { return kReflectance * irradiance / pi; }

ClosedFormCase pointLight(const std::string& name, double x) {
    ClosedFormCase c = floorCase(name, "a light that no path can hit", x, 1, 0.5);
    addPointLight(c.scene, {0, 0, 2}, Vec3f(100.0f));
    c.radiance = [](double px, double py) {
        return radianceOf(closed_forms::irradianceOfPointLight(100, 2, std::hypot(px, py)));
    };
    c.blind = {"pt-naive"};
    return c;
}

/// A spot light straight above the origin; its falloff is the engine's definition (SpotLight).
ClosedFormCase spotLight(const std::string& name, double x, double w) {
    ClosedFormCase c = floorCase(name, "a cone of light that falls off smoothly", x, 1, w);
    c.scene.spotLights.push_back({{0, 0, 2}, {0, 0, -1}, Vec3f(100.0f), 0.25f, 0.5f});
    c.radiance = [](double px, double py) {
        const double r = std::hypot(px, py), cosine = std::cos(std::atan(r / 2));
        const double inner = std::cos(double(0.25f)), outer = std::cos(double(0.5f));
        const double t = std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
        return radianceOf(closed_forms::irradianceOfPointLight(100, 2, r)) * t * t;
    };
    c.mergeRadius = 0.03;
    c.blind = {"pt-naive"};
    return c;
}

ClosedFormCase sun(const std::string& name) {
    ClosedFormCase c = floorCase(name, "a light of one direction, infinitely far", 0, 1, 0.5);
    c.scene.directionalLights.push_back({{0.6f, 0, -0.8f}, Vec3f(3.0f)});
    c.radiance = [](double, double) { return radianceOf(3 * double(0.8f)); };
    c.blind = {"pt-naive"};
    return c;
}

ClosedFormCase sphereLight(const std::string& name, double x) {
    ClosedFormCase c = floorCase(name, "a sphere that is half hidden by itself", x, 1, 0.5);
    c.scene.spheres.push_back({{0, 0, 3}, 1, addLamp(c.scene, Vec3f(1.0f))});
    c.radiance = [](double px, double py) {
        return radianceOf(closed_forms::irradianceOfSphereLight(1, 1, 3, std::hypot(px, py)));
    };
    c.size = 64;
    c.lightPaths = 65536;
    return c;
}

/// The camera is below the disk, or beside it, and looks away from it.
ClosedFormCase diskLight(const std::string& name, double x) {
    ClosedFormCase c = floorCase(name, "a light of 256 slender triangles, close by", x, 0.5, 0.3);
    addDiskFacingDown(c.scene, {0, 0, 1}, 1, addLamp(c.scene, Vec3f(1.0f)));
    // 256 corners instead of a circle: edges are off by at most the sagitta, 1 − cos(π/256) = 7.5e-5, both ways.
    c.radiance = [](double px, double py) {
        return radianceOf(closed_forms::irradianceOfDiskLight(1, 1, 1, std::hypot(px, py)));
    };
    return c;
}

/// Radiance of the floor at (x, y) under a downward rectangle |x| ≤ a, |y| ≤ b: the form factor of four signed corners.
double underRectangle(double x, double y, double a, double b, double height) {
    const auto corner = [&](double u, double v) { return closed_forms::formFactorUnderCorner(u - x, v - y, height); };
    return kReflectance * (corner(a, b) - corner(-a, b) - corner(a, -b) + corner(-a, -b));
}

/// A 2a × 2a rectangle of radiance 1 at `height`; the camera sees the square of half-width w about (x, x).
ClosedFormCase rectangleLight(const std::string& name, double a, double height, double x, double w) {
    ClosedFormCase c{.name = name, .difficulty = "a light as large as its distance"};
    addHorizontalSquare(c.scene, {float(x), float(x), 0}, float(w) + 0.5f,
                        addLambert(c.scene, Vec3f(float(kReflectance))));
    addHorizontalSquare(c.scene, {0, 0, float(height)}, float(a), addLamp(c.scene, Vec3f(1.0f)), false);
    c.scene.camera = lookDownOn(x, x, height / 2, w);
    c.radiance = [=](double px, double py) { return underRectangle(px, py, a, a, height); };
    c.size = 64;
    c.mergeRadius = 0.05 * std::min(height, 1.0);
    return c;
}

/// A lamp that shines both ways, of whose 2 × 2 square alpha leaves the half with y > 0, beside one without holes.
ClosedFormCase lampWithAHole(const std::string& name) {
    ClosedFormCase c = floorCase(name, "a lamp half of which is a hole, beside another lamp", 0, 0.5, 0.25);
    const uint32_t holed = addLamp(c.scene, Vec3f(1.0f), true), whole = addLamp(c.scene, Vec3f(2.0f));
    // Interpolated between the two texels' centres, alpha reaches the cut-off in the middle.
    c.scene.textures.push_back({"half", 2, 1, {255, 255, 255, 0, 255, 255, 255, 255}});
    c.scene.textures.back().wrapU = c.scene.textures.back().wrapV = WrapMode::Clamp;
    c.scene.materials[holed].baseColorTexture = 0;
    c.scene.materials[holed].alphaCutoff = 0.5f;
    addHorizontalSquare(c.scene, {0, 0, 1}, 1, holed, false);  // u runs along y
    addHorizontalSquare(c.scene, {-1.5f, 0, 1}, 0.5f, whole, false);
    c.radiance = [](double x, double y) {
        return underRectangle(x, y - 0.5, 1, 0.5, 1) + 2 * underRectangle(x + 1.5, y, 0.5, 0.5, 1);
    };
    return c;
}

/// Floor [0,1]×[−½,½] and wall x = 0, with a common edge. The table knows the mean alone. By the wall's edge the
/// floor's form factor is ½, and a merge disk hangs over it by 2/(3π) of its share on average: .5·(2/3π)·r/.2 = .53 r.
ClosedFormCase perpendicularSquares() {
    ClosedFormCase c{.name = "PerpendicularSquares", .difficulty = "a light that touches the floor along an edge"};
    addQuad(c.scene, {0.625f, 0, 0}, {0.625f, 0, 0}, {0, 0.75f, 0}, addLambert(c.scene, Vec3f(float(kReflectance))));
    addQuad(c.scene, {0, 0, 0.5f}, {0, 0.5f, 0}, {0, 0, 0.5f}, addLamp(c.scene, Vec3f(1.0f)));
    c.scene.camera = lookDownOn(0.5, 0, 1, 0.5);
    const double mean = kReflectance * closed_forms::formFactorPerpendicularSquares();
    c.radiance = [mean](double, double) { return mean; };
    c.blocks = 1;
    c.mergeRadius = 0.003;
    c.otherMergeBias = 0.53 * c.mergeRadius;
    return c;
}

}  // namespace

void addFloorCases(std::vector<ClosedFormCase>& cases) {
    cases.push_back(pointLight("PointLightAtItsFoot", 0));
    cases.push_back(pointLight("PointLightAside", 2));
    cases.push_back(spotLight("SpotLightOnItsAxis", 0, 0.3));
    cases.push_back(spotLight("SpotLightFallingOff", 0.8, 0.2));
    cases.push_back(sun("DirectionalLight"));
    cases.push_back(sphereLight("SphereLightAbove", 0));
    cases.push_back(sphereLight("SphereLightAside", 4));
    cases.push_back(diskLight("DiskLightAtItsAxis", 0));
    cases.push_back(diskLight("DiskLightUnderItsEdge", 1));
    cases.push_back(diskLight("DiskLightAside", 2));
    cases.push_back(rectangleLight("RectangleLightAboveCentre", 1, 1, 0, 0.25));
    cases.push_back(rectangleLight("RectangleLightHigherAboveCentre", 1, 2, 0, 0.25));
    cases.push_back(rectangleLight("RectangleLightAboveCorner", 1, 1, 1, 0.25));
    cases.push_back(rectangleLight("ParallelSquares", 0.5, 1, 0, 0.5));
    cases.push_back(rectangleLight("ParallelSquaresFar", 0.5, 2, 0, 0.5));
    cases.push_back(rectangleLight("ParallelSquaresNear", 0.5, 0.5, 0, 0.5));
    cases.push_back(lampWithAHole("LampWithAHole"));
    cases.push_back(perpendicularSquares());
}

}  // namespace antipode::test
