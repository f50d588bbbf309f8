// antipode-server with a renderer that counts instead of rendering, for tests and benchmarks of the farm.
//
//   counting_server SECONDS_PER_ITERATION honest|liar|black|hanging|failing KERNEL_HASH|- [options of antipode-server]

#include <cstdlib>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "terminal/program.h"
#include "renderengine/error.h"
#include "renderengine/film_scale.h"
#include "server/server.h"
#include "terminal/exit_codes.h"
#include "tests/support/fake_renderer.h"

namespace {

using namespace antipode;

void run(const std::vector<std::string>& arguments) {
    if (arguments.size() < 3) throw Error(ErrorCode::Usage, "three arguments come before the options");
    std::optional<ServerOptions> options = parseServerOptions({arguments.begin() + 3, arguments.end()});
    if (!options) return;
    if (options->limits.deviceBytes == 0) options->limits.deviceBytes = 8ull << 30;
    if (arguments[2] != "-") options->kernelHash = arguments[2];
    spdlog::set_default_logger(spdlog::stderr_color_mt("counting_server"));

    test::FakeOptions fake;
    fake.perIteration = std::chrono::duration<double>(std::stod(arguments[0]));
    fake.lie = arguments[1] == "liar";
    fake.black = arguments[1] == "black";
    if (arguments[1] == "hanging") fake.gate = std::make_shared<test::FakeGate>(0);
    farm::Device device;
    device.set_name("counting");
    device.set_kind("CPU");
    device.set_driver("none");
    device.set_memory_bytes(options->limits.deviceBytes);
    device.set_device_class("counting");
    if (arguments[1] == "failing") fake.failAfter = 5;
    const auto factory = [fake](const Scene& scene, const RenderSettings& settings) {
        test::FakeOptions ofJob = fake;
        ofJob.film = scaledFilmLayout(scene, settings);
        return std::make_unique<test::FakeRenderer>(settings, ofJob);
    };
    Server server(*options, device, factory);
    server.run();
    if (server.deviceLost()) std::_Exit(exitDeviceLost);
}

}  // namespace

int main(int argc, char** argv) {
    return antipode::runProgram("counting_server", [&] { run({argv + 1, argv + argc}); });
}
