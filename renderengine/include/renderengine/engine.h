// The engine: renders iterations of one job on one device.
#pragma once

#include "renderengine/renderer.h"
#include "renderengine/set_up_step.h"

namespace antipode {

/// The renderer that a Vulkan device runs.
class Engine final : public Renderer {
public:
    /// Validates the scene, builds what it needs on the device that `deviceSelector` names ("" = the best one).
    /// Throws Error.
    Engine(
        const Scene& scene, const RenderSettings& settings, const std::string& deviceSelector = "",
        const SetUpStep& step = [](const char*) {});
    ~Engine() override;
    Engine(Engine&&) noexcept;
    Engine& operator=(Engine&&) noexcept;

    void render(uint64_t iteration) override;
    FilmSums sums() const override;
    void reset() override;
    EngineStatistics statistics() const override;

    std::string deviceName() const;
    /// What the Vulkan validation layer has said since the engine was made; always empty unless the environment
    /// variable ANTIPODE_VALIDATION switched the layer on ("1", or "sync" for missing barriers as well).
    std::vector<std::string> validationMessages() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// r_1 in scene units: settings.initialRadius where it is given, else radiusFactor times the width that a pixel (of an
/// image of at least 256 rows) covers where the camera looks, see techniques/radius.cpp. Scales with the scene.
double initialRadius(const Scene& scene, const RenderSettings& settings);

/// The merge radius of global iteration i ≥ 1: r_1·i^((α−1)/2), in double (Knaus & Zwicker 2011).
double mergeRadius(double initialRadius, double alpha, uint64_t iteration);

/// What a job needs of a device, known before anything is built.
struct JobSize {
    uint64_t triangles = 0, spheres = 0, texels = 0;  ///< texels: of textures and of the environment map
    uint64_t pixels = 0, lightPaths = 0;              ///< light paths: of an iteration
    uint64_t channels = 3;                            ///< of the film, over all layers
    Precision precision = Precision::Float;
    bool curvedTriangles = false;  ///< whether coarse smooth triangles are cut into more
};

/// What the settings tell of a job: all but the scene. Light paths: 0 where the technique traces none.
JobSize sizeOf(const RenderSettings& settings);

/// The device memory in bytes that an engine takes for such a job, estimated generously: how many vertices a light path
/// stores is known only once some are traced. `bindingBytes`: see DeviceInfo; where they hold fewer vertices, fewer
/// light paths are traced.
uint64_t estimateDeviceBytes(const JobSize& size, uint64_t bindingBytes = UINT64_MAX);

/// Lower-case hexadecimal SHA-256 of all kernels. Engines with the same kernels on the same class of device render the
/// same bytes.
std::string kernelHash();

}  // namespace antipode
