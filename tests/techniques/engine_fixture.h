// What the tests of this folder do with an engine: render iteration by iteration under the validation layer, treat the
// images of iterations as independent samples, and compare their moments. With Sobol' numbers iterations of a class are
// spread more evenly than independent ones: their mean errs less than these moments say, and tests reject by chance
// less often than they state.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "renderengine/engine.h"
#include "support/statistics.h"

namespace antipode::test {

/// Significance of every family of tests in this folder; each test within is corrected for the family's size (Šidák).
constexpr double kAlpha = 0.01;

/// Rectangle of pixels, right and lower edges excluded.
struct Block {
    uint32_t left = 0, top = 0, right = 0, bottom = 0;
};

/// The whole image, then `columns` × `rows` blocks row by row (none where both are 1).
std::vector<Block> blocksOf(uint32_t width, uint32_t height, uint32_t columns, uint32_t rows);

/// Mean of one channel (0 … 2) over a block, in double.
double meanOf(const Image& image, const Block& block, int channel);

/// Moments over iterations of the mean of a block and channel.
Moments momentsOf(const std::vector<Image>& iterations, const Block& block, int channel);

/// The events that are not 0, empty where all are: what a failed test should say.
std::string described(const EventCounts& events);

class EngineTest : public testing::Test {
protected:
    /// Switches the validation layer on, unless the environment already says what to do with it.
    EngineTest();

    /// The images of iterations first … first + count − 1, one by one. Fails the test where the device counted an event
    /// that a correct render never has, or where the validation layer had something to say.
    std::vector<Image> renderEach(const Scene& scene, const RenderSettings& settings, uint64_t count,
                                  uint64_t first = 1);

    /// The sums of the iterations in the order given. Fails like renderEach.
    FilmSums renderSums(const Scene& scene, const RenderSettings& settings, const std::vector<uint64_t>& iterations);

    void expectHealthy(const Engine& engine);
};

}  // namespace antipode::test
