#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

#include "proto/scene_loader.h"
#include "renderengine/engine.h"
#include "tests/benchmarks/benchmarks.h"
#include "tests/benchmarks/clock.h"
#include "tests/benchmarks/markdown.h"

namespace antipode::benchmark {
namespace {

constexpr uint32_t side = 64, pixels = side * side;
constexpr uint32_t classes = SettingsLimits::residueClasses;
/// The part of the pixels, those of the greatest variance, that the trimmed variance leaves out.
constexpr double leftOut = 0.001;
constexpr std::array techniques{"pt", "bpt", "vcm"};

/// A render whose residue classes are independent images of one expectation.
class Series {
public:
    Series(const Scene& scene, const RenderSettings& settings, const std::string& device)
        : engine_(scene, settings, device) {
        engine_.render(1);  // drivers compile at the first dispatch
        engine_.reset();
    }

    void add() {
        cpu_.add(timed([&] { engine_.render(++iterations_); }).cpu);
    }

    double medianCpuSeconds() const { return cpu_.median(); }
    std::string deviceName() const { return engine_.deviceName(); }

    /// Luminances of the classes' images, class after class.
    std::vector<double> images() const {
        const FilmSums sums = engine_.sums();
        std::vector<double> values;
        for (uint32_t k = 0; k < classes; ++k) {
            const auto layer = sums.layer(k);
            const double scale =
                std::ldexp(1.0 / double(sums.residueIterations[k]), -sums.layout.layers[k].scaleExponent);
            const auto mean = [&](size_t at) { return float(double(layer[at]) * scale); };
            for (size_t p = 0; p < pixels; ++p)
                values.push_back(double(luminance(Vec3f(mean(3 * p), mean(3 * p + 1), mean(3 * p + 2)))));
        }
        return values;
    }

private:
    Engine engine_;
    uint64_t iterations_ = 0;
    Samples cpu_;
};

struct Variance {
    double whole = 0, trimmed = 0;
};

/// relMSE of one class's image against `means`, from how the classes differ.
Variance relativeVariance(const std::vector<double>& images, const std::vector<double>& means) {
    std::vector<double> values(pixels);
    for (size_t p = 0; p < pixels; ++p) {
        double sum = 0, squares = 0;
        for (uint32_t k = 0; k < classes; ++k) {
            const double value = images[k * pixels + p];
            sum += value, squares += value * value;
        }
        values[p] = (squares - sum * sum / classes) / (classes - 1) / (means[p] * means[p] + 0.01);
    }
    std::ranges::sort(values);
    const auto kept = size_t((1 - leftOut) * pixels);
    Variance variance;
    for (size_t i = 0; i < pixels; ++i) {
        variance.whole += values[i] / pixels;
        if (i < kept) variance.trimmed += values[i] / double(kept);
    }
    return variance;
}

/// "whole / trimmed variance × time" of Sobol' numbers over those of independent ones.
std::string cell(const Series& sobol, const Series& independent) {
    const std::vector<double> a = sobol.images(), b = independent.images();
    std::vector<double> means(pixels, 0);
    for (size_t i = 0; i < a.size(); ++i) means[i % pixels] += (a[i] + b[i]) / (2 * classes);
    const Variance own = relativeVariance(a, means), other = relativeVariance(b, means);
    const double trimmed = own.trimmed / other.trimmed;
    const double time = sobol.medianCpuSeconds() / independent.medianCpuSeconds();
    return fixed(own.whole / other.whole, 2) + " / " + fixed(trimmed, 2) + " × " + fixed(time, 2) + " = **" +
           fixed(trimmed * time, 2) + "**";
}

}  // namespace

void runSamplers(const Options& options) {
    std::vector<std::string> files = options.scenes;
    if (files.empty())
        for (const char* name :
             {"cornell/area", "cornell/point", "cornell/sky", "cornell/sun", "glass_caustics", "veach_mis", "pool"})
            files.push_back(ANTIPODE_SOURCE_DIR "/scenes/" + std::string(name) + ".textproto");
    MarkdownTable table({"scene", "technique", "iterations", "variance, all pixels / trimmed × time"});
    std::string deviceName;
    for (const std::string& file : files) {
        const Scene scene = loadScene(file);
        for (const char* technique : techniques) {
            RenderSettings settings;
            settings.width = settings.height = side;
            settings.technique = technique;
            settings.residueClasses = classes;
            Series sobol(scene, settings, options.device);
            settings.sampler = Sampler::Independent;
            Series independent(scene, settings, options.device);
            deviceName = sobol.deviceName();
            for (uint32_t n = 1; n <= options.rounds; ++n) {
                for (uint32_t k = 0; k < classes; ++k) sobol.add(), independent.add();
                // A class of n iterations is what one of the four is that the error of 4·n is estimated from.
                if (n != 4 && n != 16 && n != 64) continue;
                table.add({scene.name, technique, std::to_string(4 * n), cell(sobol, independent)});
            }
        }
        std::cerr << "measured " << scene.name << std::endl;
    }
    printLine(machineName(deviceName) + "; 64 x 64, interleaved iterations, median CPU time of one.");
    printLine(
        "Sobol' numbers beside independent ones: relative variance, of all pixels and without the worst "
        "thousandth, × CPU time = ratio of times to equal error:");
    table.print();
}

}  // namespace antipode::benchmark
