// One variant of a scene: renders, remembers what it took, and goes on where it was.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "client/study/study.h"
#include "renderengine/engine.h"

namespace antipode::study {

class VariantRun {
public:
    /// `statePath`: prefix of its two files. Loads what an earlier run kept of the same job; of another job or build
    /// it takes nothing. Throws Error(Input) where a file is there and broken.
    VariantRun(std::string statePath, JobDefinition job);

    const Spent& spent() const { return spent_; }
    const FilmSums& sums() const { return sums_; }
    std::vector<Snapshot>& snapshots() { return snapshots_; }
    /// Renders the next iteration. The first call builds the engine and renders one iteration that is not counted.
    void step(const Scene& scene, const std::string& device);
    /// Fetches the sums from the device.
    void collect();
    /// Keeps everything. Throws Error(Output).
    void save() const;
    /// Frees the device.
    void close() { engine_.reset(); }
    std::string deviceName() const { return deviceName_; }

private:
    std::string statePath_;
    JobDefinition job_;
    Spent spent_;
    FilmSums sums_;
    std::vector<Snapshot> snapshots_;
    std::optional<Engine> engine_;
    std::string deviceName_;
};

}  // namespace antipode::study
