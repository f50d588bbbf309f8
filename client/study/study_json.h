// A study's results as text: what goes on from, and what others read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "client/study/study.h"

namespace antipode::study {

/// What is kept of one variant beside its sums.
struct RunRecord {
    Spent spent;
    std::vector<Snapshot> snapshots;
    std::string device;
};

std::string encodeRecord(const RunRecord& record);
/// Throws Error(Input) that names `path` for anything else.
RunRecord decodeRecord(const std::vector<uint8_t>& bytes, const std::string& path);

/// One line per snapshot: scene, variant, iterations, seconds by each clock, error with its interval, FLIP.
std::string studyCsv(const std::vector<SceneResult>& scenes);
/// All that the page shows but its pictures; with them where `pictures`, as data URLs.
std::string studyJson(const std::vector<SceneResult>& scenes, bool pictures);

}  // namespace antipode::study
