#include "tests/support/fake_renderer.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "renderengine/error.h"

namespace antipode::test {
namespace {

constexpr int32_t scaleExponent = 20;

int64_t valueOf(uint64_t iteration) { return int64_t(1) << (iteration % 40); }

/// SplitMix64's finaliser (Steele, Lea & Flood 2014) of the two.
int64_t noiseOf(uint64_t iteration, uint64_t place) {
    uint64_t value = (iteration << 32 | place) + 0x9E3779B97F4A7C15u;
    value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9u;
    value = (value ^ (value >> 27)) * 0x94D049BB133111EBu;
    return int64_t((value ^ (value >> 31)) & 0xffffff);
}

uint64_t pixelsOf(const RenderSettings& settings) { return uint64_t(settings.width) * settings.height; }

}  // namespace

void FakeGate::pass(uint64_t iteration) {
    if (iteration != iteration_) return;
    std::unique_lock lock(mutex_);
    reached_ = true;
    changed_.notify_all();
    if (!changed_.wait_for(lock, std::chrono::minutes(1), [this] { return released_; }))
        throw Error(ErrorCode::Device, "The test never released the gate.");
}

void FakeGate::release() {
    const std::lock_guard lock(mutex_);
    released_ = true;
    changed_.notify_all();
}

bool FakeGate::waitUntilReached() {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(10), [this] { return reached_; });
}

FakeRenderer::FakeRenderer(const RenderSettings& settings, FakeOptions options)
    : settings_(settings), options_(std::move(options)) {
    reset();
}

void FakeRenderer::render(uint64_t iteration) {
    const uint64_t index = iteration - 1;
    if (options_.gate) options_.gate->pass(index);
    if (options_.failAt == index)
        throw Error(ErrorCode::Device, "The device failed at iteration " + std::to_string(index) + ".");
    if (options_.failAfter && rendered_++ >= *options_.failAfter) throw Error(ErrorCode::Device, "The device is lost.");
    if (options_.perIteration.count() > 0 && !options_.black) std::this_thread::sleep_for(options_.perIteration);
    const FilmSums one = fakeSums(settings_, {{index, 1}}, options_.noise);
    for (size_t i = 0; i < one.values.size() && !options_.black; ++i) sums_.values[i] += one.values[i];
    for (size_t k = 0; k < one.residueIterations.size(); ++k) sums_.residueIterations[k] += one.residueIterations[k];
    if (options_.lie) ++sums_.values.front();
    if (options_.bomb) sums_.values.front() = int64_t(3) << 61;
    ++sums_.iterations;
}

void FakeRenderer::reset() {
    sums_ = fakeSums(settings_, {});
    if (options_.film) sums_.layout = *options_.film;
}

EngineStatistics FakeRenderer::statistics() const {
    EngineStatistics statistics;
    statistics.rays = sums_.iterations * pixelsOf(settings_);
    statistics.lightPathsPerIteration = settings_.lightPathCount.value_or(pixelsOf(settings_));
    statistics.deviceBytes = sums_.values.size() * sizeof(int64_t);
    statistics.initialRadius = settings_.initialRadius.value_or(1.0);
    return statistics;
}

RendererFactory fakeRenderers(const FakeOptions& options) {
    return [options](const Scene&, const RenderSettings& settings) {
        return std::make_unique<FakeRenderer>(settings, options);
    };
}

FilmSums fakeSums(const RenderSettings& settings, const std::vector<IterationRange>& ranges, bool noise) {
    FilmSums sums{filmLayout(settings), 0, {}, {}};
    for (FilmLayer& layer : sums.layout.layers) layer.scaleExponent = scaleExponent;
    const uint32_t classes = sums.layout.residueClasses();
    std::vector<int64_t> values(sums.layout.layers.size(), 0);
    sums.residueIterations.resize(sums.layout.residueCounts({}).size());
    for (const IterationRange& range : ranges) {
        for (uint64_t i = range.first; i < range.end(); ++i)
            for (size_t layer = 0; layer < values.size(); ++layer)
                if (layer >= classes || layer == i % classes) values[layer] += valueOf(i);
        const std::vector<uint64_t> counts = sums.layout.residueCounts(range);
        for (size_t k = 0; k < counts.size(); ++k) sums.residueIterations[k] += counts[k];
        sums.iterations += range.count;
    }
    sums.values.resize(sums.layout.values());
    for (size_t layer = 0; layer < values.size(); ++layer) std::ranges::fill(sums.layer(layer), values[layer]);
    for (const IterationRange& range : noise ? ranges : std::vector<IterationRange>())
        for (uint64_t i = range.first; i < range.end(); ++i)
            for (size_t k = 0; k < sums.values.size(); ++k) sums.values[k] += noiseOf(i, k);
    return sums;
}

Scene tinyScene() {
    Scene scene;
    scene.name = "tiny";
    scene.materials.push_back({});
    Mesh floor;
    floor.positions = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
    floor.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.meshes.push_back(floor);
    scene.pointLights.push_back({{0, 2, 0}, Vec3f(4.0f)});
    scene.camera.position = {0, 2, 0.5f};
    scene.camera.forward = {0, -1, 0};
    scene.camera.up = {0, 0, -1};
    return scene;
}

Scene mirrorScene() {
    Scene scene = tinyScene();
    Material mirror;
    mirror.kind = MaterialKind::Mirror;
    scene.materials.push_back(mirror);
    scene.spheres.push_back({{0, 5, 0}, 1, 1});
    return scene;
}

}  // namespace antipode::test
