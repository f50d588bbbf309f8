#include "tests/calibration/runs.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <sys/resource.h>

#include "renderengine/engine.h"
#include "renderengine/error.h"
#include "renderengine/error_classes.h"

namespace antipode::test {
namespace {

constexpr int32_t scale = 24;

double cpuSeconds() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::vector<float> valuesOf(const Image& image) {
    std::vector<float> values;
    for (const Vec3f& pixel : image.pixels) values.insert(values.end(), {pixel.x, pixel.y, pixel.z});
    return values;
}

template <class Stream, class Use>
void walk(Run& run, Stream& stream, const Use& use) {
    for (std::vector<float>& image : run.iterations) use(stream, image.data(), image.size() * sizeof(float));
    use(stream, run.cpuSeconds.data(), run.cpuSeconds.size() * sizeof(double));
}

}  // namespace

Run renderRun(const Scene& scene, const std::string& name, const RenderSettings& settings, uint64_t count,
              const std::string& keep) {
    const std::string path = keep + "/" + name + "-" + settings.technique + "-" + std::to_string(settings.width) + "x" +
                             std::to_string(settings.height) + "-" + std::to_string(count) + "-" +
                             std::to_string(settings.seed) + "-" + kernelHash().substr(0, 12);
    if (!keep.empty() && std::filesystem::exists(path)) {
        Run run{std::vector(count, std::vector<float>(size_t(3) * settings.width * settings.height)),
                std::vector<double>(count)};
        std::ifstream file(path, std::ios::binary);
        walk(run, file, [](auto& from, auto* to, size_t bytes) { from.read(reinterpret_cast<char*>(to), bytes); });
        if (file) return run;
    }
    Run run;
    Engine engine(scene, settings);
    for (uint64_t i = 1; i <= count; ++i) {
        engine.reset();
        const double before = cpuSeconds();
        engine.render(i);
        run.cpuSeconds.push_back(cpuSeconds() - before);
        const FilmSums sums = engine.sums();
        if (!sums.events.clean())
            throw Error(ErrorCode::Device, name + " with " + settings.technique + " counted what no render should do.");
        run.iterations.push_back(valuesOf(sums.image()));
    }
    // Drivers compile at the first dispatch.
    if (count > 1) run.cpuSeconds[0] = run.cpuSeconds[1];
    if (!keep.empty()) {
        std::filesystem::create_directories(keep);
        std::ofstream file(path, std::ios::binary);
        walk(run, file, [](auto& to, auto* from, size_t bytes) { to.write(reinterpret_cast<char*>(from), bytes); });
    }
    return run;
}

Followed follow(const Run& run, uint32_t width, uint32_t height) {
    FilmSums sums{withErrorClasses({width, height, {{LayerKind::Image, "", "RGB", scale}}}), 0, {}, {}};
    sums.values.resize(sums.layout.values());
    sums.residueIterations.assign(errorClasses, 0);
    Followed followed{{{}}, {std::nullopt}, {0}};
    for (size_t i = 0; i < run.iterations.size(); ++i) {
        const std::span<int64_t> layer = sums.layer(errorClass(i));
        for (size_t v = 0; v < layer.size(); ++v)
            layer[v] += std::llround(std::ldexp(double(run.iterations[i][v]), scale));
        ++sums.residueIterations[errorClass(i)];
        ++sums.iterations;
        followed.images.push_back(valuesOf(sums.image()));
        followed.told.push_back(estimateError(sums));
        followed.cpuSeconds.push_back(followed.cpuSeconds.back() + run.cpuSeconds[i]);
    }
    return followed;
}

}  // namespace antipode::test
