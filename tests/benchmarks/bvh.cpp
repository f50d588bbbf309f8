#include <cmath>
#include <iostream>
#include <optional>

#include "proto/scene_loader.h"
#include "renderengine/engine.h"
#include "tests/benchmarks/benchmarks.h"
#include "tests/benchmarks/device_rays.h"
#include "tests/benchmarks/embree_scene.h"
#include "tests/benchmarks/markdown.h"
#include "tests/large_scene/cave.h"

namespace antipode::benchmark {
namespace {

constexpr uint32_t imageSide = 1024;

std::string millions(double value) { return fixed(1e-6 * value, 2); }

/// Share of the rays whose nearest hit both find at the same distance, within what rounding in the two intersection
/// tests can differ by.
double agreement(std::span<const float> a, std::span<const float> b) {
    size_t same = 0;
    for (size_t i = 0; i < a.size(); ++i) same += a[i] == b[i] || std::abs(a[i] - b[i]) <= 1e-3f * std::max(a[i], b[i]);
    return double(same) / double(a.size());
}

void measureRays(const std::string& scene, const std::string& name, const std::vector<Ray>& rays, uint32_t rounds,
                 DeviceRays& onDevice, const EmbreeScene& embree, MarkdownTable& table) {
    onDevice.load(rays);
    onDevice.trace();  // drivers compile at the first dispatch
    std::vector<float> expected(rays.size());
    Samples deviceCpu, deviceWall, embreeCpu, embreeWall;
    for (uint32_t round = 0; round < rounds; ++round) {
        const Duration device = onDevice.trace(), other = timed([&] { embree.trace(rays, expected); });
        deviceCpu.add(device.cpu);
        deviceWall.add(device.wall);
        embreeCpu.add(other.cpu);
        embreeWall.add(other.wall);
    }
    const double count = double(rays.size());
    table.add({scene, name, millions(count), millions(count / deviceWall.median()),
               millions(count / embreeWall.median()), millions(count / deviceCpu.lowest()),
               millions(count / embreeCpu.lowest()), fixed(deviceCpu.lowest() / embreeCpu.lowest(), 2),
               fixed(100 * agreement(onDevice.distances(), expected), 3) + " %"});
}

void measureScene(const Scene& scene, const Options& options, Device& device, MarkdownTable& builds,
                  MarkdownTable& rates) {
    Samples buildWall, buildCpu;
    std::optional<PackedScene> packed;
    for (uint32_t round = 0; round < options.rounds; ++round) {
        buildCpu.add(timed([&] { packed = packScene(scene); }).cpu);
        buildWall.add(packed->bvh.buildSeconds);
    }
    const EmbreeScene embree(scene);
    const double primitives = double(packed->bvh.primitiveOrder.size());
    builds.add({scene.name, millions(primitives), fixed(buildWall.median(), 2),
                millions(primitives / buildWall.median()), fixed(buildCpu.lowest(), 2), fixed(embree.buildSeconds(), 2),
                std::to_string(packed->bvh.nodes.size() / Bvh::texelsPerNode), std::to_string(packed->bvh.stackDepth)});

    DeviceRays onDevice(device, *packed);
    const std::vector<Ray> primary = primaryRays(scene.camera, imageSide),
                           diffuse = shuffledDiffuseRays(primary, embree);
    measureRays(scene.name, "primary", primary, options.rounds, onDevice, embree, rates);
    measureRays(scene.name, "diffuse, shuffled", diffuse, options.rounds, onDevice, embree, rates);
    std::cerr << "measured " << scene.name << std::endl;
}

}  // namespace

void runBvh(const Options& options) {
    std::vector<Scene> scenes;
    for (const std::string& path : options.scenes) scenes.push_back(loadScene(path));
    if (scenes.empty()) scenes.push_back(test::caveScene(test::millionTriangleCells));

    MarkdownTable builds({"scene", "M primitives", "tree built in s", "M/s", "CPU s, scene packing included",
                          "Embree's own s", "nodes", "stack"});
    MarkdownTable rates({"scene", "rays", "M", "device M rays/s", "Embree M rays/s", "device M rays/CPU-s",
                         "Embree M rays/CPU-s", "device / Embree time", "same hit"});
    Device device(options.device);
    for (const Scene& scene : scenes) measureScene(scene, options, device, builds, rates);
    printLine(machineName(device.info().name) + "; rounds: " + std::to_string(options.rounds) + ".");
    builds.print();
    printLine(
        "Closest hits of the same rays; Embree: rtcIntersect1 on two threads. Rates per second are medians, per "
        "CPU-second the best:");
    rates.print();
}

}  // namespace antipode::benchmark
