// Iteration i is a pure function of scene, settings and i: the same bytes in any order, on any number of threads, by
// any number of engines, whatever the buffers' sizes.
#include <numeric>

#include "tests/techniques/agreement_scenes.h"
#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

class EngineDeterminism : public EngineTest {
protected:
    static RenderSettings small(const std::string& technique) {
        RenderSettings settings;
        settings.width = 40;
        settings.height = 24;
        settings.technique = technique;
        return settings;
    }
};

TEST_F(EngineDeterminism, EveryTechniqueRepeatsInAnyOrderAndSplit) {
    const Scene scene = specularScene();
    for (const TechniqueInfo& technique : techniqueTable()) {
        SCOPED_TRACE(technique.name);
        const RenderSettings settings = small(technique.name);
        Engine engine(scene, settings);
        for (const uint64_t i : {1, 2, 3}) engine.render(i);
        const FilmSums forwards = engine.sums();
        ASSERT_EQ(forwards.iterations, 3u);
        EXPECT_NE(std::accumulate(forwards.values.begin(), forwards.values.end(), int64_t(0)), 0);

        engine.reset();
        EXPECT_EQ(engine.sums().iterations, 0u);
        for (const uint64_t i : {3, 1, 2}) engine.render(i);
        EXPECT_EQ(engine.sums().sha256(), forwards.sha256());

        FilmSums merged = renderSums(scene, settings, {2});
        merged.merge(renderSums(scene, settings, {3, 1}));
        EXPECT_EQ(merged.sha256(), forwards.sha256());
        expectHealthy(engine);
    }
}

/// Where an iteration has a wavelength of its own.
TEST_F(EngineDeterminism, DispersionRepeatsInAnyOrderAndSplit) {
    const Scene scene = dispersiveScene();
    for (const char* technique : {"pt", "vcm"}) {
        SCOPED_TRACE(technique);
        const RenderSettings settings = small(technique);
        const FilmSums forwards = renderSums(scene, settings, {1, 2, 3});
        FilmSums merged = renderSums(scene, settings, {2});
        merged.merge(renderSums(scene, settings, {3, 1}));
        EXPECT_EQ(merged.sha256(), forwards.sha256());
        EXPECT_EQ(renderSums(scene, settings, {3, 1, 2}).sha256(), forwards.sha256());
    }
}

TEST_F(EngineDeterminism, SeedIterationAndSceneMatter) {
    RenderSettings settings = small("vcm");
    const std::string one = renderSums(specularScene(), settings, {1}).sha256();
    EXPECT_NE(renderSums(specularScene(), settings, {2}).sha256(), one);
    settings.seed = 2;
    EXPECT_NE(renderSums(specularScene(), settings, {1}).sha256(), one);
}

/// Beyond 32 bits, too: iteration numbers and seeds are 64 bits wide.
TEST_F(EngineDeterminism, HighBitsOfSeedAndIterationMatter) {
    RenderSettings settings = small("pt");
    const std::string one = renderSums(specularScene(), settings, {1}).sha256();
    EXPECT_NE(renderSums(specularScene(), settings, {1 + (uint64_t(1) << 40)}).sha256(), one);
    settings.seed += uint64_t(1) << 40;
    EXPECT_NE(renderSums(specularScene(), settings, {1}).sha256(), one);
}

/// The sums of a part of the film, layer by layer.
std::vector<int64_t> sumsOf(const FilmSums& film, const PixelWindow& part) {
    std::vector<int64_t> sums;
    for (size_t i = 0; i < film.layout.layers.size(); ++i) {
        const uint64_t channels = film.layout.layers[i].channels.size();
        for (uint64_t y = part.y0; y < part.y1; ++y) {
            const uint64_t row = film.layout.offset(i) + channels * (y * film.layout.width);
            for (uint64_t at = row + channels * part.x0; at < row + channels * part.x1; ++at)
                sums.push_back(film.values[at]);
        }
    }
    return sums;
}

