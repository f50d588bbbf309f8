#include <cstdlib>
#include <iostream>

#include "renderengine/error.h"
#include "tests/benchmarks/benchmarks.h"
#include "tests/benchmarks/clock.h"
#include "tests/benchmarks/cornell.h"
#include "tests/benchmarks/markdown.h"
#include "tests/benchmarks/published.h"

namespace antipode::benchmark {
namespace {

struct Reference {
    std::string scene;
    double ownRelMse;  ///< the reference's noise, which every measured error contains
};

const std::vector<Reference>& references() {
    static const std::vector<Reference> rows{{"area", .00034}, {"sky", .00071}};
    return rows;
}

const CornellScene& sceneNamed(const std::string& name) {
    for (const CornellScene& scene : cornellScenes)
        if (name == scene.name) return scene;
    throw Error(ErrorCode::Usage, "There is no Cornell scene '" + name + "'.");
}

}  // namespace

void runConvergence(const Options& options) {
    const char* shared = std::getenv("ANTIPODE_SHARED");
    if (!shared) throw Error(ErrorCode::Usage, "convergence needs ANTIPODE_SHARED, the folder that holds reference/.");

    MarkdownTable table(
        {"scene", "technique", "iterations", "relMSE", "less the reference's own", "SmallVCM", "ratio"});
    std::string deviceName;
    for (const Reference& reference : references()) {
        const Image expected = readExr(std::string(shared) + "/reference/cornell-" + reference.scene + ".exr");
        const CornellScene& scene = sceneNamed(reference.scene);
        for (size_t i = 0; i < comparedTechniques.size(); ++i) {
            Engine engine = cornellEngine(scene.name, comparedTechniques[i], expected.width, options.device);
            deviceName = engine.deviceName();
            engine.render(1);  // drivers compile at the first dispatch
            engine.reset();
            uint64_t iterations = 0;
            const double start = processCpuSeconds();
            do engine.render(++iterations);
            while (processCpuSeconds() - start < options.cpuSeconds);
            const double relMse = compareImages(engine.sums().image(), expected).relMse,
                         net = relMse - reference.ownRelMse;
            const auto published = scene.relMse[i];
            table.add({scene.name, comparedTechniques[i], std::to_string(iterations), significant(relMse),
                       significant(net), published ? significant(*published) : "–",
                       published ? fixed(relMse / *published, 2) : "–"});
            std::cerr << "measured " << scene.name << " " << comparedTechniques[i] << std::endl;
        }
    }
    printLine(machineName(deviceName) + "; 256 x 256, at most 10 edges, after " + significant(options.cpuSeconds) +
              " CPU-seconds of rendering (set-up apart).");
    table.print();
}

}  // namespace antipode::benchmark
