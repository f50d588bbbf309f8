// Which light a scene can have, and which of it a choice of techniques makes: against first principles, path by path,
// and against the device.
#include "renderengine/light_paths.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernels/shared/layout.h"
#include "techniques/technique.h"
#include "tests/film/expect_error.h"
#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

using namespace shared;

Scene floorScene() {
    Scene scene;
    addHorizontalSquare(scene, {0, 0, 0}, 12, addLambert(scene, Vec3f(0.5f)));
    scene.camera = lookAt({0, 3, 3}, {0, 0, 0}, {0, 1, 0}, 0.8);
    return scene;
}

TEST(LightPathFacts, LookAtWhatIsUsed) {
    Scene scene = floorScene();
    EXPECT_EQ(lightPathFacts(scene), (LightPathFacts{.scattering = true}));
    const uint32_t glass = addGlass(scene), lamp = addLamp(scene, Vec3f(1));
    EXPECT_EQ(lightPathFacts(scene), (LightPathFacts{.scattering = true})) << "materials that nothing has";
    scene.spheres.push_back({{0, 1, 0}, 0.5f, glass});
    EXPECT_EQ(lightPathFacts(scene), (LightPathFacts{.scattering = true, .specular = true}));
    scene.spheres.push_back({{0, 5, 0}, 0.5f, lamp});
    EXPECT_EQ(lightPathFacts(scene), (LightPathFacts{.sizedLamps = true, .scattering = true, .specular = true}));
    addPointLight(scene, {0, 9, 0}, Vec3f(0.0f));
    EXPECT_FALSE(lightPathFacts(scene).sizelessLamps) << "a lamp that is out";
    addPointLight(scene, {0, 9, 0}, Vec3f(1.0f));
    EXPECT_EQ(lightPathFacts(scene), (LightPathFacts{true, true, true, true}));
}

TEST(LightPathFacts, KnowEveryKindOfSurface) {
    const auto factsOf = [](const Material& material) {
        Scene scene;
        scene.materials = {material};
        scene.spheres = {{{0, 0, 0}, 1, 0}};
        return lightPathFacts(scene);
    };
    const LightPathFacts scattering{.scattering = true}, specular{.specular = true},
        both{.scattering = true, .specular = true};
    const auto of = [](MaterialKind kind, float roughness) {
        Material m;
        m.kind = kind;
        m.roughness = roughness;
        return m;
    };
    EXPECT_EQ(factsOf(of(MaterialKind::Lambert, 1)), scattering);
    EXPECT_EQ(factsOf(of(MaterialKind::Phong, 1)), scattering);
    EXPECT_EQ(factsOf(of(MaterialKind::Mirror, 1)), specular);
    EXPECT_EQ(factsOf(of(MaterialKind::Dielectric, 1)), specular);
    EXPECT_EQ(factsOf(of(MaterialKind::RoughConductor, 0.2f)), scattering);
    EXPECT_EQ(factsOf(of(MaterialKind::RoughConductor, 0)), specular);
    Material milk = of(MaterialKind::Dielectric, 1);
    milk.scatteringDistance = 1.0f;
    EXPECT_EQ(factsOf(milk), (LightPathFacts{.specular = true, .media = true}));
    milk.thin = true;
    EXPECT_EQ(factsOf(milk), specular) << "a pane is filled with nothing";
    EXPECT_EQ(factsOf(of(MaterialKind::RoughDielectric, 0.2f)), scattering);
    EXPECT_EQ(factsOf(of(MaterialKind::RoughDielectric, 0)), specular);
    EXPECT_EQ(factsOf(of(MaterialKind::MetallicRoughness, 0.5f)), scattering);
    Material part = of(MaterialKind::MetallicRoughness, 0.5f);
    part.transmission = 0.5f;
    EXPECT_EQ(factsOf(part), scattering) << "rough glass";
    part.roughness = 0;
    EXPECT_EQ(factsOf(part), both) << "a surface part smooth glass";
    part.transmission = 1;
    EXPECT_EQ(factsOf(part), specular);
    Material dark = of(MaterialKind::Mirror, 1);
    dark.specular = Vec3f(0.0f);
    EXPECT_EQ(factsOf(dark), LightPathFacts{});
    Material gone = of(MaterialKind::Mirror, 1);
    gone.coverage = 0.0f;
    EXPECT_EQ(factsOf(gone), LightPathFacts{}) << "nothing of it is there";
    dark.emission = Vec3f(1.0f);
    EXPECT_EQ(factsOf(dark), (LightPathFacts{.sizedLamps = true}));
    Scene sky;
    sky.environment.emplace().radiance = Vec3f(1.0f);
    sky.directionalLights = {{{0, -1, 0}, Vec3f(1.0f)}};
    EXPECT_EQ(lightPathFacts(sky), (LightPathFacts{.sizedLamps = true, .sizelessLamps = true}));
    sky.directionalLights.clear();
    sky.spotLights = {{{0, 1, 0}, {0, -1, 0}, Vec3f(1.0f)}};
    EXPECT_TRUE(lightPathFacts(sky).sizelessLamps);
}

