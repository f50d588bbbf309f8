// antipode-server: one device for all clients.
#include <cstdlib>
#include <iostream>

#include <google/protobuf/stubs/logging.h>
#include <spdlog/spdlog.h>

#include "renderengine/devices.h"
#include "renderengine/engine.h"
#include "renderengine/error.h"
#include "server/log.h"
#include "server/server.h"
#include "terminal/exit_codes.h"
#include "terminal/program.h"

namespace {

using namespace antipode;

void run(const std::vector<std::string>& arguments, bool& logsJson) {
    std::optional<ServerOptions> options = parseServerOptions(arguments);
    if (!options) return;
    setUpLog(options->log);
    logsJson = options->log.json;

    if (options->isRelay()) return Server(*options).run();

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
    std::_Exit(exitDeviceLost);
}

}  // namespace

int main(int argc, char** argv) {
    google::protobuf::SetLogHandler(nullptr);  // it complains of peers' bad texts on stderr; we do, where it matters
    bool logsJson = false;
    return antipode::runProgram(
        [&] {
            run({argv + 1, argv + argc}, logsJson);
        },
        [&](const std::string& message) {
            if (logsJson) return spdlog::critical("{}", message);
            antipode::complain("antipode-server", message);
        });
}