/// Rendered by itself, a part of the image has the bytes that it has in the whole: its camera paths draw the same
/// numbers and meet the same light paths.
TEST_F(EngineDeterminism, APartIsWhatTheWholeShowsThere) {
    Scene parallel = specularScene();
    parallel.camera.orthographicHeight = 2;
    const std::vector<std::pair<std::string, Scene>> scenes{
        {"pinhole", specularScene()}, {"lens", skyScene()}, {"orthographic", parallel}};
    for (const auto& [camera, scene] : scenes)
        for (const char* technique : {"vcm", "ppm", "lt"}) {
            RenderSettings settings = small(technique);
            settings.connectionsPerVertex = 2;
            settings.layers = LayerSet((1u << layerKinds) - 1);
            const FilmSums whole = renderSums(scene, settings, {2});
            for (const PixelWindow& part : {PixelWindow{7, 5, 29, 20}, PixelWindow{39, 23, 40, 24}}) {
                SCOPED_TRACE(camera + ", " + technique + ", " + described(part));
                settings.crop = part;
                const FilmSums alone = renderSums(scene, settings, {2});
                EXPECT_EQ(alone.layout.width, part.width());
                EXPECT_EQ(alone.layout.height, part.height());
                EXPECT_EQ(alone.values, sumsOf(whole, part));
            }
        }
}

// --- Growth of the vertex buffers ---

/// A point light in front of a slit that takes up a third of its sphere; behind the slit a lossless box, where nearly
/// every path goes on to the length limit. How many of a few paths get in varies by more than the buffers' reserve.
Scene trapScene() {
    Scene scene;
    const uint32_t white = addLambert(scene, Vec3f(1.0f));
    addQuad(scene, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, white);
    addQuad(scene, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, white);
    addQuad(scene, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}, white);
    addQuad(scene, {0, -1, 0}, {0, 0, 1}, {1, 0, 0}, white);
    addQuad(scene, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, white);
    addQuad(scene, {0, 0.505f, 1}, {1, 0, 0}, {0, 0.495f, 0}, white);
    addQuad(scene, {0, -0.505f, 1}, {1, 0, 0}, {0, 0.495f, 0}, white);
    addPointLight(scene, {0, 0, 1.005f}, Vec3f(1.0f));
    scene.camera = lookAt({0, 0, 0.9f}, {0, 0, -1}, {0, 1, 0}, 1.2);
    return scene;
}

class EngineGrowth : public EngineDeterminism {
protected:
    static RenderSettings crowded(const std::string& technique) {
        RenderSettings settings = small(technique);
        settings.width = settings.height = 4;
        settings.lightPathCount = 48;
        settings.seed = 3;
        settings.sampler = Sampler::Independent;  // numbers of vertices differ more: buffers have to grow
        settings.russianRoulette = false;
        settings.maxPathLength = 1000;
        settings.initialRadius = 0.1;
        return settings;
    }

    /// Renders until the buffers have grown, and one iteration more; the one that made them grow and the one after it,
    /// in buffers larger than its own, must be those of a fresh engine.
    void expectSameAfterGrowth(const RenderSettings& settings) {
        constexpr uint64_t patience = 12;
        const Scene scene = trapScene();
        Engine engine(scene, settings);
        const uint64_t bytesAtFirst = engine.statistics().deviceBytes;
        bool grown = false;
        for (uint64_t i = 1; i <= patience; ++i) {
            const bool grownBefore = grown;
            engine.reset();
            engine.render(i);
            grown = engine.statistics().deviceBytes > bytesAtFirst;
            if (!grown) continue;
            EXPECT_EQ(renderSums(scene, settings, {i}).sha256(), engine.sums().sha256()) << "iteration " << i;
            if (grownBefore) break;
        }
        EXPECT_TRUE(grown) << "the buffers never grew: this test tests nothing";
        expectHealthy(engine);
    }
};

