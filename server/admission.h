// Whether a machine has room for one more job.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "proto/farm.pb.h"
#include "server/render_queue.h"

namespace antipode {

/// What jobs hold, or ask for.
struct JobCosts {
    uint32_t jobs = 0;
    uint64_t deviceBytes = 0, resultBytes = 0, sceneBytes = 0;

    JobCosts& operator+=(const JobCosts& o);
};

farm::Refusal refusal(farm::Refusal::Code code, const std::string& sentence);

/// Refuses a job that is too large for this server whatever else runs.
std::optional<farm::Refusal> refuseSize(const RenderQueueLimits& limits, const JobSize& size, uint64_t sceneBytes);

/// Refuses a job that does not fit in beside the others: TOO_LARGE where it would not fit alone either, else BUSY.
std::optional<farm::Refusal> refuseCosts(const RenderQueueLimits& limits, const JobCosts& held, const JobCosts& asked);

}  // namespace antipode
