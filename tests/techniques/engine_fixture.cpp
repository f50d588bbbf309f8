#include "tests/techniques/engine_fixture.h"

#include <cstdlib>

namespace antipode::test {

std::vector<Block> blocksOf(uint32_t width, uint32_t height, uint32_t columns, uint32_t rows) {
    std::vector<Block> blocks{{0, 0, width, height}};
    if (columns * rows == 1) return blocks;
    for (uint32_t y = 0; y < rows; ++y)
        for (uint32_t x = 0; x < columns; ++x)
            blocks.push_back(
                {x * width / columns, y * height / rows, (x + 1) * width / columns, (y + 1) * height / rows});
    return blocks;
}

double meanOf(const Image& image, const Block& block, int channel) {
    double sum = 0;
    for (uint32_t y = block.top; y < block.bottom; ++y)
        for (uint32_t x = block.left; x < block.right; ++x)
            sum += double(image.pixels[size_t(y) * image.width + x][channel]);
    return sum / (double(block.right - block.left) * double(block.bottom - block.top));
}

Moments momentsOf(const std::vector<Image>& iterations, const Block& block, int channel) {
    Moments moments;
    for (const Image& image : iterations) moments.add(meanOf(image, block, channel));
    return moments;
}

std::string described(const EventCounts& events) {
    std::string text;
    for (size_t s = 0; s < eventSources; ++s)
        for (size_t k = 0; k < eventKinds; ++k)
            if (const uint64_t count = events.at(EventSource(s), EventKind(k)); count > 0)
                text +=
                    name(EventSource(s)) + std::string(": ") + std::to_string(count) + " " + name(EventKind(k)) + "; ";
    return text;
}

EngineTest::EngineTest() { setenv("ANTIPODE_VALIDATION", "1", 0); }

std::vector<Image> EngineTest::renderEach(const Scene& scene, const RenderSettings& settings, uint64_t count,
                                          uint64_t first) {
    Engine engine(scene, settings);
    std::vector<Image> images;
    for (uint64_t i = first; i < first + count; ++i) {
        engine.reset();
        engine.render(i);
        const FilmSums sums = engine.sums();
        EXPECT_EQ(described(sums.events), "") << "iteration " << i;
        images.push_back(sums.image());
    }
    expectHealthy(engine);
    return images;
}

FilmSums EngineTest::renderSums(const Scene& scene, const RenderSettings& settings,
                                const std::vector<uint64_t>& iterations) {
    Engine engine(scene, settings);
    for (const uint64_t i : iterations) engine.render(i);
    expectHealthy(engine);
    return engine.sums();
}

void EngineTest::expectHealthy(const Engine& engine) {
    EXPECT_EQ(described(engine.sums().events), "");
    for (const std::string& message : engine.validationMessages()) ADD_FAILURE() << message;
}

}  // namespace antipode::test
