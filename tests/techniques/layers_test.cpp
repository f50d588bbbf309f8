// Layers beside the image: parts that add up to it, and guides against closed forms.
#include "renderengine/layers.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

/// A lamp over a floor, a mirror beside it and a sphere.
Scene smallRoom() {
    Scene scene;
    addHorizontalSquare(scene, {0, 0, 0}, 2, addLambert(scene, {0.6f, 0.5f, 0.4f}));
    addHorizontalSquare(scene, {0, 0, 2}, 0.3f, addLamp(scene, Vec3f(7.0f), true), false);
    addQuad(scene, {-1, 0, 1}, {0, 1, 0}, {0, 0, 1}, addMirror(scene, 0.9f));
    addGeodesicSphere(scene, {0.4f, 0.2f, 0.4f}, 0.4f, 2, true, false, addLambert(scene, Vec3f(0.7f)));
    scene.camera = lookAt({2.5f, -2, 1.5f}, {0, 0, 0.5f}, {0, 0, 1}, 0.8);
    return scene;
}

RenderSettings settingsFor(const std::string& technique) {
    RenderSettings settings;
    settings.width = 24, settings.height = 18;
    settings.technique = technique;
    return settings;
}

LayerSet allLayers() {
    LayerSet layers;
    for (const LayerInfo& layer : layerTable()) layers.add(layer.kind);
    return layers;
}

const std::vector<float>& valuesOf(const std::vector<LayerImage>& images, const std::string& name,
                                   const std::string& channels) {
    for (const LayerImage& image : images)
        if (image.name == name && image.channels == channels) return image.values;
    throw std::out_of_range(name);
}

class LayersTest : public EngineTest {};

// With independent numbers: those of Sobol' sequences belong to the classes, so that another K is another image.
TEST_F(LayersTest, ResidueClassesAddUpToTheSameBytes) {
    const Scene scene = smallRoom();
    const std::vector<uint64_t> iterations{1, 2, 3, 5, 7};
    for (const char* technique : {"vcm", "pt", "lt"}) {
        SCOPED_TRACE(technique);
        RenderSettings settings = settingsFor(technique);
        settings.sampler = Sampler::Independent;
        const FilmSums whole = renderSums(scene, settings, iterations);
        for (const uint32_t classes : {2u, 8u}) {
            settings.residueClasses = classes;
            const FilmSums parted = renderSums(scene, settings, iterations);
            EXPECT_EQ(parted.layout.residueClasses(), classes);
            EXPECT_EQ(parted.imageAlone().sha256(), whole.sha256());
            EXPECT_EQ(parted.residueIterations[0], classes == 2 ? 4u : 1u);
            // A class is what its iterations render alone.
            settings.residueClasses = 1;
            std::vector<uint64_t> first;
            for (const uint64_t i : iterations)
                if ((i - 1) % classes == 0) first.push_back(i);
            const FilmSums alone = renderSums(scene, settings, first);
            EXPECT_TRUE(std::ranges::equal(parted.layer(0), alone.values));
        }
    }
}

TEST_F(LayersTest, TechniquesAddUpToTheImageExactlyAndLeaveItAsItIs) {
    const Scene scene = smallRoom();
    const std::vector<uint64_t> iterations{1, 2, 3};
    for (const Precision precision : {Precision::Float, Precision::Double})
        for (const TechniqueInfo& technique : techniqueTable()) {
            if (precision == Precision::Double && technique.name != "vcm") continue;
            SCOPED_TRACE(technique.name + " in " + name(precision));
            RenderSettings settings = settingsFor(technique.name);
            settings.precision = precision;
            settings.radiusFactor = 4;  // three iterations of so few paths hardly merge otherwise
            const FilmSums alone = renderSums(scene, settings, iterations);
            settings.layers = allLayers();
            const FilmSums sums = renderSums(scene, settings, iterations);
            EXPECT_EQ(sums.imageAlone().sha256(), alone.sha256());
            std::vector<int64_t> total(alone.values.size());
            for (size_t i = 0; i < sums.layout.layers.size(); ++i) {
                if (sums.layout.layers[i].kind > LayerKind::Splat) continue;
                int64_t light = 0;
                for (size_t at = 0; at < total.size(); ++at) {
                    total[at] += sums.layer(i)[at];
                    light += sums.layer(i)[at];
                }
                if (technique.name == "vcm") {
                    EXPECT_GT(light, 0) << sums.layout.layers[i].name;
                }
            }
            EXPECT_EQ(total, alone.values);
        }
}

