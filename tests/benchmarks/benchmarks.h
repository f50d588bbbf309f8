// The benchmarks of antipode_benchmark; each prints Markdown tables to standard output.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace antipode::benchmark {

/// What the command line can set; a benchmark reads what it needs.
struct Options {
    std::string device;               ///< as --device of antipode; "" is the best one
    uint32_t rounds = 5;              ///< interleaved repetitions, of which lowest and median are told
    double cpuSeconds = 12;           ///< per estimate of `convergence`
    std::vector<std::string> scenes;  ///< scene files instead of the benchmark's own
    std::string technique = "vcm";    ///< of `stages`
};

/// CPU milliseconds per iteration: four Cornell scenes, six techniques, beside SmallVCM's.
void runIteration(const Options& options);
/// CPU time of kernels in double beside float.
void runPrecision(const Options& options);
/// relMSE after `cpuSeconds` of rendering, against the references in ANTIPODE_SHARED, beside SmallVCM's.
void runConvergence(const Options& options);
/// Share of time and rays per second of every stage.
void runStages(const Options& options);
/// What Russian roulette costs in variance and saves in CPU time, on dark, bright, closed and glass scenes.
void runRoulette(const Options& options);
/// Variance and CPU time of each sampler beside independent numbers.
void runSamplers(const Options& options);
/// relMSE and FLIP of noisy and denoised images, against references of `rounds` iterations.
void runDenoising(const Options& options);
/// Seconds from the start of the client to its first image, without and with the drivers' shader caches.
void runStartup(const Options& options);
/// Build rate, and closest-hit rays per second of the device and of Embree on the same rays.
void runBvh(const Options& options);
/// Peak resident memory of the client and device memory over resolutions.
void runMemory(const Options& options);
/// Servers with a core each against one; bytes on the wire; CPU time of merging.
void runFarm(const Options& options);

}  // namespace antipode::benchmark
