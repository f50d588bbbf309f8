// antipode-server with a renderer that makes noise at a given rate: what a farm of faster devices asks of its client.
//
//   noise_server SECONDS_PER_ITERATION [options of antipode-server]
#include <chrono>
#include <cmath>
#include <random>
#include <thread>

#include <spdlog/spdlog.h>

#include "terminal/program.h"
#include "renderengine/error.h"
#include "renderengine/film_scale.h"
#include "server/server.h"

namespace {

using namespace antipode;

/// Samples as path tracing makes them: exponentially distributed floats, in the film's fixed point.
class NoiseRenderer final : public Renderer {
public:
    NoiseRenderer(const Scene& scene, const RenderSettings& settings, double secondsPerIteration)
        : pause_(secondsPerIteration) {
        sums_.layout = scaledFilmLayout(scene, settings);
        const int scaleExponent = sums_.layout.layers.front().scaleExponent;
        noise_.resize(sums_.layout.values());
        statistics_.initialRadius = *settings.initialRadius;
        std::minstd_rand random(1);
        std::exponential_distribution<float> sample;
        for (int64_t& value : noise_) value = std::llrint(std::ldexp(double(sample(random)), scaleExponent));
        NoiseRenderer::reset();
    }

    void render(uint64_t iteration) override {
        const auto end = std::chrono::steady_clock::now() + pause_;
        const size_t shift = iteration * 7919 % noise_.size();
        for (size_t i = 0; i < noise_.size() - shift; ++i) sums_.values[i] += noise_[i + shift];
        for (size_t i = noise_.size() - shift; i < noise_.size(); ++i)
            sums_.values[i] += noise_[i + shift - noise_.size()];
        ++sums_.iterations;
        std::this_thread::sleep_until(end);
    }
    FilmSums sums() const override { return sums_; }
    void reset() override {
        sums_.iterations = 0;
        sums_.values.assign(noise_.size(), 0);
    }
    EngineStatistics statistics() const override { return statistics_; }

private:
    std::chrono::duration<double> pause_;
    std::vector<int64_t> noise_;
    FilmSums sums_;
    EngineStatistics statistics_;
};

void run(const std::vector<std::string>& arguments) {
    if (arguments.empty()) throw Error(ErrorCode::Usage, "the seconds per iteration come first");
    const double seconds = std::stod(arguments[0]);
    const std::optional<ServerOptions> options = parseServerOptions({arguments.begin() + 1, arguments.end()});
    if (!options) return;
    farm::Device device;
    device.set_name("noise");
    device.set_kind("CPU");
    device.set_device_class("noise");
    Server(*options, device, [seconds](const Scene& scene, const RenderSettings& settings) {
        return std::make_unique<NoiseRenderer>(scene, settings, seconds);
    }).run();
}

}  // namespace

int main(int argc, char** argv) {
    return antipode::runProgram("noise_server", [&] { run({argv + 1, argv + argc}); });
}