/// A path by its vertices from the lamp to the camera: on surfaces 'D' or 'S' each, in media 'M'.
struct PathPattern {
    bool sizeless;
    std::string surfaces;
};

PathClass classOf(const PathPattern& path) {
    const bool media = path.surfaces.find('D') == std::string::npos;
    std::string v = path.surfaces;
    std::replace(v.begin(), v.end(), 'M', 'D');
    if (v.find('D') == std::string::npos) return {.sizeless = path.sizeless, .scattered = false};
    return {path.sizeless, true, v.front() == 'S', v.back() == 'S', v.find("DD") != std::string::npos, media};
}

/// Whether some pair of s light and t camera vertices makes the path: every step is drawn from a lobe, and where the
/// two sub-paths meet nothing has to hit a direction, or a lamp, that only chance of measure zero would hit.
bool isMade(const PathPattern& path, uint32_t terms) {
    const size_t n = path.surfaces.size();
    const auto scatters = [&](size_t i) { return path.surfaces[i - 1] != 'S'; };  // vertex i of 1 … n from the lamp
    const auto isSurface = [&](size_t i) { return path.surfaces[i - 1] == 'D'; };
    const auto endsBefore = [&](size_t i) {  // camera paths that end at the first scattering surface reach i
        if ((terms & TERM_FIRST_DIFFUSE) == 0) return true;
        for (size_t j = i + 1; j <= n; ++j)
            if (isSurface(j) || (scatters(j) && (terms & TERM_SPLAT) != 0)) return false;
        return true;
    };
    if ((terms & TERM_HIT) != 0 && !path.sizeless && endsBefore(0)) return true;
    if (n == 0) return false;
    if ((terms & TERM_NEXT_EVENT) != 0 && scatters(1) && endsBefore(1)) return true;
    if ((terms & TERM_SPLAT) != 0 && scatters(n)) return true;
    for (size_t i = 1; i <= n; ++i) {
        if ((terms & TERM_CONNECT) != 0 && i < n && scatters(i) && scatters(i + 1) && endsBefore(i + 1)) return true;
        if ((terms & TERM_MERGE) != 0 && isSurface(i) && endsBefore(i)) return true;
    }
    return false;
}

std::vector<PathPattern> patternsUpTo(size_t surfaces) {
    std::vector<PathPattern> all;
    for (size_t n = 0; n <= surfaces; ++n)
        for (size_t number = 0, numbers = size_t(std::pow(3, n)); number < numbers; ++number)
            for (const bool sizeless : {false, true}) {
                std::string text;
                for (size_t i = 0, rest = number; i < n; ++i, rest /= 3) text += "SDM"[rest % 3];
                // A lamp without size is invisible, and so are its mirror images: no such path carries light.
                if (!sizeless || text.find_first_of("DM") != std::string::npos) all.push_back({sizeless, text});
            }
    return all;
}

/// All techniques with all that can be left out of them.
std::vector<RenderSettings> everyChoice() {
    std::vector<RenderSettings> all;
    for (const TechniqueInfo& technique : techniqueTable())
        for (uint32_t bits = 0; bits < 1u << transports; ++bits) {
            if ((bits & ~technique.transports.bits()) != 0) continue;
            RenderSettings settings;
            settings.technique = technique.name;
            settings.without = TransportSet(bits);
            all.push_back(settings);
        }
    return all;
}

TEST(PathClasses, HoldEveryPathOnce) {
    const LightPathFacts everything{true, true, true, true, true};
    for (uint32_t edges = 1; edges <= 6; ++edges) {
        const std::vector<PathClass> classes = pathClasses(everything, edges);
        std::vector<int> found(classes.size());
        for (const PathPattern& path : patternsUpTo(edges - 1)) {
            const auto at = std::find(classes.begin(), classes.end(), classOf(path));
            ASSERT_NE(at, classes.end()) << path.surfaces;
            ++found[size_t(at - classes.begin())];
            EXPECT_LE(at->fewestEdges(), path.surfaces.size() + 1);
        }
        EXPECT_EQ(std::count(found.begin(), found.end(), 0), 0) << "a class without a path of " << edges << " edges";
    }
    EXPECT_EQ(pathClasses(everything, {}).size(), 33u);
    EXPECT_EQ(pathClasses({true, true, true, true}, {}).size(), 17u);
    EXPECT_TRUE(pathClasses({.sizelessLamps = true, .specular = true}, {}).empty());
    EXPECT_EQ(pathClasses({.sizedLamps = true, .specular = true}, {}).size(), 1u);
    EXPECT_EQ(pathClasses({.sizelessLamps = true, .scattering = true}, {}).size(), 2u);
}

TEST(PathClasses, AreMadeAsTheirPathsAre) {
    for (const RenderSettings& settings : everyChoice()) {
        const TechniquePlan plan = planTechnique(settings);
        for (const PathPattern& path : patternsUpTo(6))
            EXPECT_EQ(makes(plan, classOf(path)), isMade(path, plan.terms))
                << settings.technique << " without " << name(settings.without) << ": " << path.surfaces
                << (path.sizeless ? " sizeless" : " sized");
    }
}

