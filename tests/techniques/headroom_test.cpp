// Lamps so close to what they light that the film's sums are hard pressed.
#include <cmath>
#include <numbers>

#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

/// A lamp of intensity 1 at `height` over a floor of reflectance 0.8, and a camera that sees nothing but the spot below
/// it, a hundredth of the height across.
Scene lampOverSpot(float height) {
    Scene scene;
    addHorizontalSquare(scene, {0, 0, 0}, 1, addLambert(scene, Vec3f(0.8f)));
    addPointLight(scene, {0, 0, height}, Vec3f(1.0f));
    const float away = 100 * height;
    scene.camera = lookAt({away, 0, away}, {0, 0, 0}, {0, 0, 1}, 0.01 * double(height) / double(away));
    return scene;
}

class HeadroomTest : public EngineTest {};

// Radiance below the lamp: 0.8/π · 1/h², to the 2·10⁻⁴ that the spot's border is darker by.
TEST_F(HeadroomTest, SpotsUnderLampsAreRight) {
    for (const float height : {1e-2f, 1e-4f, 1e-6f})
        for (const char* technique : {"pt", "vcm"}) {
            SCOPED_TRACE(std::string(technique) + " at height " + std::to_string(height));
            RenderSettings settings;
            settings.width = settings.height = 4;
            settings.technique = technique;
            settings.initialRadius = 1e-3 * double(height);
            Engine engine(lampOverSpot(height), settings);
            for (uint64_t i = 1; i <= 64; ++i) engine.render(i);
            EXPECT_EQ(described(engine.sums().events), "");
            const double expected = 0.8 / std::numbers::pi / (double(height) * double(height));
            EXPECT_NEAR(meanOf(engine.sums().image(), {0, 0, 4, 4}, 1) / expected, 1, 1e-3);
        }
}

// No scale has room for it: what does not fit is counted, whether one sample or their sum.
TEST_F(HeadroomTest, WhatDoesNotFitIsCounted) {
    uint64_t tooLarge = 0, beyond = 0;
    for (const float height : {3e-7f, 2e-7f, 1e-7f, 3e-8f}) {
        SCOPED_TRACE(height);
        RenderSettings settings;
        settings.width = settings.height = 4;
        settings.technique = "pt";
        Engine engine(lampOverSpot(height), settings);
        const double unit = std::ldexp(1.0, -engine.sums().layout.layers[0].scaleExponent);
        for (uint64_t i = 1; i <= 64; ++i) engine.render(i);
        const double sum = 64 * 0.8 / std::numbers::pi / (double(height) * double(height)) / unit;
        const EventCounts events = engine.sums().events;
        tooLarge += events.at(EventSource::Film, EventKind::Saturated);
        beyond += events.at(EventSource::Film, EventKind::SumOverflow);
        EXPECT_EQ(events.clean(), sum < 0x1p63) << sum;
    }
    EXPECT_GT(tooLarge, 0u);
    EXPECT_GT(beyond, 0u);
}

}  // namespace
}  // namespace antipode::test
