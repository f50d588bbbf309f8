// antipode_benchmark: how fast the renderer is, as Markdown tables.
#include <iostream>
#include <optional>

#include <CLI/CLI.hpp>

#include "renderengine/error.h"
#include "tests/benchmarks/benchmarks.h"

using namespace antipode::benchmark;

namespace {

struct Benchmark {
    const char* name;
    const char* summary;
    void (*run)(const Options& options);
    uint32_t rounds;  ///< by default
};

constexpr Benchmark benchmarks[] = {
    {"iteration", "CPU time per iteration of the Cornell scenes beside SmallVCM's", runIteration, 5},
    {"precision", "CPU time of kernels in double beside float", runPrecision, 5},
    {"convergence", "error at equal CPU time beside SmallVCM's (needs ANTIPODE_SHARED)", runConvergence, 1},
    {"stages", "rays per second and share of time of every stage", runStages, 5},
    {"roulette", "variance and CPU time of Russian roulette beside none", runRoulette, 48},
    {"samplers", "variance and CPU time of Sobol' numbers beside independent ones", runSamplers, 64},
    {"denoising", "error of images before and after denoising", runDenoising, 800},
    {"startup", "time to the first image with empty and with filled shader caches", runStartup, 3},
    {"bvh", "build rate and ray rate of a million triangles beside Embree's", runBvh, 5},
    {"memory", "device memory and peak memory over resolutions", runMemory, 1},
    {"farm", "what servers gain, and what they cost the network and the client", runFarm, 3},
};

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Measures the renderer and prints Markdown tables."};
    app.require_subcommand(1);
    Options options;
    std::optional<uint32_t> rounds;
    for (const Benchmark& benchmark : benchmarks) {
        CLI::App* command = app.add_subcommand(benchmark.name, benchmark.summary);
        command->add_option("--device", options.device, "device by index, UUID or PCI id");
        command
            ->add_option("--rounds", rounds,
                         "interleaved repetitions (default " + std::to_string(benchmark.rounds) + ")")
            ->check(CLI::Range(1u, 100000u));
        command->add_option("--cpu-seconds", options.cpuSeconds, "of rendering per estimate (convergence)")
            ->capture_default_str()
            ->check(CLI::PositiveNumber);
        command->add_option("--technique", options.technique, "what to render with (stages)")->capture_default_str();
        command->add_option("SCENE", options.scenes, "scene files instead of the benchmark's own");
        command->callback([&options, &rounds, benchmark] {
            options.rounds = rounds.value_or(benchmark.rounds);
            benchmark.run(options);
        });
    }
    try {
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const antipode::Error& error) {
        std::cerr << "antipode_benchmark: " << error.what() << std::endl;
        return error.code() == antipode::ErrorCode::Usage ? 2 : 1;
    } catch (const std::exception& error) {
        std::cerr << "antipode_benchmark: " << error.what() << std::endl;
        return 1;
    }
}
