// How a job is parted, checked and given up on.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "renderengine/settings.h"

namespace antipode {

struct CoordinatorOptions {
    std::optional<uint64_t> iterations;  ///< [0, iterations); unlimited without: finishEarly() ends it
    /// Blocks are asked for one by one and given back one by one (Coordinator::ask()), all of one class of devices:
    /// neither `iterations` nor `errorClasses` applies.
    bool inParts = false;
    bool errorClasses = false;  ///< the image is summed in classes, and leases stay within a run (error_classes.h)
    double targetSeconds = 4;   ///< of a block on its node; blocks get smaller towards the end
    /// What the client can merge: on farms with more nodes, blocks take longer (up to a minute).
    double mostResultsPerSecond = std::numeric_limits<double>::infinity();
    double verifyFraction = 0;  ///< share of blocks that a second node of the same class renders, too
    uint64_t verifySeed = 1;    ///< which ones
    /// The job fails when all is rendered and no node that could make the checks left has been there for so long.
    double verifyPatienceSeconds = 60;
    /// A lease expires when no iteration of it has come for this many times the node's seconds per iteration …
    double patience = 8;
    double leastPatienceSeconds = 10;   ///< … but not sooner than this,
    double firstPatienceSeconds = 120;  ///< and this before the node has finished any iteration, or while its result
                                        ///< is on its way (progress() for each part of it starts the time anew)
};

/// Results of a job that one thread decodes, hashes and adds in a second, with room to spare.
double mergeableResults(const RenderSettings& settings);

}  // namespace antipode
