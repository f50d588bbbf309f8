#include "techniques/sample_sets.h"

#include "renderengine/error_classes.h"

namespace antipode {
namespace {

// Of camera paths' sets, beside the numbers of iterations, which keep below it.
constexpr uint64_t firstCameraSet = uint64_t(1) << 63;

uint64_t splitMix64(uint64_t& state) {
    uint64_t z = state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

SampleSet sampleSet(uint64_t seed, uint64_t number, uint32_t index) {
    const auto [key0, key1] = randomKeys(seed, number);
    return {key0, key1, index};
}

}  // namespace

SampleSet cameraSamples(const Job& job, uint64_t iteration) {
    if (job.sampler == Sampler::Independent) return sampleSet(job.seed, iteration, 0);
    const uint64_t number = iteration - 1, residues = job.film.residueClasses();
    const uint64_t own = residues > 1 ? number % residues : errorClass(number);
    const uint64_t place = residues > 1 ? number / residues : errorClassIndex(number);
    // 32 bits of index, then the next set of the class.
    const uint64_t set = (place >> 32) * SettingsLimits::residueClasses + own;
    return sampleSet(job.seed, firstCameraSet + set, uint32_t(place));
}

SampleSet lightSamples(const Job& job, uint64_t iteration) { return sampleSet(job.seed, iteration, 0); }

std::pair<uint32_t, uint32_t> randomKeys(uint64_t seed, uint64_t number) {
    uint64_t state = seed;
    state = splitMix64(state) ^ (number * 0xD6E8FEB86659FD93u);
    const uint64_t key = splitMix64(state);
    return {uint32_t(key), uint32_t(key >> 32)};
}

}  // namespace antipode
