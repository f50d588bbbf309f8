#include <algorithm>
#include <functional>
#include <iostream>

#include "proto/scene_loader.h"
#include "renderengine/engine.h"
#include "tests/benchmarks/benchmarks.h"
#include "tests/benchmarks/clock.h"
#include "tests/benchmarks/markdown.h"

namespace antipode::benchmark {
namespace {

constexpr uint32_t side = 64;
/// The part of the pixels, those of the greatest variance, that rests on too few bright samples to be told.
constexpr double leftOut = 0.005;

struct RouletteScene {
    const char* name;
    const char* file;
    uint32_t maxPathLength;              ///< edges, with and without roulette
    std::function<void(Scene&)> change;  ///< of what the file says
};

void setAlbedos(Scene& scene, const std::function<Vec3f(const Vec3f&)>& albedo) {
    for (Material& m : scene.materials)
        if (m.kind == MaterialKind::Lambert) m.baseColor = albedo(m.baseColor);
}

void makeDarkBall(Scene& scene) {
    for (Material& m : scene.materials) m.baseColor = Vec3f(0.05f);
}

const std::vector<RouletteScene>& rouletteScenes() {
    static const std::vector<RouletteScene> scenes{
        {"ball of albedo .05 under a sky", "furnace/white", 16, makeDarkBall},
        {"Cornell *area*, albedos × .15", "cornell/area", 32,
         [](Scene& s) { setAlbedos(s, [](const Vec3f& a) { return a * 0.15f; }); }},
        {"Cornell *area*", "cornell/area", 10, [](Scene&) {}},
        {"Cornell *area*, walls of .95", "cornell/area", 64,
         [](Scene& s) { setAlbedos(s, [](const Vec3f&) { return Vec3f(0.95f); }); }},
        {"glass caustics", "glass_caustics", 32, [](Scene&) {}},
    };
    return scenes;
}

/// Iterations of one engine as samples of each pixel's luminance.
class Estimate {
public:
    Estimate(const Scene& scene, const RenderSettings& settings, const std::string& device)
        : engine_(scene, settings, device), sum_(size_t(side) * side), squares_(sum_) {
        engine_.render(1);  // drivers compile at the first dispatch
    }

    void add() {
        engine_.reset();
        cpuSeconds_ += timed([&] { engine_.render(++iterations_); }).cpu;
        const Image image = engine_.sums().image();
        for (size_t p = 0; p < sum_.size(); ++p) {
            const double value = double(luminance(image.pixels[p]));
            sum_[p] += value, squares_[p] += value * value;
        }
    }

    double mean(size_t pixel) const { return sum_[pixel] / double(iterations_); }
    double cpuSeconds() const { return cpuSeconds_; }
    std::string deviceName() const { return engine_.deviceName(); }

    /// relMSE of one iteration against `means`, without the pixels of the greatest.
    double relativeVariance(const std::vector<double>& means) const {
        std::vector<double> values(sum_.size());
        for (size_t p = 0; p < values.size(); ++p) {
            const double m = mean(p), n = double(iterations_);
            values[p] = (squares_[p] / n - m * m) * n / (n - 1) / (means[p] * means[p] + 0.01);
        }
        std::ranges::sort(values);
        const size_t kept = values.size() - size_t(leftOut * double(values.size()));
        double total = 0;
        for (size_t i = 0; i < kept; ++i) total += values[i];
        return total / double(kept);
    }

private:
    Engine engine_;
    uint64_t iterations_ = 0;
    double cpuSeconds_ = 0;
    std::vector<double> sum_, squares_;
};

/// "variance × time = ratio" of rendering with roulette to rendering without.
std::string cell(const Scene& scene, const RouletteScene& row, const char* technique, const Options& options,
                 std::string& deviceName) {
    RenderSettings settings;
    settings.width = settings.height = side;
    settings.technique = technique;
    settings.maxPathLength = row.maxPathLength;
    Estimate with(scene, settings, options.device);
    settings.russianRoulette = false;
    Estimate without(scene, settings, options.device);
    deviceName = with.deviceName();
    for (uint32_t round = 0; round < options.rounds; ++round) with.add(), without.add();
    std::vector<double> means(size_t(side) * side);
    for (size_t p = 0; p < means.size(); ++p) means[p] = 0.5 * (with.mean(p) + without.mean(p));
    const double variance = with.relativeVariance(means) / without.relativeVariance(means);
    const double time = with.cpuSeconds() / without.cpuSeconds();
    return fixed(variance, 2) + " × " + fixed(time, 2) + " = **" + fixed(variance * time, 2) + "**";
}

}  // namespace

void runRoulette(const Options& options) {
    constexpr std::array techniques{"pt", "bpt", "vcm"};
    MarkdownTable table({"scene", "edges", techniques[0], techniques[1], techniques[2]});
    std::string deviceName;
    for (const RouletteScene& row : rouletteScenes()) {
        Scene scene = loadScene(ANTIPODE_SOURCE_DIR "/scenes/" + std::string(row.file) + ".textproto");
        row.change(scene);
        std::vector<std::string> cells{row.name, std::to_string(row.maxPathLength)};
        for (const char* technique : techniques) cells.push_back(cell(scene, row, technique, options, deviceName));
        table.add(cells);
        std::cerr << "measured " << row.name << std::endl;
    }
    printLine(machineName(deviceName) + "; 64 x 64, " + std::to_string(options.rounds) + " interleaved iterations.");
    printLine("Roulette beside none: relative variance × CPU time = ratio of times to equal error:");
    table.print();
}

}  // namespace antipode::benchmark
