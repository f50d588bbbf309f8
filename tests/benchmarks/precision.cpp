#include <iostream>

#include "tests/benchmarks/benchmarks.h"
#include "tests/benchmarks/clock.h"
#include "tests/benchmarks/cornell.h"
#include "tests/benchmarks/markdown.h"
#include "tests/benchmarks/published.h"

namespace antipode::benchmark {
namespace {

constexpr uint32_t side = 256;

/// Median of the rounds' ratios: float and double take turns, so that what slows the machine down slows both.
std::string cell(const CornellScene& scene, const char* technique, const Options& options, std::string& deviceName) {
    Engine inFloat = cornellEngine(scene.name, technique, side, options.device);
    Engine inDouble = cornellEngine(scene.name, technique, side, options.device, Precision::Double);
    inFloat.render(1), inDouble.render(1);  // drivers compile at the first dispatch
    deviceName = inFloat.deviceName();
    Samples floatMilliseconds, doubleMilliseconds, ratios;
    for (uint32_t round = 0; round < options.rounds; ++round) {
        const double f = 1e3 * timed([&] { inFloat.render(2 + round); }).cpu;
        const double d = 1e3 * timed([&] { inDouble.render(2 + round); }).cpu;
        floatMilliseconds.add(f), doubleMilliseconds.add(d), ratios.add(d / f);
    }
    return fixed(floatMilliseconds.median(), 0) + " / " + fixed(doubleMilliseconds.median(), 0) + " = **" +
           fixed(ratios.median(), 2) + "**";
}

}  // namespace

void runPrecision(const Options& options) {
    std::vector<std::string> header{"scene"};
    header.insert(header.end(), comparedTechniques.begin(), comparedTechniques.end());
    MarkdownTable table(header);
    std::string deviceName;
    for (const CornellScene& scene : cornellScenes) {
        std::vector<std::string> cells{scene.contents};
        for (const char* technique : comparedTechniques) cells.push_back(cell(scene, technique, options, deviceName));
        table.add(cells);
        std::cerr << "measured " << scene.name << std::endl;
    }
    printLine(machineName(deviceName) + "; 256 x 256, at most 10 edges.");
    printLine("CPU milliseconds per iteration, float / double = median ratio of " + std::to_string(options.rounds) +
              " interleaved rounds:");
    table.print();
}

}  // namespace antipode::benchmark
