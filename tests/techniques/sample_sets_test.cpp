// Which random numbers an iteration draws: a function of the settings and its number alone.
#include "techniques/sample_sets.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "renderengine/error_classes.h"

namespace antipode {
namespace {

Job jobWith(Sampler sampler, std::optional<uint32_t> residueClasses = {}) {
    RenderSettings settings;
    settings.residueClasses = residueClasses;
    Job job;
    job.seed = 7;
    job.sampler = sampler;
    job.film = filmLayout(settings);
    return job;
}

using Key = std::pair<uint32_t, uint32_t>;
Key keyOf(const SampleSet& samples) { return {samples.key0, samples.key1}; }

TEST(SampleSets, IndependentIterationsHaveAKeyEach) {
    const Job job = jobWith(Sampler::Independent);
    for (const uint64_t iteration : {1ull, 2ull, 1000000ull, 1ull << 40}) {
        const auto [key0, key1] = randomKeys(7, iteration);
        const SampleSet expected{key0, key1, 0};
        EXPECT_EQ(cameraSamples(job, iteration), expected);
        EXPECT_EQ(lightSamples(job, iteration), expected);
    }
}

/// A camera set is a class, and its indices count up without a gap.
TEST(SampleSets, EachClassOfIterationsIsASequence) {
    const Job job = jobWith(Sampler::Sobol);
    std::map<uint32_t, Key> keys;
    std::map<uint32_t, uint32_t> next;
    for (uint64_t i = 0; i < 5000; ++i) {
        const uint32_t own = errorClass(i);
        const SampleSet camera = cameraSamples(job, i + 1);
        EXPECT_EQ(keys.emplace(own, keyOf(camera)).first->second, keyOf(camera));
        ASSERT_EQ(camera.index, next[own]++) << i;
    }
    std::set<Key> different;
    for (const auto& [own, key] : keys) different.insert(key);
    EXPECT_EQ(different.size(), errorClasses);
}

/// What a lease may be is an aligned, dyadic part of a sequence: a net.
TEST(SampleSets, RunsAreNets) {
    const Job job = jobWith(Sampler::Sobol);
    for (uint64_t first = 0; first < 5000; first = errorRun(first).end()) {
        const IterationRange run = errorRun(first);
        const SampleSet start = cameraSamples(job, first + 1);
        EXPECT_EQ(start.index % run.count, 0u);
        for (uint64_t i = 0; i < run.count; ++i) EXPECT_EQ(cameraSamples(job, first + 1 + i).index, start.index + i);
    }
}

TEST(SampleSets, ResidueClassesAreSequences) {
    const Job job = jobWith(Sampler::Sobol, 3);
    std::set<Key> keys;
    for (uint64_t i = 0; i < 300; ++i) {
        const SampleSet samples = cameraSamples(job, i + 1);
        keys.insert(keyOf(samples));
        EXPECT_EQ(keyOf(samples), keyOf(cameraSamples(job, i % 3 + 1)));
        EXPECT_EQ(samples.index, i / 3);
    }
    EXPECT_EQ(keys.size(), 3u);
}

/// Where 32 bits of index are used up another set begins.
TEST(SampleSets, NoIndexIsUsedTwice) {
    const Job job = jobWith(Sampler::Sobol, 2);
    const uint64_t full = uint64_t(1) << 33;  // two classes' first sets
    EXPECT_EQ(cameraSamples(job, full).index, 0xFFFFFFFFu);
    EXPECT_EQ(cameraSamples(job, full + 1).index, 0u);
    std::set<Key> keys;
    for (const uint64_t iteration : {uint64_t(1), uint64_t(2), full + 1, full + 2, 2 * full + 1})
        keys.insert(keyOf(cameraSamples(job, iteration)));
    EXPECT_EQ(keys.size(), 5u);
}

TEST(SampleSets, LightPathsOfAnIterationHaveASetOfTheirOwn) {
    const Job job = jobWith(Sampler::Sobol);
    std::set<Key> keys;
    for (uint64_t i = pilotIteration; i < 1000; ++i) {
        keys.insert(keyOf(lightSamples(job, i)));
        EXPECT_EQ(lightSamples(job, i).index, 0u);
    }
    for (uint64_t i = 1; i <= errorClasses; ++i) keys.insert(keyOf(cameraSamples(job, i)));
    EXPECT_EQ(keys.size(), 1000u + errorClasses);
}

}  // namespace
}  // namespace antipode
