#include <filesystem>

#include "tests/benchmarks/benchmarks.h"
#include "tests/benchmarks/client_run.h"
#include "tests/benchmarks/markdown.h"
#include "tests/film/temporary_folder.h"

namespace antipode::benchmark {
namespace {

/// Small, so that the iteration itself takes no time to speak of.
constexpr const char* size = "--width 64 --height 64 --iterations 1 --technique ";

struct Costs {
    Samples cpu, wall, setup, iteration;

    void add(const ClientRun& run) {
        cpu.add(run.duration.cpu);
        wall.add(run.duration.wall);
        setup.add(run.stats["setup_seconds"]);
        iteration.add(run.stats["wall_seconds"]);
    }
    std::vector<std::string> row(const std::string& scene, const std::string& technique, const char* cache) const {
        return {scene,
                technique,
                cache,
                fixed(wall.median(), 2),
                fixed(wall.lowest(), 2),
                fixed(cpu.median(), 2),
                fixed(setup.median(), 2),
                fixed(iteration.median(), 2)};
    }
};

}  // namespace

void runStartup(const Options& options) {
    const std::string scenes = ANTIPODE_SOURCE_DIR "/scenes/";
    const std::vector<std::string> own{scenes + "cornell/area.textproto", scenes + "veach_mis.textproto",
                                       scenes + "glass_caustics.textproto", scenes + "pool.textproto"};
    MarkdownTable table({"scene", "technique", "shader cache", "s, median", "s, lowest", "CPU s", "of that: set-up s",
                         "first iteration s"});
    const test::TemporaryFolder folder;
    std::string deviceName;
    for (const std::string& scene : options.scenes.empty() ? own : options.scenes)
        for (const std::string technique : {"pt", "vcm"}) {
            Costs cold, warm;
            for (uint32_t round = 0; round < options.rounds; ++round) {
                std::filesystem::remove_all(folder.file("cache"));
                const auto run = [&] {
                    return renderWithClient(folder.file("."), "cache", scene, size + technique, options.device);
                };
                cold.add(run());
                const ClientRun second = run();
                warm.add(second);
                deviceName = second.stats["device"];
            }
            const std::string name = std::filesystem::path(scene).stem().string();
            table.add(cold.row(name, technique, "empty"));
            table.add(warm.row(name, technique, "filled"));
        }
    printLine(machineName(deviceName) + "; the client from start to end, one iteration of 64 x 64.");
    table.print();
}

}  // namespace antipode::benchmark
