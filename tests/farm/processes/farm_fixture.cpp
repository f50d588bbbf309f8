#include "tests/farm/processes/farm_fixture.h"

#include <filesystem>
#include <fstream>

#include "tests/support/fake_renderer.h"

namespace antipode::test {

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

void FarmProcesses::SetUp() {
    std::ofstream(folder.file("scene.textproto")) << "image { width: " << width << " height: " << height << " }\n"
                                                  << R"(material { name: "white" base_color: [0.7, 0.7, 0.7] }
              material { name: "glass" kind: DIELECTRIC ior: 1.5 }
              material { name: "lamp" emission: [8, 7, 6] }
              box { material: "white" low: [-1, -1, -1] high: [1, 1, 1] inward: true }
              sphere { material: "glass" center: [0, -0.5, 0] radius: 0.45 }
              quad { material: "lamp" corner: [-0.3, 0.98, -0.3] edge_u: [0.6, 0, 0] edge_v: [0, 0, 0.6] }
              camera { position: [0, 0, 0.95] look_at: [0, 0, -1] vertical_fov: 70 })";
}

ServerProcess FarmProcesses::countingServer(const std::string& name, double secondsPerIteration,
                                            const std::string& behaviour, const std::vector<std::string>& options,
                                            int port) {
    return {{ANTIPODE_COUNTING_SERVER, std::to_string(secondsPerIteration), behaviour, "-"},
            folder.file("."),
            name,
            options,
            port};
}

ServerProcess FarmProcesses::relay(const std::string& name, const std::vector<ServerProcess*>& servers,
                                   const std::vector<std::string>& options, int port) {
    std::vector<std::string> relayed;
    for (ServerProcess* server : servers) relayed = relayed + std::vector<std::string>{"--relay", server->address()};
    return {{ANTIPODE_SERVER}, folder.file("."), name, relayed + options, port};
}

ServerProcess FarmProcesses::realServer(const std::string& name, const std::vector<std::string>& options, int port) {
    return {{ANTIPODE_SERVER}, folder.file("."), name, options, port};
}

Process FarmProcesses::client(const std::string& name, const std::vector<std::string>& options) {
    return {std::vector<std::string>{ANTIPODE_BINARY, "render", "scene.textproto", "--stats", name + ".json", "-o",
                                     name + ".exr"} +
                options,
            folder.file("."), folder.file(name + ".log")};
}

nlohmann::json FarmProcesses::stats(const std::string& name) const {
    std::ifstream file(folder.file(name + ".json"));
    return nlohmann::json::parse(file);
}

std::string FarmProcesses::hashOf(const std::string& name, Process& process, double seconds) {
    const std::optional<int> exit = process.wait(seconds);
    EXPECT_TRUE(exit.has_value()) << name << " still runs after " << seconds << " s\n" << process.output();
    if (!exit) return "none";
    EXPECT_EQ(*exit, 0) << process.output();
    return *exit == 0 ? stats(name)["sums_sha256"].get<std::string>() : "none";
}

std::string FarmProcesses::countedHash(uint64_t iterations) {
    RenderSettings settings;
    settings.width = width;
    settings.height = height;
    FilmSums sums = fakeSums(settings, {{0, iterations}});
    // Of the scene's lamp, the brightest thing in it.
    for (FilmLayer& layer : sums.layout.layers) layer.scaleExponent = filmScaleExponent(8);
    return sums.sha256();
}

std::string FarmProcesses::standaloneHash(const std::vector<std::string>& options) {
    Process alone = client("alone", options);
    return hashOf("alone", alone);
}

bool FarmProcesses::hasDevice() const {
    Process devices({ANTIPODE_BINARY, "devices"}, folder.file("."), folder.file("devices.log"));
    return devices.wait(30) == 0;
}

}  // namespace antipode::test
