#include <iostream>

#include "tests/benchmarks/benchmarks.h"
#include "tests/benchmarks/clock.h"
#include "tests/benchmarks/cornell.h"
#include "tests/benchmarks/markdown.h"
#include "tests/benchmarks/published.h"

namespace antipode::benchmark {
namespace {

constexpr uint32_t side = 512;

struct Cost {
    Samples cpuMilliseconds, wallMilliseconds;
};

/// Rounds over all techniques, so that what slows the machine down for a while slows all of them.
std::array<Cost, 6> measure(const CornellScene& scene, const Options& options, std::string& deviceName) {
    std::vector<Engine> engines;
    for (const char* technique : comparedTechniques) {
        engines.push_back(cornellEngine(scene.name, technique, side, options.device));
        engines.back().render(1);  // drivers compile at the first dispatch
    }
    deviceName = engines.front().deviceName();
    std::array<Cost, 6> costs;
    for (uint32_t round = 0; round < options.rounds; ++round)
        for (size_t i = 0; i < engines.size(); ++i) {
            const Duration d = timed([&] { engines[i].render(2 + round); });
            costs[i].cpuMilliseconds.add(1e3 * d.cpu);
            costs[i].wallMilliseconds.add(1e3 * d.wall);
        }
    return costs;
}

template <class Cell>
std::vector<std::string> row(const CornellScene& scene, const Cell& cell) {
    std::vector<std::string> cells{scene.contents};
    for (size_t i = 0; i < comparedTechniques.size(); ++i) cells.push_back(cell(i));
    return cells;
}

}  // namespace

void runIteration(const Options& options) {
    std::vector<std::string> header{"scene"};
    header.insert(header.end(), comparedTechniques.begin(), comparedTechniques.end());
    MarkdownTable beside(header), medians(header);
    std::string deviceName;
    for (const CornellScene& scene : cornellScenes) {
        const auto costs = measure(scene, options, deviceName);
        beside.add(row(scene, [&](size_t i) {
            const double lowest = costs[i].cpuMilliseconds.lowest(), published = scene.cpuMilliseconds[i];
            return fixed(lowest, 0) + " / " + fixed(published, 0) + " = **" + fixed(lowest / published, 2) + "**";
        }));
        medians.add(row(scene, [&](size_t i) {
            return fixed(costs[i].cpuMilliseconds.median(), 0) + " (" + fixed(costs[i].wallMilliseconds.median(), 0) +
                   ")";
        }));
        std::cerr << "measured " << scene.name << std::endl;
    }
    printLine(machineName(deviceName) + "; 512 x 512, at most 10 edges.");
    printLine("CPU milliseconds per iteration, lowest of " + std::to_string(options.rounds) +
              " interleaved rounds / SmallVCM's lowest = ratio:");
    beside.print();
    printLine("Medians: CPU milliseconds (wall milliseconds):");
    medians.print();
}

}  // namespace antipode::benchmark
