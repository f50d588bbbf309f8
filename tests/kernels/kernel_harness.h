// Runs small kernels (probes) that call the kernels' libraries over arrays of inputs, on the device that the tests use.
#pragma once

#include <bit>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu/gpu_scene.h"
#include "kernels_probes.h"
#include "renderengine/events.h"
#include "renderengine/vec.h"
#include "support/random.h"
#include "techniques/film_buffer.h"
#include "tests/vulkan/test_device.h"
#include "vulkan/commands.h"

namespace antipode {

/// Four floats, or the bits of four uint32, that a probe reads or writes.
using Texel = shared::vec4;

inline Texel texel(const Vec3f& v, float w = 0) { return {v.x, v.y, v.z, w}; }
inline Texel texel(const Vec3f& v, uint32_t w) { return {v.x, v.y, v.z, std::bit_cast<float>(w)}; }
inline Vec3f xyz(const Texel& t) { return {t.x, t.y, t.z}; }
inline uint32_t bitsOf(float value) { return std::bit_cast<uint32_t>(value); }

/// What one run reads (each array as long as the first, or empty) or wrote (three arrays of the first input's length).
struct ProbeData {
    std::vector<Texel> a, b, c;
};

/// Four random numbers a texel, below 1, of 24 bits as the kernels' own.
std::vector<Texel> uniformTexels(size_t count, Random& random);

/// A scene in device memory with probes over it. The scene may be left out for libraries that need none.
class KernelHarness {
public:
    KernelHarness(Device& device, const PackedScene& packed, const shared::JobParameters<double>& job);
    explicit KernelHarness(Device& device) : KernelHarness(device, PackedScene{}, {}) {}

    /// Runs the probe once for every element of `inputs.a`. `push.elementCount` is set here.
    ProbeData run(std::span<const uint32_t> probe, const ProbeData& inputs, uint32_t variant = 0,
                  shared::DispatchParameters<float> push = {});

    /// For what else a probe or a stage reads and writes.
    BindingTable& table() { return table_; }

    /// Events counted over all runs.
    uint32_t events(EventSource source, EventKind kind) const;
    /// The film's int64 sums; 64 pixels.
    std::vector<int64_t> film() const;
    void clearFilm();

private:
    void reserve(size_t count);
    const ComputePipeline& pipeline(std::span<const uint32_t> probe, uint32_t variant);

    Device& device_;
    uint32_t features_, lobes_, stackDepth_;
    GpuScene scene_;
    BindingTable table_;
    Commands commands_;
    Buffer job_, counters_;
    FilmBuffer film_;
    std::vector<Buffer> inputs_, outputs_;
    size_t capacity_ = 0;
    std::map<std::pair<const uint32_t*, uint32_t>, ComputePipeline> pipelines_;
};

}  // namespace antipode