TEST_F(EngineGrowth, ConnectionsMergesAndSplats) { expectSameAfterGrowth(crowded("vcm")); }

/// Thousands of candidates around every camera vertex, and a table of buckets that doubles when the buffers grow.
TEST_F(EngineGrowth, CrowdedMerges) {
    RenderSettings settings = crowded("ppm");
    settings.initialRadius = 0.6;
    settings.lightPathCount = 88;
    expectSameAfterGrowth(settings);
}

// --- Bounds on path length, roulette ---

class EngineLengths : public EngineDeterminism {
protected:
    /// Mean of the green channel over `count` iterations, and its moments.
    Moments mean(const RenderSettings& settings, uint64_t count) {
        return momentsOf(renderEach(specularScene(), settings, count), {0, 0, settings.width, settings.height}, 1);
    }
};

/// Paths do not know the bounds: with the same random numbers, the images of lengths 1, 2 and 3 … 4 add up to that of 1
/// … 4. They differ by float32's rounding of the sums along a path and by the film's fixed point.
TEST_F(EngineLengths, PartsAddUpToTheWhole) {
    RenderSettings settings = small("pt");
    settings.russianRoulette = false;
    const auto sumsOf = [&](uint32_t least, uint32_t most) {
        settings.minPathLength = least;
        settings.maxPathLength = most;
        return renderSums(specularScene(), settings, {1, 2});
    };
    const FilmSums whole = sumsOf(1, 4), one = sumsOf(1, 1), two = sumsOf(2, 2), rest = sumsOf(3, 4);
    const double unit = std::ldexp(1.0, -whole.layout.layers[0].scaleExponent);
    double difference = 0, total = 0;
    for (size_t i = 0; i < whole.values.size(); ++i) {
        total += double(whole.values[i]) * unit;
        difference += std::abs(double(whole.values[i] - one.values[i] - two.values[i] - rest.values[i])) * unit;
    }
    EXPECT_GT(total, 0);
    EXPECT_LT(difference, 1e-6 * total);
}

