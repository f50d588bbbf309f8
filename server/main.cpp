// antipode-server: one device for all clients.
#include <iostream>
#include <new>

#include <google/protobuf/stubs/logging.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

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
    const std::string selector = device.uuid;
    Server server(*options, describeDevice(device), [selector](const Scene& scene, const RenderSettings& settings) {
        return std::make_unique<Engine>(scene, settings, selector);
    });
    server.run();
}

int complain(const std::string& message, int exitCode) {
    std::cerr << "antipode-server: " << message << std::endl;
    return exitCode;
}

}  // namespace

int main(int argc, char** argv) {
    google::protobuf::SetLogHandler(nullptr);  // it complains of peers' bad texts on stderr; we do, where it matters
    try {
        run({argv + 1, argv + argc});
        return 0;
    } catch (const Error& error) {
        return complain(error.what(), error.code() == ErrorCode::Usage ? 2 : 1);
    } catch (const std::bad_alloc&) {
        return complain("There is not enough memory for this.", 1);
    } catch (const std::exception& error) {
        return complain(std::string("Internal error: ") + error.what(), 1);
    }
}
