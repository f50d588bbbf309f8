#include "techniques/stage_pipelines.h"

#include <span>
#include <stdexcept>
#include <vector>

#include "kernels/embedded.h"

namespace antipode {
namespace {

using namespace shared;

struct StageRow {
    Stage stage;
    std::span<const uint32_t> (*kernel)(Precision);
    uint32_t variant;
    uint32_t neededTerms;         ///< the stage exists where the technique has one of these; 0: always
    uint32_t neededFeatures = 0;  ///< and the scene all of these
};

constexpr uint32_t lightTerms = TERM_SPLAT | TERM_CONNECT | TERM_MERGE;
constexpr uint32_t cameraTerms = TERM_HIT | TERM_NEXT_EVENT | TERM_CONNECT | TERM_MERGE;

const std::vector<StageRow>& stageTable() {
    static const std::vector<StageRow> rows{
        {Stage::LightEmit, kernels::light_emit, 0, lightTerms},
        {Stage::CameraGenerate, kernels::camera_generate, 0, cameraTerms},
        {Stage::Intersect, kernels::intersect, 0, 0},
        {Stage::StartMedia, kernels::interfaces, 1, 0, FEATURE_INTERFACES},
        {Stage::Interfaces, kernels::interfaces, 0, 0, FEATURE_INTERFACES},
        {Stage::LightScatter, kernels::light_scatter, 0, lightTerms},
        {Stage::CameraScatter, kernels::camera_scatter, 0, cameraTerms},
        {Stage::Connect, kernels::connect, 0, TERM_CONNECT},
        {Stage::Merge, kernels::merge, 0, TERM_MERGE},
        {Stage::Shadow, kernels::shadow, 0, TERM_NEXT_EVENT | TERM_CONNECT},
        {Stage::ShadowSplat, kernels::shadow, 1, TERM_SPLAT},
        {Stage::Develop, kernels::develop, 0, cameraTerms},
        {Stage::CompactCount, kernels::compact_count, 0, TERM_CONNECT | TERM_MERGE},
        {Stage::CompactScan, kernels::exclusive_scan, 0, TERM_CONNECT | TERM_MERGE},
        {Stage::CompactWrite, kernels::compact_write, 0, TERM_CONNECT | TERM_MERGE},
        {Stage::QueueAdvance, kernels::queue_advance, 0, 0},
        {Stage::SortKeys, kernels::sort_keys, 0, TERM_MERGE},
        {Stage::SortCount, kernels::sort_count, 0, TERM_MERGE},
        {Stage::SortScan, kernels::exclusive_scan, 1, TERM_MERGE},
        {Stage::SortScatter, kernels::sort_scatter, 0, TERM_MERGE},
        {Stage::SortGather, kernels::sort_gather, 0, TERM_MERGE},
        {Stage::CellMaximum, kernels::cell_maximum, 0, TERM_MERGE},
    };
    return rows;
}

}  // namespace

StagePipelines::StagePipelines(Device& device, const BindingTable& table, const PackedScene& scene, const Job& job,
                               const SetUpStep& step) {
    for (const StageRow& row : stageTable()) {
        const bool needed = row.neededTerms == 0 || (job.plan.terms & row.neededTerms) != 0 ||
                            (row.neededTerms == cameraTerms && job.plan.cameraPaths);  // guides have no term
        if (!needed || (row.neededFeatures & ~scene.features) != 0) continue;
        step("compiling kernels");
        const bool scan = row.stage == Stage::CompactScan || row.stage == Stage::SortScan;
        pipelines_.emplace(std::piecewise_construct, std::forward_as_tuple(row.stage),
                           std::forward_as_tuple(device, table, row.kernel(job.precision),
                                                 std::vector<std::pair<uint32_t, uint32_t>>{
                                                     {SPEC_FEATURES, scene.features | job.features},
                                                     {SPEC_LOBES, scene.lobes},
                                                     {SPEC_TECHNIQUE, job.plan.terms},
                                                     {SPEC_STACK_DEPTH, std::max(scene.bvh.stackDepth, 1u)},
                                                     {SPEC_VARIANT, row.variant},
                                                     {SPEC_LAYERS, job.layers},
                                                     {SPEC_GROUP_SIZE, scan && !device.isCpu() ? 256u : groupSize_}}));
    }
}

const ComputePipeline& StagePipelines::operator[](Stage stage) const {
    const auto found = pipelines_.find(stage);
    if (found == pipelines_.end()) throw std::logic_error("the technique does not have this stage");
    return found->second;
}

}  // namespace antipode
