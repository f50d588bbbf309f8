// Which random numbers an iteration draws. Hashes take a key of (seed, iteration). Camera paths' Sobol' sequences go on
// from one iteration to the next: iterations are parted into sets, each with a sequence and a scrambling of its own, so
// that an iteration is still a function of (settings, number) alone.
//
// A set is a class of the iterations that the error is estimated from: the residue class where the settings part the
// image into such, or else the client's (renderengine/error_classes.h). So classes stay independent images of one
// expectation, while each is as good as its sequence makes it; and a run of a class, being aligned and dyadic, is a
// net.
#pragma once

#include "techniques/job.h"

namespace antipode {

/// An iteration's place: the key of its set, and its index there.
struct SampleSet {
    uint32_t key0 = 0, key1 = 0, index = 0;

    bool operator==(const SampleSet&) const = default;
};

/// The iteration that only counts light vertices before a job begins.
inline constexpr uint64_t pilotIteration = 0;

/// Of camera paths. The j-th iteration of a set has index j, of every pixel's own sequence.
SampleSet cameraSamples(const Job& job, uint64_t iteration);
/// Of light paths, of which path p has index p: a set for each iteration. Sets of several would spread light paths more
/// evenly in the end, and merges, which take few of an iteration, less evenly.
SampleSet lightSamples(const Job& job, uint64_t iteration);

/// Two keys of 32 bits: SplitMix64 over (seed, number).
std::pair<uint32_t, uint32_t> randomKeys(uint64_t seed, uint64_t number);

}  // namespace antipode
