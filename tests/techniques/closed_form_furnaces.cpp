#include "support/closed_forms.h"
#include "tests/techniques/closed_form_scenes.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

std::function<double(double, double)> uniform(double radiance) {
    return [radiance](double, double) { return radiance; };
}

/// A grey ball under a uniform sky. Merging has no bias: a ball of radius r cuts the area πr² out of any sphere.
ClosedFormCase whiteFurnace() {
    ClosedFormCase c{.name = "WhiteFurnace",
                     .difficulty = "a grey ball in uniform light from everywhere",
                     .radiance = uniform(closed_forms::whiteFurnace(0.5, 1))};
    c.scene.spheres.push_back({{0, 0, 0}, 1, addLambert(c.scene, Vec3f(0.5f))});
    setConstantSky(c.scene, Vec3f(1.0f));
    c.scene.camera = lookAt({0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 0.4);
    return c;
}

/// 1280 glowing triangles, a hollow polyhedron. Neighbours meet at 174° or more, so that what a ball cuts out of them
/// differs from a disk by less than .0014.
ClosedFormCase closedFurnace(const std::string& name, std::optional<uint32_t> bounces) {
    const double expected =
        bounces ? closed_forms::closedFurnace(1, 0.5, *bounces) : closed_forms::closedFurnace(1, 0.5);
    ClosedFormCase c{.name = name,
                     .difficulty = "every surface glows and reflects half: the bounces' geometric series",
                     .radiance = uniform(expected),
                     .lightPaths = 8192};
    const uint32_t glowing = addLambert(c.scene, Vec3f(0.5f));
    c.scene.materials[glowing].emission = Vec3f(1.0f);
    c.scene.materials[glowing].twoSided = false;
    addGeodesicSphere(c.scene, {0, 0, 0}, 1, 3, false, true, glowing);
    c.scene.camera = lookAt({0.1f, 0.2f, 0.3f}, {0.5f, -0.3f, 2}, {0, 1, 0}, 1.0);
    if (bounces) c.maxPathLength = *bounces + 1;
    c.otherMergeBias = 0.0014;
    return c;
}

/// A point light in the centre of a grey sphere, all bounces, bare or inside a ball of lossless glass: what enters a
/// centred ball leaves it again, and a lossless body in a uniform field changes nothing.
ClosedFormCase integratingSphere(const std::string& name, bool inGlass, double mergeRadius) {
    ClosedFormCase c{.name = name,
                     .difficulty = inGlass ? "a light inside glass: all light is a caustic, whatever the merge radius"
                                           : "all bounces of a closed room with one point light",
                     .radiance = uniform(closed_forms::integratingSphere(0.5, 1, 1)),
                     .lightPaths = 4096,
                     .mergeRadius = mergeRadius};
    c.scene.spheres.push_back({{0, 0, 0}, 1, addLambert(c.scene, Vec3f(0.5f))});
    addPointLight(c.scene, {0, 0, 0}, Vec3f(1.0f));
    if (inGlass) c.scene.spheres.push_back({{0, 0, 0}, 0.3f, addGlass(c.scene)});
    c.scene.camera = lookAt({0.1f, 0.2f, 0.5f}, {0.4f, 0.1f, 2}, {0, 1, 0}, 1.0);
    c.blind = inGlass ? std::vector<std::string>{"pt", "pt-naive"} : std::vector<std::string>{"pt-naive"};
    return c;
}

}  // namespace

void addFurnaceCases(std::vector<ClosedFormCase>& cases) {
    cases.push_back(whiteFurnace());
    cases.push_back(closedFurnace("ClosedFurnaceNoBounce", 0));
    cases.push_back(closedFurnace("ClosedFurnaceOneBounce", 1));
    cases.push_back(closedFurnace("ClosedFurnaceThreeBounces", 3));
    cases.push_back(closedFurnace("ClosedFurnaceAllBounces", {}));
    cases.push_back(integratingSphere("IntegratingSphere", false, 0.05));
    cases.push_back(integratingSphere("CausticEnergySmallRadius", true, 0.05));
    cases.push_back(integratingSphere("CausticEnergyLargeRadius", true, 0.4));
}

}  // namespace antipode::test
