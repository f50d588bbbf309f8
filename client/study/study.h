// A study: one scene after another, rendered by all variants in turns, measured at doubling iterations.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/study/measure.h"
#include "client/study/variants.h"
#include "farm/jobs/job_definition.h"
#include "renderengine/renderer.h"
#include "renderengine/scene.h"

namespace antipode::study {

struct StudyOptions {
    std::vector<std::string> scenes;  ///< paths
    std::string folder;               ///< where results and state go
    std::string base = "vcm", list = "all";
    double budgetSeconds = 30;               ///< wall seconds of rendering of each variant of each scene
    std::optional<double> referenceSeconds;  ///< 8 budgets without
    std::string referencePath, referenceTechnique = "vcm";
    RequestedSize size;
    std::string device;
    uint64_t seed = 1;
};

/// What rendering took so far, set-up and the first iteration of each run (where drivers compile) left out.
struct Spent {
    uint64_t iterations = 0;
    double wall = 0, cpu = 0;  ///< seconds; CPU: of this process, all threads
    Durations iterationCpu;    ///< of single iterations
    std::vector<StageTime> stages;

    /// Seconds of all stages by the device's clock.
    double device() const;
};

/// A variant's image at one time.
struct Snapshot {
    uint64_t iterations = 0;
    double wall = 0, cpu = 0, device = 0;
    TileErrors errors;
    double flip = 0;  ///< mean
};

struct VariantResult {
    Variant variant;
    Spent spent;
    std::vector<Snapshot> snapshots;
    Image image;  ///< of all iterations
};

struct SceneResult {
    std::string name, device;
    Reference reference;
    std::string referenceText;                 ///< how it came about, a sentence
    std::optional<Interval> referencePercent;  ///< its own error, estimated; nothing where it was given
    std::vector<VariantResult> variants;
};

/// What a study tells while it runs, and how it is stopped.
struct StudyHooks {
    std::function<void(const std::string& line, double secondsLeft)> progress;
    std::function<bool()> stop;
};

/// Renders what is not rendered yet; state is kept in options.folder/state, so that another call goes on from there.
/// Stopped early, it returns what there is. Throws Error.
std::vector<SceneResult> runStudy(const StudyOptions& options, const StudyHooks& hooks);

}  // namespace antipode::study