TEST(PathClasses, WholeTechniquesLackWhatTheyAreKnownToLack) {
    const LightPathFacts everything{true, true, true, true};
    const auto lacks = [&](const std::string& technique) {
        RenderSettings settings;
        settings.technique = technique;
        return described(missingClasses(everything, settings));
    };
    EXPECT_EQ(lacks("vcm"), "");
    EXPECT_EQ(lacks("bpm"), "");
    EXPECT_EQ(lacks("ppm"), "");
    EXPECT_EQ(lacks("bpt"), "caustics of points, spots and suns, seen in mirrors or through glass (LS+DS+E)");
    EXPECT_EQ(lacks("pt"),
              "caustics of points, spots and suns (LS+DE, LS+D…DE); "
              "caustics of points, spots and suns, seen in mirrors or through glass (LS+DS+E, LS+D…DS+E)");
}

TEST(PathClasses, MediaAreNotMergedWith) {
    const LightPathFacts milk{.sizedLamps = true, .sizelessLamps = true, .specular = true, .media = true};
    const auto lacks = [&](const std::string& technique) {
        RenderSettings settings;
        settings.technique = technique;
        return described(missingClasses(milk, settings));
    };
    EXPECT_EQ(lacks("vcm"), "caustics in media of points, spots and suns, seen in mirrors or through glass (LS+MS+E)");
    EXPECT_EQ(lacks("vcm"), lacks("bpt"));
    EXPECT_EQ(lacks("bpm"), lacks("ppm"));
    EXPECT_NE(lacks("bpm").find("direct light in media of points, spots and suns (LME)"), std::string::npos);
    EXPECT_EQ(lacks("bpm").find("glowing"), std::string::npos) << "paths through media meet lamps";
}

TEST(Without, IsRefusedWhereNothingIsThereToLeaveOut) {
    RenderSettings settings;
    settings.technique = "pt";
    settings.without.add(Transport::Merging);
    expectError(ErrorCode::Usage, "the technique pt has no merging", [&] { checkSettings(settings); });
}

class LightPathsOnDevice : public EngineTest {
protected:
    bool isBlack(const Scene& scene, const RenderSettings& settings) {
        const FilmSums sums = renderSums(scene, settings, {1, 2});
        return std::all_of(sums.values.begin(), sums.values.end(), [](int64_t v) { return v == 0; });
    }

    static RenderSettings small(const std::string& technique, std::initializer_list<Transport> without = {}) {
        RenderSettings settings;
        settings.width = settings.height = 24;
        settings.initialRadius = 0.2;
        settings.technique = technique;
        for (const Transport transport : without) settings.without.add(transport);
        return settings;
    }
};

/// A lamp without size in a ball of glass over a floor, which the camera sees through a pane: of all classes the scene
/// has light in LS+DS+E alone. An image is black where nothing makes them, and nowhere else.
TEST_F(LightPathsOnDevice, OnlyMergesMakeCausticsOfAPointSeenThroughGlass) {
    Scene scene = floorScene();
    const uint32_t glass = addGlass(scene);
    scene.spheres = {{{0, 1, 0}, 0.5f, glass}, {{0, 3, 3}, 0.25f, glass}};
    addPointLight(scene, {0, 1, 0}, Vec3f(10.0f));
    using enum Transport;
    for (const RenderSettings& settings :
         {small("vcm"), small("vcm", {NextEvent, LightTracing, Connections}), small("bpm")})
        EXPECT_FALSE(isBlack(scene, settings)) << settings.technique << " without " << name(settings.without);
    for (const RenderSettings& settings : {small("vcm", {Merging}), small("pt"), small("lt")})
        EXPECT_TRUE(isBlack(scene, settings)) << settings.technique << " without " << name(settings.without);
}

/// The same floor under a sky: what remains still counts all of the light once. H0: the mean over the image is that of
/// the floor, whose radiance is .5 wherever the sky of radiance 1 is seen whole. Student's t over 64 iterations at
/// α = .01 over the five choices; seed 1. Merging's bias is none where irradiance is constant; the floor's border is
/// out of view.
TEST_F(LightPathsOnDevice, WeightsAddUpToOneWhateverIsLeftOut) {
    Scene scene = floorScene();
    setConstantSky(scene, Vec3f(1.0f));
    using enum Transport;
    const std::vector<RenderSettings> choices{small("vcm", {NextEvent}), small("vcm", {LightTracing}),
                                              small("vcm", {Connections}), small("vcm", {NextEvent, Merging}),
                                              small("vcm", {NextEvent, LightTracing, Connections})};
    for (RenderSettings settings : choices) {
        settings.maxPathLength = 2;
        const Moments moments = momentsOf(renderEach(scene, settings, 64), {0, 0, 24, 24}, 1);
        EXPECT_GT(tTest(moments, 0.5).pValue, sidak(kAlpha, choices.size()))
            << "without " << name(settings.without) << ": " << moments.mean() << " ± "
            << std::sqrt(moments.meanVariance());
        EXPECT_LT(std::sqrt(moments.meanVariance()), 0.01) << "the test says nothing";
    }
}

}  // namespace
}  // namespace antipode::test
