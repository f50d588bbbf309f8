#include "proto/scene_loader.h"
#include "renderengine/engine.h"
#include "tests/benchmarks/benchmarks.h"
#include "tests/benchmarks/markdown.h"

namespace antipode::benchmark {
namespace {

std::string millions(double value) { return fixed(1e-6 * value, 2); }

void printStages(const std::string& path, const Options& options) {
    const Scene scene = loadScene(path);
    RenderSettings settings;
    settings.width = scene.imageWidth;
    settings.height = scene.imageHeight;
    settings.maxPathLength = scene.maxPathLength;
    settings.technique = options.technique;
    Engine engine(scene, settings, options.device);
    engine.render(1);  // drivers compile at the first dispatch
    engine.reset();
    for (uint32_t i = 0; i < options.rounds; ++i) engine.render(2 + i);

    const EngineStatistics statistics = engine.statistics();
    double total = 0;
    for (const StageTime& stage : statistics.stages) total += stage.seconds;
    printLine(scene.name + ", " + options.technique + ", " + std::to_string(settings.width) + " x " +
              std::to_string(settings.height) + ", mean of " + std::to_string(options.rounds) + " iterations; " +
              machineName(engine.deviceName()) + ".");
    MarkdownTable table({"stage", "ms", "share", "M rays", "M rays/s"});
    const double perIteration = 1.0 / options.rounds;
    for (const StageTime& stage : statistics.stages) {
        const double rays = double(stage.rays);
        table.add({stage.stage, fixed(1e3 * stage.seconds * perIteration, 1), fixed(100 * stage.seconds / total, 1) + " %",
                   stage.rays ? millions(rays * perIteration) : "–", stage.rays ? millions(rays / stage.seconds) : "–"});
    }
    const double rays = double(statistics.rays + statistics.shadowRays);
    table.add({"all", fixed(1e3 * total * perIteration, 1), "100 %", millions(rays * perIteration), millions(rays / total)});
    table.print();
}

}  // namespace

void runStages(const Options& options) {
    const std::vector<std::string> own{ANTIPODE_SOURCE_DIR "/scenes/cornell/area.textproto"};
    for (const std::string& path : options.scenes.empty() ? own : options.scenes) printStages(path, options);
}

}  // namespace antipode::benchmark
