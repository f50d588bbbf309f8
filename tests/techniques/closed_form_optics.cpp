#include <cmath>
#include <numbers>

#include "support/closed_forms.h"
#include "tests/techniques/closed_form_scenes.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

using std::numbers::pi;

// So dark that what the floor sends back through or off the glass onto itself stays below a thousandth of the caustic.
constexpr double kDarkReflectance = 0.001;

/// Sun through a plane-parallel slab (z = .8 … 1) onto a floor that lies wholly in its shadow: only light that crosses
/// two smooth interfaces, reflected between them any number of times, arrives.
ClosedFormCase slabCaustic(const std::string& name, double angle) {
    ClosedFormCase c{.name = name,
                     .difficulty = "sunlight through a glass slab, all inner reflections",
                     .blind = {"pt", "pt-naive"}};
    addHorizontalSquare(c.scene, {0, 0, 0}, 0.55f, addLambert(c.scene, Vec3f(float(kDarkReflectance))));
    const uint32_t glass = addGlass(c.scene);
    addHorizontalSquare(c.scene, {0, 0, 1}, 2.2f, glass);
    addHorizontalSquare(c.scene, {0, 0, 0.8f}, 2.2f, glass, false);
    c.scene.directionalLights.push_back({Vec3f(Vec3d(std::sin(angle), 0, -std::cos(angle))), Vec3f(100.0f)});
    c.scene.camera = lookDownOn(0, 0, 0.4, 0.45);
    c.radiance = [angle](double, double) { return closed_forms::slabCaustic(kDarkReflectance, 100, angle, 1.5); };
    return c;
}

/// The same through a pane of one sheet, and straight down through a closed slab that absorbs: of a that is left on one
/// way through and R at a face, (1−R)²a(1 + R²a² + …) passes.
ClosedFormCase paneShadow(const std::string& name, double angle) {
    ClosedFormCase c = slabCaustic(name, angle);
    c.difficulty = "sunlight through a pane of one sheet, all inner reflections";
    c.scene.meshes.pop_back();
    c.scene.materials.back().thin = true;
    return c;
}

ClosedFormCase absorbingSlab() {
    ClosedFormCase c = slabCaustic("AbsorbingSlab", 0);
    c.difficulty = "sunlight through glass that absorbs, all inner reflections";
    constexpr double left = 0.3;
    c.scene.materials.back().attenuationColor = Vec3f(float(left));
    c.scene.materials.back().attenuationDistance = 0.2f;
    const Mesh lower = c.scene.meshes.back();
    c.scene.meshes.pop_back();
    Mesh& slab = c.scene.meshes.back();
    slab.positions.insert(slab.positions.end(), lower.positions.begin(), lower.positions.end());
    slab.uvs.clear();
    for (const auto& t : lower.triangles) slab.triangles.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
    // The sides. The lower square goes round the other way: its corners 0 … 3 lie under the upper one's 0, 3, 2, 1.
    for (uint32_t i = 0; i < 4; ++i) {
        const uint32_t next = (i + 1) % 4, below = 4 + (4 - i) % 4, nextBelow = 4 + (4 - next) % 4;
        slab.triangles.push_back({i, below, nextBelow});
        slab.triangles.push_back({i, nextBelow, next});
    }
    const double r = 0.04, passed = (1 - r) * (1 - r) * left / (1 - r * r * left * left);
    c.radiance = [passed](double, double) { return kDarkReflectance * 100 * passed / pi; };
    return c;
}

/// Sunlight that a black sheet lets pass in part falls on a floor.
ClosedFormCase blendedShadow() {
    ClosedFormCase c = slabCaustic("BlendedShadow", 0);
    c.difficulty = "the shadow of a sheet that covers three tenths";
    c.blind = {"pt-naive"};
    c.scene.meshes.pop_back();
    c.scene.materials.back() = Material{};
    c.scene.materials.back().baseColor = Vec3f(0.0f);
    c.scene.materials.back().coverage = 0.3f;
    c.radiance = [](double, double) { return kDarkReflectance * 100 * 0.7 / pi; };
    return c;
}

