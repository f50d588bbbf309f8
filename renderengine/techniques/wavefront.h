// The stages of an iteration and their order: light pass, grid, camera pass.
#pragma once

#include <optional>

#include "gpu/gpu_scene.h"
#include "techniques/path_buffers.h"
#include "techniques/sample_sets.h"
#include "techniques/stage_clock.h"
#include "techniques/stage_pipelines.h"
#include "techniques/vertex_buffers.h"
#include "vulkan/commands.h"

namespace antipode {

/// Renders iterations of one job into a film on the device. Paths travel in waves: every stage runs for all live paths
/// of a batch before the next begins, and the dead are compacted away in between, in order, so that light vertices have
/// the same indices whatever the machine.
class Wavefront {
public:
    Wavefront(Device& device, const PackedScene& scene, Job job, uint32_t batchSize, const SetUpStep& step);

    void render(uint64_t iteration);
    void clearFilm();

    const Job& job() const { return job_; }
    std::vector<int64_t> downloadFilm() const { return paths_.film().download(); }
    const EventCounts& events() const { return events_; }
    const StageClock& clock() const { return clock_; }
    uint64_t rays() const { return rays_; }
    uint64_t shadowRays() const { return shadowRays_; }
    uint64_t lightVertices() const { return lightVertices_; }

private:
    using Counters = std::vector<uint32_t>;

    bool storesVertices() const { return (job_.plan.terms & (shared::TERM_CONNECT | shared::TERM_MERGE)) != 0; }
    void estimateLightVertices();
    void setWavelength(uint64_t iteration);
    void allocateVertices(uint64_t capacity);
    shared::DispatchParameters<double> parametersOf(uint64_t iteration, uint64_t lightPaths) const;
    void drawFrom(const SampleSet& samples);
    uint32_t tracedVertices(uint64_t iteration, uint64_t lightPaths, bool splat);
    void gridPass();
    void cameraPass();
    void wavesUntilDone(bool light);
    void recordMedia(Stage stage, uint32_t source);
    void recordLightWave();
    void recordCameraWave();
    void recordConnections();
    void recordMerges();
    void recordNextQueue(bool inOrder);
    void recordShadowRays(Stage shadowStage, uint32_t queue, const char* label);
    void begin();
    Counters submit();
    void run(Stage stage, uint32_t invocations);
    void runIndirect(Stage stage, uint32_t counter = shared::COUNTER_GROUPS);
    void mark(const char* label);
    void countEvents(const Counters& counters);

    Device& device_;
    Job job_;
    GpuScene scene_;
    PathBuffers paths_;
    bool interfaces_;  ///< transparent bodies touch
    BindingTable table_;
    StagePipelines pipelines_;
    std::optional<VertexBuffers> vertices_;
    std::optional<Buffer> wavelength_;  ///< where glass disperses light
    Buffer readback_;
    Commands commands_;
    StageClock clock_;
    EventCounts events_;
    shared::DispatchParameters<double> push_{};
    double expectedVertices_ = 0;  ///< per iteration: the constant M̂ of the connections' sample count
    uint32_t maxCell_ = 0;         ///< most vertices in one bucket of this iteration's grid
    bool lightPass_ = false;       ///< whose rays the counters hold
    uint64_t rays_ = 0, shadowRays_ = 0, lightVertices_ = 0;
};

}  // namespace antipode
