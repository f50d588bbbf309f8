#include <filesystem>

#include "tests/benchmarks/benchmarks.h"
#include "tests/benchmarks/client_run.h"
#include "tests/benchmarks/markdown.h"
#include "tests/film/temporary_folder.h"

namespace antipode::benchmark {
namespace {

struct Resolution {
    uint32_t width, height;
};

constexpr Resolution resolutions[] = {{64, 64}, {256, 256}, {512, 512}, {1024, 1024}, {1920, 1080}};

std::string mebibytes(const nlohmann::json& bytes) { return fixed(bytes.get<double>() / double(1 << 20), 0); }

}  // namespace

void runMemory(const Options& options) {
    const std::vector<std::string> own{ANTIPODE_SOURCE_DIR "/scenes/cornell/area.textproto"};
    const test::TemporaryFolder folder;
    MarkdownTable table({"scene", "technique", "pixels", "device MiB", "bytes per pixel", "client's peak MiB"});
    std::string deviceName;
    for (const std::string& scene : options.scenes.empty() ? own : options.scenes)
        for (const std::string technique : {"pt", "vcm"})
            for (const auto [width, height] : resolutions) {
                const std::string sides = " --width " + std::to_string(width) + " --height " + std::to_string(height);
                const std::string arguments = "--iterations 1 --max-path-length 10 --technique " + technique + sides;
                const ClientRun run = renderWithClient(folder.file("."), "cache", scene, arguments, options.device);
                deviceName = run.stats["device"];
                const double perPixel = run.stats["device_bytes"].get<double>() / (double(width) * height);
                table.add({std::filesystem::path(scene).stem().string(), technique,
                           std::to_string(width) + " x " + std::to_string(height), mebibytes(run.stats["device_bytes"]),
                           fixed(perPixel, 0), mebibytes(run.stats["peak_memory_bytes"])});
            }
    printLine(machineName(deviceName) + "; one iteration. A CPU device's memory is part of the client's.");
    table.print();
}

}  // namespace antipode::benchmark
