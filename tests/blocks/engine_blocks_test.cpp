// Blocks of a real engine add up to what it renders by itself.
#include <gtest/gtest.h>

#include "renderengine/engine.h"
#include "tests/blocks/block_log.h"
#include "tests/support/fake_renderer.h"

namespace antipode::test {
namespace {

TEST(EngineBlocks, PartsAddUpToTheWholeAndToTheEngine) {
    RenderSettings settings;
    settings.width = 24;
    settings.height = 16;
    settings.maxPathLength = 6;
    const auto scene = std::make_shared<const Scene>(tinyScene());

    Engine engine(*scene, settings);
    for (uint64_t i = 1; i <= 4; ++i) engine.render(i);
    const FilmSums expected = engine.sums();
    ASSERT_TRUE(expected.events.clean());

    BlockLog log;
    ThreadBlockWorker worker([](const Scene& s, const RenderSettings& r) { return std::make_unique<Engine>(s, r); });
    worker.openJob("tiny", scene, settings, log.ready("tiny"), log.failed("tiny"));
    for (const IterationRange block : {IterationRange{0, 4}, {2, 2}, {0, 2}})
        worker.renderBlock("tiny", block, log.callbacks("tiny"));

    const BlockEvent ready = log.next();
    ASSERT_EQ(ready.kind, BlockEvent::Ready) << ready.message;
    EXPECT_EQ(ready.ready.initialRadius, initialRadius(*scene, settings));
    EXPECT_GT(ready.ready.deviceBytes, 0u);
    const BlockEvent whole = log.next(), later = log.next(), earlier = log.next();
    for (const BlockEvent* event : {&whole, &later, &earlier}) ASSERT_TRUE(event->result) << event->message;
    EXPECT_EQ(whole.result->sha256, expected.sha256());
    EXPECT_GT(whole.result->statistics.rays, 0u);
    FilmSums merged = later.result->sums;
    EXPECT_NE(merged.values, earlier.result->sums.values);
    merged.merge(earlier.result->sums);
    EXPECT_EQ(merged.sha256(), expected.sha256());
    EXPECT_EQ(whole.result->statistics.rays, later.result->statistics.rays + earlier.result->statistics.rays);
}

}  // namespace
}  // namespace antipode::test
