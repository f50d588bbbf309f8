#include <iostream>
#include <numeric>

#include "proto/scene_loader.h"
#include "renderengine/denoise.h"
#include "renderengine/engine.h"
#include "renderengine/flip.h"
#include "tests/benchmarks/benchmarks.h"
#include "tests/benchmarks/clock.h"
#include "tests/benchmarks/markdown.h"

namespace antipode::benchmark {
namespace {

constexpr uint32_t side = 96;
constexpr uint64_t budgets[] = {16, 64};

/// relMSE and mean FLIP against the reference.
struct Errors {
    double relMse, flip;
};

Errors errorsOf(const Image& image, const Image& reference) {
    const std::vector<float> flip = flipErrors(image, reference);
    return {compareImages(image, reference).relMse,
            std::accumulate(flip.begin(), flip.end(), 0.0) / double(flip.size())};
}

RenderSettings settingsFor(const std::string& technique) {
    RenderSettings settings;
    settings.width = settings.height = side;
    settings.technique = technique;
    return settings;
}

/// Of the same technique, so that what it blurs is not held against the denoiser, and of another seed.
Image referenceOf(const Scene& scene, const std::string& technique, const Options& options) {
    RenderSettings settings = settingsFor(technique);
    settings.seed = 777;
    Engine engine(scene, settings, options.device);
    for (uint64_t i = 1; i <= options.rounds; ++i) engine.render(i);
    return engine.sums().image();
}

std::string change(double before, double after) {
    return significant(before) + " → " + significant(after) + " (**" + fixed(after / before, 2) + "**)";
}

}  // namespace

void runDenoising(const Options& options) {
    std::vector<std::string> files = options.scenes;
    if (files.empty())
        for (const char* name : {"cornell/area", "cornell/point", "cornell/sky", "cornell/sun", "veach_mis", "pool",
                                 "glass_caustics", "lacquer"})
            files.push_back(ANTIPODE_SOURCE_DIR "/scenes/" + std::string(name) + ".textproto");
    MarkdownTable table({"scene", "technique", "iterations", "relMSE", "FLIP"});
    Samples microseconds;
    std::string deviceName;
    bool openImageDenoise = false;
    for (const std::string& file : files) {
        const Scene scene = loadScene(file);
        for (const char* technique : {"pt", "vcm"}) {
            const Image reference = referenceOf(scene, technique, options);
            RenderSettings settings = settingsFor(technique);
            settings.residueClasses = 4;
            settings.layers = denoiserLayers;
            settings.guides = Guides::FirstHit;
            Engine engine(scene, settings, options.device);
            deviceName = engine.deviceName();
            uint64_t rendered = 0;
            for (const uint64_t iterations : budgets) {
                while (rendered < iterations) engine.render(++rendered);
                const FilmSums sums = engine.sums();
                Denoised denoised;
                microseconds.add(1e6 * timed([&] { denoised = denoise(sums); }).cpu / (side * side));
                openImageDenoise = denoised.openImageDenoise;
                const Errors before = errorsOf(sums.image(), reference), after = errorsOf(denoised.image, reference);
                table.add({scene.name, technique, std::to_string(iterations), change(before.relMse, after.relMse),
                           change(before.flip, after.flip)});
            }
        }
        std::cerr << "measured " << scene.name << std::endl;
    }
    printLine(machineName(deviceName) + "; " + std::to_string(side) + " x " + std::to_string(side) +
              "; references of " + std::to_string(options.rounds) + " iterations; " + fixed(microseconds.median(), 1) +
              " µs of CPU time a pixel for denoising (median).");
    printLine(openImageDenoise ? "With Open Image Denoise." : "Without Open Image Denoise.");
    printLine("Noisy → denoised, and the share of the error that is left:");
    table.print();
}

}  // namespace antipode::benchmark
