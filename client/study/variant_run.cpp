#include "client/study/variant_run.h"

#include <chrono>
#include <filesystem>

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "farm/jobs/checkpoint.h"
#include "client/study/study_json.h"
#include "renderengine/error.h"
#include "renderengine/io/files.h"

namespace antipode::study {
namespace {

double processCpuSeconds() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double monotonicSeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void add(std::vector<StageTime>& stages, const std::vector<StageTime>& more) {
    for (const StageTime& stage : more) {
        auto known = stages.begin();
        while (known != stages.end() && known->stage != stage.stage) ++known;
        if (known == stages.end()) known = stages.insert(known, {stage.stage, 0, 0});
        known->seconds += stage.seconds;
        known->rays += stage.rays;
    }
}

}  // namespace

VariantRun::VariantRun(std::string statePath, JobDefinition job)
    : statePath_(std::move(statePath)), job_(std::move(job)) {
    const std::string record = statePath_ + ".json", sums = statePath_ + ".checkpoint";
    if (!std::filesystem::exists(record) || !checkpointExists(sums)) return;
    Checkpoint checkpoint = loadCheckpoint(sums).checkpoint;
    if (checkpoint.job.hash() != job_.hash()) return;
    RunRecord known = decodeRecord(readFileBytes(record), record);
    // A run that was killed between the two files: what it took is not known.
    if (known.spent.iterations != checkpoint.sums.iterations) return;
    spent_ = std::move(known.spent);
    snapshots_ = std::move(known.snapshots);
    deviceName_ = std::move(known.device);
    sums_ = std::move(checkpoint.sums);
}

void VariantRun::step(const Scene& scene, const std::string& device) {
    if (!engine_) {
        engine_.emplace(scene, job_.settings, device);
        deviceName_ = engine_->deviceName();
        engine_->render(spent_.iterations + 1);
        engine_->reset();
    }
    const double wall = monotonicSeconds(), cpu = processCpuSeconds();
    engine_->render(spent_.iterations + 1);
    const double tookCpu = processCpuSeconds() - cpu;
    spent_.wall += monotonicSeconds() - wall;
    spent_.cpu += tookCpu;
    spent_.iterationCpu.add(tookCpu);
    ++spent_.iterations;
}

void VariantRun::collect() {
    if (!engine_) return;
    FilmSums more = engine_->sums();
    if (more.iterations == 0) return;
    if (sums_.iterations == 0)
        sums_ = std::move(more);
    else
        sums_.merge(more);
    add(spent_.stages, engine_->statistics().stages);
    engine_->reset();
}

void VariantRun::save() const {
    Checkpoint checkpoint;
    checkpoint.job = job_;
    checkpoint.committed.add({0, sums_.iterations});
    checkpoint.sums = sums_;
    checkpoint.wallSeconds = spent_.wall;
    writeCheckpoint(statePath_ + ".checkpoint", checkpoint);
    writeFileAtomically(statePath_ + ".json", encodeRecord({spent_, snapshots_, deviceName_}));
}

}  // namespace antipode::study