/// A floor that is there in part, with nothing behind it.
ClosedFormCase blendedFloor() {
    ClosedFormCase c = blendedShadow();
    c.name = "BlendedFloor";
    c.difficulty = "a floor that covers three fifths of nothing";
    c.scene.meshes.pop_back();
    c.scene.materials[0].baseColor = Vec3f(0.5f);
    c.scene.materials[0].coverage = 0.6f;
    c.radiance = [](double, double) { return 0.5 * 100 * 0.6 / pi; };
    return c;
}

/// Collimated light through a glass ball, two refractions and nothing else: paths of exactly 4 edges. The floor, 3 from
/// the centre, lies in the ball's shadow. 4 × 4 blocks see radii from 0 to .92.
ClosedFormCase ballLens() {
    ClosedFormCase c{.name = "BallLensCaustic",
                     .difficulty = "a glass ball focuses collimated light",
                     .blind = {"pt", "pt-naive"},
                     .blocks = 4};
    c.minPathLength = c.maxPathLength = 4;
    c.mergeRadius = 0.02;
    addHorizontalSquare(c.scene, {0, 0, 0}, 0.7f, addLambert(c.scene, Vec3f(float(kDarkReflectance))));
    c.scene.spheres.push_back({{0, 0, 3}, 1, addGlass(c.scene)});
    c.scene.directionalLights.push_back({{0, 0, -1}, Vec3f(100.0f)});
    c.scene.camera = lookDownOn(0, 0, 1.2, 0.65);
    // The closed form searches for rays: a table at steps of .005, read linearly, is good to 1e-4.
    std::vector<double> table;
    for (int i = 0; i <= 200; ++i) table.push_back(closed_forms::ballLensIrradiance(1.5, 3, std::max(i * 0.005, 1e-3)));
    c.radiance = [table](double x, double y) {
        const double at = std::hypot(x, y) / 0.005;
        const size_t i = size_t(at);
        return 100 * kDarkReflectance / pi * (table[i] + (table[i + 1] - table[i]) * (at - double(i)));
    };
    return c;
}

/// A perfectly reflecting GGX floor (index 0 + i: F = 1) under a uniform sky cannot be told from it. The tables of what
/// single scattering loses are within 10^-3.
ClosedFormCase whiteMetal(const std::string& name, double alpha, double cosine) {
    ClosedFormCase c{
        .name = name, .difficulty = "a rough white metal under a uniform sky is as bright as it", .lightPaths = 8192};
    const uint32_t metal = addMaterial(c.scene, MaterialKind::RoughConductor, Vec3f(1.0f), float(std::sqrt(alpha)));
    c.scene.materials[metal].conductorEta = Vec3f(0.0f);
    c.scene.materials[metal].conductorK = Vec3f(1.0f);
    addHorizontalSquare(c.scene, {0, 0, 0}, 2, metal);
    setConstantSky(c.scene, Vec3f(1.0f));
    const double sine = std::sqrt(1 - cosine * cosine);
    c.scene.camera = lookAt(Vec3f(Vec3d(0, -20 * sine, 20 * cosine)), {0, 0, 0}, {1, 0, 0}, 0.05);
    c.radiance = [](double, double) { return 1.0; };
    c.blocks = 1;
    return c;
}

}  // namespace

void addOpticsCases(std::vector<ClosedFormCase>& cases) {
    cases.push_back(slabCaustic("SlabCaustic0", 0));
    cases.push_back(slabCaustic("SlabCaustic45", pi / 4));
    cases.push_back(slabCaustic("SlabCaustic60", pi / 3));
    cases.push_back(paneShadow("PaneShadow0", 0));
    cases.push_back(paneShadow("PaneShadow60", pi / 3));
    cases.push_back(absorbingSlab());
    cases.push_back(blendedShadow());
    cases.push_back(blendedFloor());
    cases.push_back(ballLens());
    cases.push_back(whiteMetal("WhiteMetalHalfRoughHeadOn", 0.5, 1));
    cases.push_back(whiteMetal("WhiteMetalRoughHeadOn", 1, 1));
    cases.push_back(whiteMetal("WhiteMetalRoughAslant", 1, 0.5));
}

const std::vector<ClosedFormCase>& closedFormCases() {
    static const std::vector<ClosedFormCase> cases = [] {
        std::vector<ClosedFormCase> all;
        addFurnaceCases(all);
        addFloorCases(all);
        addOpticsCases(all);
        addMediaCases(all);
        return all;
    }();
    return cases;
}

}  // namespace antipode::test