TEST_F(EngineLengths, NothingIsShorterThanTheMinimumOrLongerThanTheMaximum) {
    // A lamp in plain view and nothing else: one edge.
    Scene scene;
    addHorizontalSquare(scene, {0, 0, 0}, 5, addLamp(scene, Vec3f(1.0f)));
    scene.camera = lookAt({0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 0.5);
    for (const TechniqueInfo& technique : techniqueTable()) {
        SCOPED_TRACE(technique.name);
        RenderSettings settings = small(technique.name);
        settings.maxPathLength = 1;
        for (const Vec3f& pixel : renderSums(scene, settings, {1}).image().pixels) EXPECT_EQ(pixel.x, 1.0f);
        settings.minPathLength = 2;
        settings.maxPathLength = {};
        for (const Vec3f& pixel : renderSums(scene, settings, {1}).image().pixels) EXPECT_EQ(pixel.x, 0.0f);
    }
}

/// Null hypothesis: the expectation is the same with and without roulette. Welch's test, α = .01 over three techniques
/// (Šidák), seeds 1 and 2, 40 iterations as samples.
TEST_F(EngineLengths, RouletteKeepsTheMean) {
    for (const char* technique : {"pt", "bpt", "vcm"}) {
        RenderSettings settings = small(technique);
        settings.maxPathLength = 8;
        const Moments with = mean(settings, 40);
        settings.russianRoulette = false;
        settings.seed = 2;
        const Moments without = mean(settings, 40);
        EXPECT_GT(welchTest(with, without).pValue, sidak(kAlpha, 3))
            << technique << " " << with.mean() << " " << without.mean();
        EXPECT_LT(std::sqrt(with.meanVariance()), 0.05 * with.mean());
    }
}

/// A path of which more than half is left goes on, but for one in fifty: in a closed room of albedo .9 that glows paths
/// of at most six edges then bring the same but for 7 %. Cut by all that they have lost, they differ by 26 %.
TEST_F(EngineLengths, RouletteCutsOnlyWhatHasLostHalf) {
    Scene scene;
    const uint32_t glowing = addLambert(scene, Vec3f(0.9f));
    scene.materials[glowing].emission = Vec3f(1.0f);
    scene.materials[glowing].emitsBothSides = true;
    scene.spheres.push_back({{0, 0, 0}, 1, glowing});
    scene.camera = lookAt({0.2f, 0, 0}, {0, 0.3f, 0}, {0, 0, 1}, 1.0);
    const auto spread = [&](uint32_t edges) {
        RenderSettings settings = small("pt-naive");
        settings.maxPathLength = edges;
        Moments values;
        for (const Image& image : renderEach(scene, settings, 4))
            for (const Vec3f& pixel : image.pixels) values.add(double(pixel.y));
        return std::sqrt(values.variance()) / values.mean();
    };
    EXPECT_LT(spread(6), 0.1);
    EXPECT_GT(spread(12), 0.1);
}

/// Roulette costs dark surfaces nothing that they send back at once: a ball of albedo .05 under a sky, whose paths
/// hardly come to a third vertex, has the same variance with and without; from the first vertex on it had 12 times as
/// much.
TEST_F(EngineLengths, RouletteLeavesDarkSurfacesAlone) {
    Scene scene;
    addGeodesicSphere(scene, {0, 0, 0}, 1, 2, true, false, addLambert(scene, Vec3f(0.05f)));
    setConstantSky(scene, Vec3f(1.0f));
    scene.camera = lookAt({0, -3, 0}, {0, 0, 0}, {0, 0, 1}, 0.3);
    const auto variance = [&](bool roulette) {
        RenderSettings settings = small("pt");
        settings.maxPathLength = 6;
        settings.russianRoulette = roulette;
        const std::vector<Image> images = renderEach(scene, settings, 32);
        double sum = 0;
        for (size_t p = 0; p < images[0].pixels.size(); ++p) {
            Moments pixel;
            for (const Image& image : images) pixel.add(double(image.pixels[p].y));
            sum += pixel.meanVariance();
        }
        return sum;
    };
    const double without = variance(false);
    EXPECT_GT(without, 0);
    EXPECT_LT(variance(true), 1.1 * without);
}

/// A path that only a connection can make, light → glass → wall → wall → glass → camera (5 edges), with one light path
/// per iteration that hardly ever meets a wall: the engine's estimate of how many vertices there will be may be none at
/// all, and those that do come must count all the same.
TEST_F(EngineLengths, ConnectionsCountWhateverThePilotFound) {
    Scene scene;
    const uint32_t white = addLambert(scene, Vec3f(0.8f)), glass = addGlass(scene);
    addHorizontalSquare(scene, {0, 0, 0}, 0.6f, white);
    addQuad(scene, {0.7f, 0, 0.7f}, {0, 0, 0.6f}, {0, 0.6f, 0}, white);
    addPointLight(scene, {0, 0, 2}, Vec3f(1.0f));
    scene.spheres.push_back({{0, 0, 2}, 0.2f, glass});
    scene.camera = lookAt({0, -1, 1}, {0, 0, 0}, {0, 0, 1}, 0.5);
    scene.spheres.push_back({{0, -1, 1}, 0.1f, glass});
    for (const uint64_t lightPaths : {64, 1}) {
        SCOPED_TRACE(lightPaths);
        RenderSettings settings = small("bpt");
        settings.width = settings.height = 16;
        settings.lightPathCount = lightPaths;
        settings.minPathLength = settings.maxPathLength = 5;
        std::vector<uint64_t> iterations(400);
        std::iota(iterations.begin(), iterations.end(), 1);
        const FilmSums sums = renderSums(scene, settings, iterations);
        EXPECT_GT(std::accumulate(sums.values.begin(), sums.values.end(), int64_t(0)), 0);
    }
}

}  // namespace
}  // namespace antipode::test
