// antipode-server: one device for all clients.
#include <cstdlib>
#include <iostream>

#include <google/protobuf/stubs/logging.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "terminal/program.h"
#include "renderengine/devices.h"
#include "renderengine/engine.h"
#include "renderengine/error.h"
#include "server/server.h"

namespace {

using namespace antipode;

void run(const std::vector<std::string>& arguments) {
    std::optional<ServerOptions> options = parseServerOptions(arguments);
    if (!options) return;
    spdlog::set_default_logger(spdlog::stderr_color_mt("antipode-server"));
    spdlog::set_pattern("%Y-%m-%dT%H:%M:%S.%e%z %^%l%$ %v");
    if (options->quiet) spdlog::set_level(spdlog::level::warn);

    const DeviceInfo device = selectDevice(options->device);
    if (options->limits.deviceBytes == 0) options->limits.deviceBytes = device.memoryBytes;
    options->limits.bindingBytes = device.bindingBytes;
    const std::string selector = device.uuid;
    Server server(*options, describeDevice(device), [selector](const Scene& scene, const RenderSettings& settings) {
        return std::make_unique<Engine>(scene, settings, selector);
    });
    server.run();
    if (!server.deviceLost()) return;
    // A driver whose device is lost may never answer to its destruction.
    spdlog::shutdown();
    std::_Exit(Server::deviceLossExit);
}

}  // namespace

int main(int argc, char** argv) {
    google::protobuf::SetLogHandler(nullptr);  // it complains of peers' bad texts on stderr; we do, where it matters
    return antipode::runProgram("antipode-server", [&] { run({argv + 1, argv + argc}); });
}
