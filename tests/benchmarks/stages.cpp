#include <limits>

#include "proto/scene_loader.h"
#include "renderengine/engine.h"
#include "tests/benchmarks/benchmarks.h"
#include "tests/benchmarks/markdown.h"

namespace antipode::benchmark {
namespace {

std::string millions(double value) { return fixed(1e-6 * value, 2); }

double totalSeconds(const EngineStatistics& statistics) {
    double seconds = 0;
    for (const StageTime& stage : statistics.stages) seconds += stage.seconds;
    return seconds;
}

void printStages(const std::string& path, const Options& options) {
    const Scene scene = loadScene(path);
    RenderSettings settings;
    settings.width = scene.imageWidth;
    settings.height = scene.imageHeight;
    settings.maxPathLength = scene.maxPathLength;
    settings.technique = options.technique;
    Engine engine(scene, settings, options.device);
    engine.render(1);  // drivers compile at the first dispatch
    EngineStatistics best;
    double total = std::numeric_limits<double>::infinity();
    for (uint32_t round = 0; round < options.rounds; ++round) {
        engine.reset();
        engine.render(2 + round);
        const EngineStatistics statistics = engine.statistics();
        if (const double seconds = totalSeconds(statistics); seconds < total) {
            best = statistics;
            total = seconds;
        }
    }

    printLine(scene.name + ", " + options.technique + ", " + std::to_string(settings.width) + " x " +
              std::to_string(settings.height) + ", fastest of " + std::to_string(options.rounds) + " iterations; " +
              machineName(engine.deviceName()) + ".");
    MarkdownTable table({"stage", "ms", "share", "M rays", "M rays/s"});
    for (const StageTime& stage : best.stages) {
        const double rays = double(stage.rays);
        table.add({stage.stage, fixed(1e3 * stage.seconds, 1), fixed(100 * stage.seconds / total, 1) + " %",
                   stage.rays ? millions(rays) : "–", stage.rays ? millions(rays / stage.seconds) : "–"});
    }
    const double rays = double(best.rays + best.shadowRays);
    table.add({"all", fixed(1e3 * total, 1), "100 %", millions(rays), millions(rays / total)});
    table.print();
}

}  // namespace

void runStages(const Options& options) {
    const std::vector<std::string> own{ANTIPODE_SOURCE_DIR "/scenes/cornell/area.textproto"};
    for (const std::string& path : options.scenes.empty() ? own : options.scenes) printStages(path, options);
}

}  // namespace antipode::benchmark
