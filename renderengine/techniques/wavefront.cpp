#include "techniques/wavefront.h"

#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "renderengine/engine.h"
#include "renderengine/error.h"
#include "techniques/parameter_bytes.h"
#include "techniques/wavelength.h"

namespace antipode {

using namespace shared;

namespace {

// Waves recorded before the host looks whether any path still lives.
constexpr uint32_t wavesPerSubmission = 4;
// Light paths that estimate how many vertices an iteration stores: as many as one has, within these bounds.
constexpr uint64_t fewestPilotPaths = 4096, mostPilotPaths = 65536;
// Workgroups in a row of a dispatch: every device takes 65,535.
constexpr uint32_t longestRow = 1u << 15;

uint32_t groupsFor(uint64_t invocations, uint32_t groupSize) {
    return uint32_t((invocations + groupSize - 1) / groupSize);
}

// layout.h and events.h name the same things.
using enum EventKind;
using enum EventSource;
constexpr bool same(uint32_t shared, auto name) { return shared == uint32_t(name); }
static_assert(EVENT_KINDS == eventKinds && same(EVENT_NON_FINITE, NonFinite) && same(EVENT_NEGATIVE, Negative) &&
              same(EVENT_ZERO_PDF, ZeroPdf) && same(EVENT_SATURATED, Saturated) && same(EVENT_LOOP_LIMIT, LoopLimit) &&
              same(EVENT_STACK_OVERFLOW, StackOverflow) && same(EVENT_OVERFLOW, SumOverflow));
static_assert(EVENT_SOURCES == eventSources && same(SOURCE_EMITTER_HIT, EmitterHit) &&
              same(SOURCE_NEXT_EVENT, NextEvent) && same(SOURCE_CONNECTION, Connection) && same(SOURCE_SPLAT, Splat) &&
              same(SOURCE_MERGE, EventSource::Merge) && same(SOURCE_CAMERA_RAYS, CameraRays) &&
              same(SOURCE_LIGHT_EMISSION, LightEmission) && same(SOURCE_CAMERA_TRACE, CameraTrace) &&
              same(SOURCE_LIGHT_TRACE, LightTrace) && same(SOURCE_CAMERA_SCATTER, EventSource::CameraScatter) &&
              same(SOURCE_LIGHT_SCATTER, EventSource::LightScatter) && same(SOURCE_FILM, Film));

}  // namespace

Wavefront::Wavefront(Device& device, const PackedScene& scene, Job job, uint32_t batchSize, const SetUpStep& step)
    : device_(device),
      job_(std::move(job)),
      scene_(device, scene),
      paths_(device, batchSize, job_, (scene.features & FEATURE_INTERFACES) != 0),
      interfaces_((scene.features & FEATURE_INTERFACES) != 0),
      table_(device, kernelBindings(), sizeof(DispatchParameters<double>)),
      pipelines_(device, table_, scene, job_, step),
      readback_(device, 4ull * COUNTER_COUNT, Residency::HostVisible),
      commands_(device) {
    scene_.bind(table_);
    paths_.bind(table_);
    if ((scene.features & FEATURE_DISPERSION) != 0)
        wavelength_.emplace(device, recordBytes(job_.precision), Residency::HostVisible);
    table_.set(BIND_WAVELENGTH, wavelength_ ? *wavelength_ : paths_.counters());  // something must be bound
    step("counting light vertices");
    estimateLightVertices();
}

void Wavefront::clearFilm() {
    paths_.film().clear();
    clock_.reset();
    events_ = {};
    rays_ = shadowRays_ = lightVertices_ = 0;
}

/// All paths of an iteration have one wavelength, so that any two of its sub-paths can be joined.
void Wavefront::setWavelength(uint64_t iteration) {
    if (!wavelength_) return;
    const Wavelength w = wavelengthOf(job_.seed, iteration);
    const std::vector<std::byte> bytes =
        parameterBytes(Real4<double>{w.response.x, w.response.y, w.response.z, w.dispersion}, job_.precision);
    wavelength_->upload(bytes.data(), bytes.size());
}

// ---- Light vertices: how many there will be --------------------------------------------------------------------

/// Sizes the vertex buffers, and fixes the connections' sample count κ = K·N/M̂. M̂ must not depend on the iteration's
/// own paths: a weight that knew them would bias small images.
void Wavefront::estimateLightVertices() {
    if (!storesVertices() || job_.lightPathCount == 0) {
        allocateVertices(1);
        return;
    }
    setWavelength(pilotIteration);
    const uint64_t paths = std::clamp(job_.lightPathCount, fewestPilotPaths, mostPilotPaths);
    allocateVertices(2 * paths);
    const uint32_t found = tracedVertices(pilotIteration, paths, false);
    // Never 0 vertices: any positive κ is unbiased, but without one what only a connection can make would be lost.
    const double verticesPerPath = double(std::max(found, 1u)) / double(paths);
    const uint64_t storable =
        uint64_t(double(VertexBuffers::greatestCapacity(device_, job_.precision)) / (1.25 * verticesPerPath));
    if (!job_.lightPathCountGiven) job_.lightPathCount = std::min(job_.lightPathCount, storable);
    expectedVertices_ = verticesPerPath * double(job_.lightPathCount);
    allocateVertices(uint64_t(1.1 * expectedVertices_) + 1024);
    clearFilm();
}

void Wavefront::allocateVertices(uint64_t capacity) {
    const uint64_t greatest = VertexBuffers::greatestCapacity(device_, job_.precision);
    if (capacity > greatest)
        throw Error(ErrorCode::Device, "the iteration stores " + std::to_string(capacity) +
                                           " light vertices, but the device can bind only " + std::to_string(greatest) +
                                           "; use fewer light paths (--light-paths)");
    vertices_.reset();
    // From the job and not from the capacity, which grows with what was rendered before: collisions decide where a
    // merge's windows part its sum.
    const uint32_t buckets = std::bit_ceil(std::max(uint32_t(1.1 * expectedVertices_), 64u));
    vertices_.emplace(device_, uint32_t(capacity), paths_.batchSize(),
                      (job_.plan.terms & TERM_MERGE) != 0 ? buckets : 0, job_.precision);
    vertices_->bind(table_);
}

DispatchParameters<double> Wavefront::parametersOf(uint64_t iteration, uint64_t lightPaths) const {
    DispatchParameters<double> p{};
    p.vertexCapacity = vertices_->capacity();
    p.bucketCount = vertices_->bucketCount();
    p.lightPathCount = double(lightPaths);
    const uint32_t terms = job_.plan.terms;
    const double radius = mergeRadius(job_.initialRadius, job_.alpha, std::max<uint64_t>(iteration, 1));
    // As the kernels compare with it, so that the density below is the one of the disk that they search.
    p.radius = job_.precision == Precision::Double ? radius : double(float(radius));
    // A little more than the merge diameter, so that rounding cannot bring a third cell into reach; and at most 2^21
    // cells along the scene, so that their numbers are exact.
    p.cellSize = 2.002 * radius + job_.parameters.sceneCenter.w * 0x1p-20;
    if ((terms & TERM_MERGE) != 0) {
        p.mergeCount = std::numbers::pi * p.radius * p.radius * double(lightPaths);
        p.inverseMergeCount = 1.0 / p.mergeCount;
    }
    if ((terms & TERM_CONNECT) != 0 && expectedVertices_ > 0.0)
        p.connectCount = job_.connectionsPerVertex * double(job_.lightPathCount) / expectedVertices_;
    const bool firstDiffuse = (terms & TERM_FIRST_DIFFUSE) != 0;
    p.hitCount = (terms & TERM_HIT) != 0 && !firstDiffuse ? 1.0 : 0.0;
    p.nextEventCount = (terms & TERM_NEXT_EVENT) != 0 ? 1.0 : 0.0;
    p.splatCount = (terms & TERM_SPLAT) != 0 ? double(lightPaths) : 0.0;
    return p;
}

// ---- An iteration ----------------------------------------------------------------------------------------------

void Wavefront::render(uint64_t iteration) {
    if (const uint32_t classes = job_.film.residueClasses(); classes > 1)
        paths_.film().bind(table_, uint32_t((iteration - 1) % classes));
    setWavelength(iteration);
    uint32_t stored = 0;
    if (job_.plan.lightPaths) {
        stored = tracedVertices(iteration, job_.lightPathCount, true);
        if (stored > vertices_->capacity()) {
            // The splats of this run are complete and stay; the vertices are traced again into larger buffers.
            const uint64_t roomy =
                std::min(uint64_t(1.25 * stored), VertexBuffers::greatestCapacity(device_, job_.precision));
            allocateVertices(std::max(stored, uint32_t(roomy)));
            const EventCounts counted = events_;
            tracedVertices(iteration, job_.lightPathCount, false);
            events_ = counted;  // the same paths', once
        }
    } else {
        push_ = parametersOf(iteration, 0);
    }
    lightVertices_ += stored;
    push_.vertexCount = stored;
    if (stored > 0 && (job_.plan.terms & TERM_CONNECT) != 0)
        push_.connectScale = double(stored) / (double(job_.connectionsPerVertex) * double(job_.lightPathCount));
    maxCell_ = 0;
    if (stored > 0 && (job_.plan.terms & TERM_MERGE) != 0) gridPass();
    if (!job_.plan.cameraPaths) return;
    drawFrom(cameraSamples(job_, iteration));
    cameraPass();
}

void Wavefront::drawFrom(const SampleSet& samples) {
    push_.randomKey0 = samples.key0;
    push_.randomKey1 = samples.key1;
    push_.sampleIndex = samples.index;
}

/// Traces the iteration's light paths; returns how many vertices they have, stored or beyond the buffers' capacity.
uint32_t Wavefront::tracedVertices(uint64_t iteration, uint64_t lightPaths, bool splat) {
    push_ = parametersOf(iteration, lightPaths);
    push_.splatEnabled = splat ? 1u : 0u;
    drawFrom(lightSamples(job_, iteration));
    begin();
    commands_.fill(paths_.counters(), 4ull * COUNTER_VERTICES, 8, 0);
    submit();
    for (uint64_t base = 0; base < lightPaths; base += paths_.batchSize()) {
        push_.pathBase = uint32_t(base);
        push_.batchSize = uint32_t(std::min<uint64_t>(paths_.batchSize(), lightPaths - base));
        begin();
        if (storesVertices()) {
            push_.stageIndex = QUEUE_START;
            run(Stage::QueueAdvance, 1);
            commands_.barrier();
        }
        run(Stage::LightEmit, push_.batchSize);
        mark("light emission");
        recordNextQueue(storesVertices());
        recordMedia(Stage::StartMedia, SOURCE_LIGHT_TRACE);
        wavesUntilDone(true);
    }
    std::array<uint32_t, 2> total{};
    paths_.counters().download(total.data(), sizeof total, 4ull * COUNTER_VERTICES);
    return total[push_.queueParity];
}

/// Sorts the light vertices into the cells of the hash grid, stably.
void Wavefront::gridPass() {
    const uint32_t chunks = groupsFor(push_.vertexCount, SORT_CHUNK);
    begin();
    commands_.fill(vertices_->cells(), 0, vertices_->cells().bytes(), 0);
    commands_.fill(paths_.counters(), 4ull * COUNTER_MAX_CELL, 4, 0);
    push_.stageIndex = 0;
    run(Stage::SortKeys, push_.vertexCount);
    commands_.barrier();
    push_.elementCount = SORT_DIGITS * chunks;
    const uint32_t passes = vertices_->sortPasses();
    for (uint32_t pass = 0; pass < passes; ++pass) {
        push_.stageIndex = pass;
        run(Stage::SortCount, chunks);
        commands_.barrier();
        run(Stage::SortScan, 1);
        commands_.barrier();
        run(Stage::SortScatter, chunks);
        commands_.barrier();
    }
    push_.stageIndex = passes;  // the half that the last pass wrote
    run(Stage::SortGather, push_.vertexCount);
    commands_.barrier();
    run(Stage::CellMaximum, vertices_->bucketCount());
    mark("grid build");
    maxCell_ = submit()[COUNTER_MAX_CELL];
}

void Wavefront::cameraPass() {
    for (uint32_t base = 0; base < job_.pixels; base += paths_.batchSize()) {
        push_.pathBase = base;
        push_.batchSize = std::min(paths_.batchSize(), job_.pixels - base);
        begin();
        run(Stage::CameraGenerate, push_.batchSize);
        mark("camera rays");
        recordNextQueue(false);
        recordMedia(Stage::StartMedia, SOURCE_CAMERA_TRACE);
        wavesUntilDone(false);
        begin();
        run(Stage::Develop, push_.batchSize);
        mark("accumulate");
        submit();
    }
}

void Wavefront::wavesUntilDone(bool light) {
    lightPass_ = light;
    while (true) {
        for (uint32_t wave = 0; wave < wavesPerSubmission; ++wave) light ? recordLightWave() : recordCameraWave();
        if (submit()[COUNTER_QUEUE + push_.queueParity] == 0) return;
        begin();
    }
}

// ---- Waves -----------------------------------------------------------------------------------------------------

/// What live paths are in, at their start or around the surfaces that they met, where transparent bodies touch.
void Wavefront::recordMedia(Stage stage, uint32_t source) {
    if (!interfaces_) return;
    push_.stageIndex = source;
    runIndirect(stage);
    mark("interfaces");
}

void Wavefront::recordLightWave() {
    push_.stageIndex = SOURCE_LIGHT_TRACE;
    runIndirect(Stage::Intersect);
    mark("light trace");
    recordMedia(Stage::Interfaces, SOURCE_LIGHT_TRACE);
    push_.stageIndex = 0;
    runIndirect(Stage::LightScatter);
    mark("light scatter");
    if ((job_.plan.terms & TERM_SPLAT) != 0 && push_.splatEnabled != 0)
        recordShadowRays(Stage::ShadowSplat, 0, "splat visibility");
    recordNextQueue(storesVertices());
}

void Wavefront::recordCameraWave() {
    push_.stageIndex = SOURCE_CAMERA_TRACE;
    runIndirect(Stage::Intersect);
    mark("camera trace");
    recordMedia(Stage::Interfaces, SOURCE_CAMERA_TRACE);
    recordConnections();
    recordMerges();
    push_.stageIndex = 0;
    runIndirect(Stage::CameraScatter);
    mark("camera scatter");
    if ((job_.plan.terms & TERM_NEXT_EVENT) != 0) recordShadowRays(Stage::Shadow, 0, "next-event visibility");
    recordNextQueue(false);
}

void Wavefront::recordConnections() {
    if ((job_.plan.terms & TERM_CONNECT) == 0 || push_.vertexCount == 0) return;
    for (uint32_t k = 1; k <= job_.connectionsPerVertex; ++k) {
        push_.stageIndex = k;
        runIndirect(Stage::Connect);
        mark("connect");
        recordShadowRays(Stage::Shadow, k, "connection visibility");
    }
}

void Wavefront::recordMerges() {
    if ((job_.plan.terms & TERM_MERGE) == 0 || push_.vertexCount == 0) return;
    const uint32_t windows = std::max(1u, groupsFor(8ull * maxCell_, MERGE_WINDOW));
    for (uint32_t window = 0; window < windows; ++window) {
        push_.stageIndex = window;
        runIndirect(Stage::Merge);
        mark("merge");
    }
}

/// Traces a shadow queue; one invocation a live path is always enough.
void Wavefront::recordShadowRays(Stage shadowStage, uint32_t queue, const char* label) {
    push_.stageIndex = queue;
    runIndirect(shadowStage);
    mark(label);
}

/// Makes the queue of the next wave the current one. Where light vertices are stored, the live paths are compacted in
/// order first, which fixes the vertices' indices; elsewhere the paths have appended themselves.
void Wavefront::recordNextQueue(bool inOrder) {
    push_.elementCount = pipelines_.groupSize();
    if (inOrder) {
        runIndirect(Stage::CompactCount, COUNTER_CHUNK_GROUPS);
        commands_.barrier();
        run(Stage::CompactScan, 1);
        commands_.barrier();
        runIndirect(Stage::CompactWrite, COUNTER_CHUNK_GROUPS);
        commands_.barrier();
    }
    push_.stageIndex = inOrder ? QUEUE_COMPACTED : QUEUE_APPENDED;
    run(Stage::QueueAdvance, 1);
    mark("queues");
    push_.queueParity = 1 - push_.queueParity;
}

// ---- Recording -------------------------------------------------------------------------------------------------

void Wavefront::begin() {
    commands_.begin();
    commands_.bind(table_);
    commands_.timestamp("");
    push_.elementCount = pipelines_.groupSize();
}

Wavefront::Counters Wavefront::submit() {
    commands_.copy(paths_.counters(), 0, readback_, 0, readback_.bytes());
    // Statistics and events are read and cleared together, so that no 32-bit count can wrap.
    commands_.barrier();
    commands_.fill(paths_.counters(), 4ull * COUNTER_RAYS, 4ull * (COUNTER_COUNT - COUNTER_RAYS), 0);
    commands_.submitAndWait();
    clock_.add(commands_.timestampSeconds());
    Counters counters(COUNTER_COUNT);
    readback_.download(counters.data(), readback_.bytes());
    countEvents(counters);
    clock_.addRays(lightPass_ ? "light trace" : "camera trace", counters[COUNTER_RAYS]);
    clock_.addRays(lightPass_ ? "splat visibility" : "next-event visibility", counters[COUNTER_SHADOW_RAYS]);
    clock_.addRays("connection visibility", counters[COUNTER_CONNECTION_RAYS]);
    rays_ += counters[COUNTER_RAYS];
    shadowRays_ += counters[COUNTER_SHADOW_RAYS] + counters[COUNTER_CONNECTION_RAYS];
    return counters;
}

void Wavefront::countEvents(const Counters& counters) {
    const uint32_t* count = &counters[COUNTER_EVENTS];
    for (uint32_t source = 0; source < EVENT_SOURCES; ++source)
        for (uint32_t kind = 0; kind < EVENT_KINDS; ++kind)
            events_.at(EventSource(source), EventKind(kind)) += *count++;
}

void Wavefront::run(Stage stage, uint32_t invocations) {
    const bool single = stage == Stage::CompactScan || stage == Stage::SortScan;
    const uint32_t groups = single ? 1 : groupsFor(invocations, pipelines_.groupSize());
    const uint32_t rows = groupsFor(groups, longestRow);
    commands_.dispatch(pipelines_[stage], std::min(groups, longestRow), parameterBytes(push_, job_.precision), rows);
}

void Wavefront::runIndirect(Stage stage, uint32_t counter) {
    commands_.dispatchIndirect(pipelines_[stage], paths_.counters(), 4ull * counter,
                               parameterBytes(push_, job_.precision));
}

/// What was recorded since the last mark is one stage's: its time is taken, and its results are waited for.
void Wavefront::mark(const char* label) {
    commands_.barrier();
    commands_.timestamp(label);
}

}  // namespace antipode
