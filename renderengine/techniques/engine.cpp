#include "renderengine/engine.h"

#include <cmath>

#include "renderengine/error.h"
#include "renderengine/film_scale.h"

#include "gpu/curved_triangles.h"
#include "scene/origin.h"
#include "scene/units.h"
#include "techniques/wavefront.h"

namespace antipode {
namespace {

// Paths that travel together: on a CPU few enough for their state to stay in its caches, on a GPU enough to fill it.
constexpr uint32_t smallestBatch = 1u << 12, cpuBatch = 1u << 16, gpuBatch = 1u << 20;

/// Calls `use` with scene and settings as a device gets them: near the origin and in units that floats are fine in;
/// with the vector from the scene's origin to that of the user's positions; and with e, where lengths are those of the
/// scene × 2^e.
template <class Use>
void placed(const Scene& scene, const RenderSettings& settings, const Use& use) {
    RenderSettings complete = settings;
    if (!complete.maxPathLength) complete.maxPathLength = scene.maxPathLength;
    complete.initialRadius = initialRadius(scene, settings);
    const Vec3f origin = remoteCenter(scene);
    const int exponent = unitExponent(scene);
    if (origin == Vec3f{} && exponent == 0) return use(scene, complete, Vec3d{}, 0);
    complete.initialRadius = std::ldexp(*complete.initialRadius, exponent);
    const Vec3d userOrigin = Vec3d(origin) * std::ldexp(1.0, exponent);
    use(inUnits(movedToOrigin(scene, origin), exponent), complete, userOrigin, exponent);
}

/// Lengths of the film in those of the scene.
void setUnits(FilmLayout& film, int exponent) {
    for (FilmLayer& layer : film.layers)
        if (unitOf(layer.kind) == LayerUnit::Length) layer.scaleExponent += exponent;
}

}  // namespace

struct Engine::Impl {
    Device device;
    double bvhBuildSeconds = 0;
    uint64_t primitives = 0, iterations = 0;
    std::vector<uint64_t> residueIterations;
    int unitExponent = 0;  ///< lengths on the device are those of the scene × 2^unitExponent
    std::optional<Wavefront> wavefront;

    explicit Impl(const std::string& selector) : device(selectDevice(selector)) {}
    void requirePrecision(Precision precision) const;
    /// `origin`: the vector from the scene's origin to that of the user's positions.
    void build(const Scene& scene, const RenderSettings& settings, const SetUpStep& step, const Vec3d& origin);
};

Engine::Engine(const Scene& scene, const RenderSettings& settings, const std::string& deviceSelector,
               const SetUpStep& step) {
    step("checking the scene");
    validate(scene);
    planTechnique(settings);  // an unknown name is said before a device is opened
    impl_ = std::make_unique<Impl>(deviceSelector);
    impl_->requirePrecision(settings.precision);
    placed(scene, settings, [&](const Scene& local, const RenderSettings& complete, const Vec3d& origin, int exponent) {
        impl_->unitExponent = exponent;
        impl_->build(local, complete, step, origin);
    });
}

FilmLayout scaledFilmLayout(const Scene& scene, const RenderSettings& settings) {
    validate(scene);
    FilmLayout film;
    placed(scene, settings, [&](const Scene& local, const RenderSettings& complete, const Vec3d& origin, int exponent) {
        std::optional<Scene> curved;
        if (complete.curvedTriangles) curved = curvedScene(local);
        const PackedScene packed = packScene(curved ? *curved : local);
        film = describeJob(local, complete, packed, origin).film;
        setUnits(film, exponent);
    });
    return film;
}

void Engine::Impl::requirePrecision(Precision precision) const {
    if (precision == Precision::Double && !device.hasFloat64())
        throw Error(ErrorCode::Usage,
                    "the device '" + device.info().name +
                        "' has no 64-bit floats; render in single precision (--precision float) or on "
                        "another device");
}

void Engine::Impl::build(const Scene& scene, const RenderSettings& settings, const SetUpStep& step,
                         const Vec3d& origin) {
    std::optional<Scene> curved;
    if (settings.curvedTriangles) {
        step("curving coarse smooth triangles");
        curved = curvedScene(scene);
    }
    const PackedScene packed = packScene(curved ? *curved : scene, step);
    if (packed.lightCount == 0)
        throw Error(ErrorCode::Input,
                    "scene '" + scene.name + "': holds no light: what emits in it has no power at all");
    bvhBuildSeconds = packed.bvh.buildSeconds;
    primitives = packed.bvh.primitiveOrder.size();
    Job job = describeJob(scene, settings, packed, origin);
    const uint64_t widest = std::max<uint64_t>(job.pixels, job.lightPathCount);
    const uint32_t batch = uint32_t(std::clamp<uint64_t>(widest, smallestBatch, device.isCpu() ? cpuBatch : gpuBatch));
    wavefront.emplace(device, packed, std::move(job), batch, step);
}

Engine::~Engine() = default;
Engine::Engine(Engine&&) noexcept = default;
Engine& Engine::operator=(Engine&&) noexcept = default;

void Engine::render(uint64_t iteration) {
    impl_->wavefront->render(iteration);
    ++impl_->iterations;
    const std::vector<uint64_t> counts = impl_->wavefront->job().film.residueCounts({iteration - 1, 1});
    impl_->residueIterations.resize(counts.size());
    for (size_t k = 0; k < counts.size(); ++k) impl_->residueIterations[k] += counts[k];
}

FilmSums Engine::sums() const {
    FilmSums sums;
    sums.layout = impl_->wavefront->job().film;
    setUnits(sums.layout, impl_->unitExponent);
    sums.residueIterations = impl_->residueIterations;
    sums.residueIterations.resize(sums.layout.residueCounts({}).size());
    sums.iterations = impl_->iterations;
    sums.values = impl_->wavefront->downloadFilm();
    sums.events = impl_->wavefront->events();
    return sums;
}

void Engine::reset() {
    impl_->wavefront->clearFilm();
    impl_->iterations = 0;
    impl_->residueIterations.clear();
}

EngineStatistics Engine::statistics() const {
    const Wavefront& w = *impl_->wavefront;
    EngineStatistics s;
    s.stages = w.clock().times();
    s.rays = w.rays();
    s.shadowRays = w.shadowRays();
    s.lightVertices = w.lightVertices();
    s.lightPathsPerIteration = w.job().lightPathCount;
    s.bvhBuildSeconds = impl_->bvhBuildSeconds;
    s.bvhPrimitives = impl_->primitives;
    s.deviceBytes = impl_->device.allocatedBytes();
    s.initialRadius = std::ldexp(w.job().initialRadius, -impl_->unitExponent);
    return s;
}

std::string Engine::deviceName() const { return impl_->device.info().name; }

std::vector<std::string> Engine::validationMessages() const { return impl_->device.instance().validationMessages(); }

}  // namespace antipode
