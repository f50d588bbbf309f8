#include "tests/benchmarks/client_run.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "renderengine/error.h"

namespace antipode::benchmark {

ClientRun renderWithClient(const std::string& folder, const std::string& cacheName, const std::string& scene,
                           const std::string& arguments, const std::string& device) {
    namespace fs = std::filesystem;
    const fs::path cache = fs::path(folder) / cacheName;
    fs::create_directories(cache);
    const std::string command =
        "cd '" + folder + "' && MESA_SHADER_CACHE_DIR='" + cache.string() + "' __GL_SHADER_DISK_CACHE_PATH='" +
        cache.string() + "' '" ANTIPODE_BINARY "' render '" + fs::absolute(scene).string() + "' " + arguments +
        (device.empty() ? "" : " --device '" + device + "'") + " --quiet -o image.exr --stats stats.json";
    const double cpu = childrenCpuSeconds(), wall = wallSeconds();
    if (std::system(command.c_str()) != 0) throw Error(ErrorCode::Device, "The client failed: " + command);
    ClientRun run{{childrenCpuSeconds() - cpu, wallSeconds() - wall}, {}};
    std::ifstream file(fs::path(folder) / "stats.json");
    run.stats = nlohmann::json::parse(file);
    return run;
}

}  // namespace antipode::benchmark
