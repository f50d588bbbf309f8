// The kernels' own traversal on given rays.
#pragma once

#include <span>

#include "gpu/gpu_scene.h"
#include "tests/benchmarks/clock.h"
#include "tests/benchmarks/rays.h"
#include "vulkan/commands.h"

namespace antipode::benchmark {

class DeviceRays {
public:
    DeviceRays(Device& device, const PackedScene& packed);

    /// The rays of all `trace`s that follow.
    void load(std::span<const Ray> rays);
    /// Finds every ray's nearest hit. Device time, where the device has timestamps, stands in place of wall time.
    Duration trace();
    /// Distances of the last trace's hits in units of the directions' lengths; infinity where nothing is hit. Throws
    /// Error(Device) where a traversal was cut short.
    std::vector<float> distances() const;

private:
    Device& device_;
    GpuScene scene_;
    BindingTable table_;
    Commands commands_;
    Buffer counters_;
    ComputePipeline pipeline_;
    std::vector<Buffer> rays_, hits_;  ///< none or one each
    uint32_t count_ = 0;
};

}  // namespace antipode::benchmark