// A floor at height 0.25 seen from above, far from the origin or near it, in small units or large.
TEST_F(LayersTest, GuidesOfAFloorAreItsOwn) {
    for (const float scale : {1.0f, 0x1p-30f, 0x1p30f})
        for (const float away : {0.0f, 1000.0f}) {
            SCOPED_TRACE(std::to_string(scale) + " " + std::to_string(away));
            const auto at = [&](float x, float y, float z) { return Vec3f{away + x, y, 0.25f + z} * scale; };
            Scene scene;
            addHorizontalSquare(scene, at(0, 0, 0), 4 * scale, addLambert(scene, {0.6f, 0.5f, 0.25f}));
            addPointLight(scene, at(0, 0, 3), Vec3f(scale * scale));
            scene.camera = lookAt(at(0, -2, 2), at(0, 0, 0), {0, 0, 1}, 0.2);
            RenderSettings settings = settingsFor("pt");
            settings.width = settings.height = 5;
            settings.layers = allLayers();
            std::vector<uint64_t> iterations(16);
            for (size_t i = 0; i < iterations.size(); ++i) iterations[i] = i + 1;
            const std::vector<LayerImage> images = renderSums(scene, settings, iterations).layerImages();
            constexpr size_t middle = 12;
            const auto value = [&](const char* name, const char* channels, size_t channel) {
                return double(valuesOf(images, name, channels)[std::string(channels).size() * middle + channel]);
            };
            EXPECT_NEAR(value("albedo", "RGB", 0), 0.6, 1e-6);
            EXPECT_NEAR(value("albedo", "RGB", 2), 0.25, 1e-6);
            EXPECT_NEAR(value("N", "XYZ", 0), 0, 1e-6);
            EXPECT_NEAR(value("N", "XYZ", 2), 1, 1e-6);
            EXPECT_EQ(value("coverage", "A", 0), 1);
            // Over the pixel's footprint of 0.11 by 0.16: means of 16 samples within a third of its size.
            EXPECT_NEAR(value("", "Z", 0) / scale, std::sqrt(8.0), 0.05);
            EXPECT_NEAR(value("P", "XYZ", 0) / scale, away, 0.05);
            EXPECT_NEAR(value("P", "XYZ", 1) / scale, 0, 0.06);
            EXPECT_NEAR(value("P", "XYZ", 2) / scale, 0.25, 1e-4);
        }
}

// A mirror on the floor under a sphere, seen from above: the mirror itself, or the sphere in it.
TEST_F(LayersTest, GuidesTellOfTheFirstHitOrOfWhatAMirrorShows) {
    Scene scene;
    scene.spheres.push_back({{0, 0, 2}, 1, addLambert(scene, Vec3f(0.5f))});
    addHorizontalSquare(scene, {0, 0, 0}, 1, addMirror(scene, 0.9f));
    addPointLight(scene, {3, 0, 1}, Vec3f(1.0f));
    scene.camera = lookAt({0.5f, 0, 0.9f}, {0.5f, 0, 0}, {0, 1, 0}, 0.02);
    RenderSettings settings = settingsFor("pt");
    settings.width = settings.height = 1;
    settings.russianRoulette = false;
    settings.maxPathLength = 4;
    settings.layers = allLayers();
    const auto guides = [&](Guides kind) {
        settings.guides = kind;
        return renderSums(scene, settings, {1, 2, 3, 4}).layerImages();
    };
    const std::vector<LayerImage> mirror = guides(Guides::FirstHit), shown = guides(Guides::FirstDiffuse);
    EXPECT_NEAR(valuesOf(mirror, "N", "XYZ")[2], 1, 1e-5);
    EXPECT_NEAR(valuesOf(mirror, "", "Z")[0], 0.9, 1e-3);
    EXPECT_NEAR(valuesOf(mirror, "albedo", "RGB")[1], 0.9, 1e-3);
    // Straight up again, onto the sphere at x = 1/2: n = (1/2, 0, −√3/2), height 2 − √3/2.
    EXPECT_NEAR(valuesOf(shown, "N", "XYZ")[0], 0.5, 0.03);
    EXPECT_NEAR(valuesOf(shown, "N", "XYZ")[2], -std::sqrt(0.75), 0.03);
    EXPECT_NEAR(valuesOf(shown, "P", "XYZ")[2], 2 - std::sqrt(0.75), 0.03);
    EXPECT_NEAR(valuesOf(shown, "", "Z")[0], 0.9 - (2 - std::sqrt(0.75)), 0.03);
    EXPECT_NEAR(valuesOf(shown, "albedo", "RGB")[1], 0.5, 1e-3);
}

}  // namespace
}  // namespace antipode::test
