// A job that can go on after its client is gone.
//
//   file    = magic headerBytes header chunk* digest
//   magic   = "antipode checkpoint 1\n"
//   headerBytes = uint64 LE, at most 64 MiB; header = farm.Checkpoint
//   chunk   = uint32 LE bytes, at most 1 MiB, then block_codec's encoding of up to 65,536 sums
//   digest  = SHA-256 of all bytes before it
//
// Written to a temporary file, fsynced and renamed; the file before it is kept as FILE.previous until the next write.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "farm/jobs/iteration_set.h"
#include "farm/jobs/job_definition.h"
#include "renderengine/renderer.h"

namespace antipode {

struct Checkpoint {
    JobDefinition job;
    std::vector<std::string> deviceClasses;  ///< that have contributed
    IterationSet committed;
    FilmSums sums;                ///< of `committed`
    EngineStatistics statistics;  ///< what adds up over iterations
    double wallSeconds = 0;       ///< of rendering, all runs
};

std::string encodeCheckpoint(const Checkpoint& checkpoint);
/// Throws Error(Input) for anything but a whole, consistent checkpoint: nothing is trusted, least of all sizes.
Checkpoint decodeCheckpoint(std::string_view bytes);

/// Throws Error(Output); whatever was at `path` or beside it is then still there. Killed at any instant it leaves a
/// whole checkpoint at `path` or at `path`.previous.
void writeCheckpoint(const std::string& path, const Checkpoint& checkpoint);

/// Whether loadCheckpoint() has anything to read: the file, or the generation before it.
bool checkpointExists(const std::string& path);

struct LoadedCheckpoint {
    Checkpoint checkpoint;
    std::string notice;  ///< a sentence where the previous generation had to be taken
};

/// The file, or where that is missing or torn the previous generation. Throws Error(Input).
LoadedCheckpoint loadCheckpoint(const std::string& path);

/// Throws Error(Usage) with the reason unless `checkpoint` belongs to the job: same scene, settings and kernels.
void requireSameJob(const Checkpoint& checkpoint, const JobDefinition& job);

}  // namespace antipode
