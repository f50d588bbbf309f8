// The compute pipelines of a job, specialised to what its scene holds and its technique needs.
#pragma once

#include <map>
#include <utility>

#include "techniques/job.h"
#include "vulkan/pipeline.h"

namespace antipode {

/// The stages of an iteration; one kernel each, some in two variants.
enum class Stage {
    LightEmit,
    CameraGenerate,
    Intersect,
    StartMedia,
    Interfaces,
    LightScatter,
    CameraScatter,
    Connect,
    Merge,
    Shadow,
    ShadowSplat,
    Develop,
    CompactCount,
    CompactScan,
    CompactWrite,
    QueueAdvance,
    SortKeys,
    SortCount,
    SortScan,
    SortScatter,
    SortGather,
    CellMaximum,
};

class StagePipelines {
public:
    StagePipelines(Device& device, const BindingTable& table, const PackedScene& scene, const Job& job,
                   const SetUpStep& step);

    /// The stage's pipeline. Throws std::logic_error where the technique does not have the stage.
    const ComputePipeline& operator[](Stage stage) const;
    /// Invocations of one workgroup of every stage but the scans.
    uint32_t groupSize() const { return groupSize_; }

private:
    uint32_t groupSize_ = 64;
    std::map<Stage, ComputePipeline> pipelines_;
};

}  // namespace antipode
