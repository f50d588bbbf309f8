// What a farm gains, and what it costs its network and its client.
#include <cstdlib>
#include <fstream>
#include <thread>

#include <nlohmann/json.hpp>
#include <sched.h>

#include "renderengine/error.h"
#include "tests/benchmarks/benchmarks.h"
#include "tests/benchmarks/clock.h"
#include "tests/benchmarks/markdown.h"
#include "tests/film/temporary_folder.h"
#include "tests/support/process.h"

namespace antipode::benchmark {
namespace {

using Arguments = std::vector<std::string>;
using test::Process;
using test::ServerProcess;

/// A real server that has one core to itself.
ServerProcess pinnedServer(const test::TemporaryFolder& folder, int core) {
    return {
        {"/usr/bin/env", "LP_NUM_THREADS=1", "/usr/bin/taskset", "--cpu-list", std::to_string(core), ANTIPODE_SERVER},
        folder.file("."),
        "server" + std::to_string(core)};
}

struct FarmRun {
    nlohmann::json stats;
    double clientCpuSeconds = 0;
};

FarmRun render(const test::TemporaryFolder& folder, const std::string& scene, const Arguments& options,
               std::vector<ServerProcess*> servers) {
    Arguments command{ANTIPODE_BINARY, "render", scene, "--quiet", "-o", "image.exr", "--stats", "stats.json"};
    command.insert(command.end(), options.begin(), options.end());
    for (ServerProcess* server : servers) command.insert(command.end(), {"--server", server->address()});
    const double cpu = childrenCpuSeconds();
    Process client(command, folder.file("."), folder.file("client.log"));
    if (client.wait(3600) != 0) throw Error(ErrorCode::Device, "The client failed: " + client.output());
    std::ifstream file(folder.file("stats.json"));
    return {nlohmann::json::parse(file), childrenCpuSeconds() - cpu};
}

double iterationsPerSecond(const FarmRun& run) {
    return run.stats["iterations"].get<double>() / run.stats["wall_seconds"].get<double>();
}

uint64_t bytesReceived(const FarmRun& run) {
    uint64_t bytes = 0;
    for (const auto& node : run.stats["nodes"]) bytes += node["bytes_received"].get<uint64_t>();
    return bytes;
}

uint64_t results(const FarmRun& run) {
    uint64_t count = 0;
    for (const auto& node : run.stats["nodes"]) count += node["results"].get<uint64_t>();
    return count;
}

/// Two servers with a core each against one of them, in turn.
void printScaling(const Options& options, const std::string& scene) {
    const test::TemporaryFolder folder;
    ServerProcess first = pinnedServer(folder, 0), second = pinnedServer(folder, 1);
    const Arguments job{"--width", "256", "--height", "256", "--iterations", "64"};
    Samples alone0, alone1, together, cpu;
    std::string hash;
    for (uint32_t round = 0; round <= options.rounds; ++round) {
        const FarmRun one = render(folder, scene, job, {&first}), other = render(folder, scene, job, {&second}),
                      both = render(folder, scene, job, {&first, &second});
        for (const FarmRun* run : {&one, &other, &both}) {
            if (hash.empty()) hash = run->stats["sums_sha256"];
            if (run->stats["sums_sha256"] != hash) throw Error(ErrorCode::Device, "the images differ");
        }
        if (round == 0) continue;  // compiles the kernels
        alone0.add(iterationsPerSecond(one));
        alone1.add(iterationsPerSecond(other));
        together.add(iterationsPerSecond(both));
        cpu.add(both.clientCpuSeconds);
    }
    const double ideal = alone0.median() + alone1.median();
    printLine("Two servers, a core each, 256 x 256, vcm, 64 iterations, medians of " + std::to_string(options.rounds) +
              " interleaved rounds; all images have the same hash.");
    MarkdownTable table(
        {"server on core 0, it/s", "on core 1, it/s", "both, it/s", "share of the sum", "client, CPU s"});
    table.add({fixed(alone0.median(), 2), fixed(alone1.median(), 2), fixed(together.median(), 2),
               fixed(100 * together.median() / ideal, 1) + " %", fixed(cpu.median(), 2)});
    table.print();
}

/// Blocks of real sums on the wire.
void printTraffic(const std::string& scene) {
    MarkdownTable table({"image", "iterations", "received, MB", "MB an iteration", "float32 film, MB"});
    const test::TemporaryFolder folder;
    ServerProcess server({ANTIPODE_SERVER}, folder.file("."), "server");
    const struct {
        uint32_t width, height, iterations;
    } cases[] = {{512, 512, 1}, {512, 512, 32}, {1920, 1080, 1}, {1920, 1080, 4}};
    for (const auto& c : cases) {
        const FarmRun run = render(folder, scene,
                                   {"--width", std::to_string(c.width), "--height", std::to_string(c.height),
                                    "--iterations", std::to_string(c.iterations)},
                                   {&server});
        const double megabytes = double(bytesReceived(run)) * 1e-6;
        table.add({std::to_string(c.width) + " x " + std::to_string(c.height), std::to_string(c.iterations),
                   fixed(megabytes, 1), fixed(megabytes / c.iterations, 2),
                   fixed(double(c.width) * c.height * 12e-6, 1)});
    }
    printLine("What servers send, by blocks that take about four seconds each.");
    table.print();
}

/// What merging costs the client, with servers that make noise.
void printMerging(const std::string& scene) {
    MarkdownTable table({"image", "servers", "iterations", "it/s", "received, MB/s", "film sums, MB/s", "client, CPU s",
                         "film sums, MB a CPU s"});
    for (const uint32_t count : {1u, 4u, 16u}) {
        const test::TemporaryFolder folder;
        std::vector<std::unique_ptr<ServerProcess>> servers;
        std::vector<ServerProcess*> pointers;
        for (uint32_t i = 0; i < count; ++i) {
            servers.push_back(std::make_unique<ServerProcess>(Arguments{ANTIPODE_NOISE_SERVER, "0.25"},
                                                              folder.file("."), "server" + std::to_string(i)));
            pointers.push_back(servers.back().get());
        }
        const uint32_t iterations = 64 * count;
        const FarmRun run =
            render(folder, scene, {"--width", "1920", "--height", "1080", "--iterations", std::to_string(iterations)},
                   pointers);
        const double wall = run.stats["wall_seconds"], megabytes = double(bytesReceived(run)) * 1e-6;
        const double merged = double(results(run)) * 1920 * 1080 * 24e-6;
        table.add({"1920 x 1080", std::to_string(count), std::to_string(iterations), fixed(iterationsPerSecond(run), 1),
                   fixed(megabytes / wall, 1), fixed(merged / wall, 0), fixed(run.clientCpuSeconds, 1),
                   fixed(merged / run.clientCpuSeconds, 0)});
    }
    printLine("Servers that make 4 iterations of noise a second; all on this machine.");
    table.print();
}

/// What sixteen servers ask of the client, directly and through relays.
void printRelaying(const std::string& scene) {
    constexpr uint32_t servers = 16, iterations = 512;
    MarkdownTable table({"relays", "it/s", "results", "received, MB", "client, CPU s", "CPU s an iteration",
                         "cores per 100 servers", "relays, CPU s"});
    std::string hash;
    for (const uint32_t relays : {0u, 1u, 2u}) {
        const test::TemporaryFolder folder;
        std::vector<std::unique_ptr<ServerProcess>> processes;
        std::vector<ServerProcess*> offered;
        const auto start = [&](const Arguments& program, const std::string& name, const Arguments& options = {}) {
            processes.push_back(std::make_unique<ServerProcess>(program, folder.file("."), name, options));
            return processes.back().get();
        };
        std::vector<Arguments> relayed(std::max(relays, 1u));
        for (uint32_t i = 0; i < servers; ++i) {
            ServerProcess* server = start({ANTIPODE_NOISE_SERVER, "1"}, "server" + std::to_string(i));
            if (relays == 0) offered.push_back(server);
            Arguments& group = relayed[i % relayed.size()];
            group.insert(group.end(), {"--relay", server->address()});
        }
        for (uint32_t i = 0; i < relays; ++i)
            offered.push_back(start({ANTIPODE_SERVER}, "relay" + std::to_string(i), relayed[i]));
        const FarmRun run =
            render(folder, scene, {"--width", "1920", "--height", "1080", "--iterations", std::to_string(iterations)},
                   offered);
        if (hash.empty()) hash = run.stats["sums_sha256"];
        if (run.stats["sums_sha256"] != hash) throw Error(ErrorCode::Device, "the images differ");
        double ofRelays = 0;
        if (relays > 0)
            for (ServerProcess* relay : offered) ofRelays += relay->process().cpuSeconds();
        const double wall = run.stats["wall_seconds"];
        table.add({std::to_string(relays), fixed(iterationsPerSecond(run), 1), std::to_string(results(run)),
                   fixed(double(bytesReceived(run)) * 1e-6, 0), fixed(run.clientCpuSeconds, 1),
                   fixed(run.clientCpuSeconds / iterations, 4), fixed(100 * run.clientCpuSeconds / (wall * servers), 2),
                   fixed(ofRelays, 1)});
    }
    printLine(
        "16 servers that make an iteration of 1080p noise a second, all on this machine; all images have the same "
        "hash.");
    table.print();
}

}  // namespace

void runFarm(const Options& options) {
    const std::string scene =
        options.scenes.empty() ? ANTIPODE_SOURCE_DIR "/scenes/cornell/area.textproto" : options.scenes.front();
    printScaling(options, scene);
    printTraffic(scene);
    printMerging(scene);
    printRelaying(scene);
}

}  // namespace antipode::benchmark
