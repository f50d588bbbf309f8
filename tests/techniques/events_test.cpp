// Events are counted where they happen: scenes made to fail in one way, and the counts that must say so.
#include "renderengine/error.h"
#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

class EventsTest : public EngineTest {
protected:
    /// A lamp over a floor, in the view of the camera.
    static Scene lampOverFloor(float radiance) {
        Scene scene;
        addHorizontalSquare(scene, {0, 0, 0}, 2, addLambert(scene, Vec3f(0.5f)));
        addHorizontalSquare(scene, {0, 0, 1}, 1.5f, addLamp(scene, Vec3f(radiance), false), false);
        scene.camera = lookAt({0, -3, 0.8f}, {0, 0, 0.5f}, {0, 0, 1}, 0.7);
        return scene;
    }

    static EventCounts eventsOf(const Scene& scene, const std::string& technique) {
        RenderSettings settings;
        settings.width = settings.height = 32;
        settings.technique = technique;
        Engine engine(scene, settings);
        engine.render(1);
        return engine.sums().events;
    }

    static uint64_t notFinite(const EventCounts& events, EventSource source) {
        return events.at(source, EventKind::NonFinite);
    }
};

TEST_F(EventsTest, NoneWhereNothingIsWrong) {
    for (const TechniqueInfo& technique : techniqueTable())
        EXPECT_EQ(described(eventsOf(lampOverFloor(1), technique.name)), "") << technique.name;
}

// A sun on a black sky: what is drawn at the border of its texel must not be looked up in the next one.
TEST_F(EventsTest, NoneUnderABlackSkyWithASun) {
    Scene scene = lampOverFloor(0);
    scene.meshes.pop_back();  // the lamp, which would shade the floor
    Environment& sky = scene.environment.emplace();
    sky.radiance = Vec3f(1.0f);
    sky.width = 64, sky.height = 32;
    sky.zUp = true;
    sky.map.resize(size_t(sky.width) * sky.height);
    sky.map[size_t(5) * sky.width + 17] = Vec3f(1000.0f);
    for (const char* technique : {"pt", "vcm"}) {
        RenderSettings settings;
        settings.width = settings.height = 64;
        settings.technique = technique;
        Engine engine(scene, settings);
        for (uint64_t i = 1; i <= 8; ++i) engine.render(i);
        EXPECT_EQ(described(engine.sums().events), "") << technique;
        EXPECT_GT(engine.sums().image().pixels[64 * 60 + 32].y, 0) << "the sun must reach the floor";
    }
}

// Light that travels in the plane of a floor and meets a wall that stands on it: merging looks at such light from the
// floor, to which it comes under a cosine of exactly 0, by both normals where there are interpolated ones in the scene.
TEST_F(EventsTest, NoneWhereLightTravelsInTheSurface) {
    Scene scene;
    const uint32_t grey = addLambert(scene, Vec3f(0.5f));
    addHorizontalSquare(scene, {0, 0, 0}, 1, grey);
    addQuad(scene, {1, 0, 0.5f}, {0, 0, 0.5f}, {0, 1, 0}, grey);
    scene.meshes.back().normals.assign(4, Vec3f(-1, 0, 0));
    scene.directionalLights.push_back({{1, 0, 0}, Vec3f(1.0f)});
    scene.camera = lookAt({0, -3, 1.5f}, {0.5f, 0, 0.2f}, {0, 0, 1}, 0.7);
    RenderSettings settings;
    settings.width = settings.height = 32;
    settings.initialRadius = 0.3;
    for (const char* technique : {"ppm", "vcm"}) {
        settings.technique = technique;
        Engine engine(scene, settings);
        engine.render(1);
        EXPECT_EQ(described(engine.sums().events), "") << technique;
        EXPECT_GT(meanOf(engine.sums().image(), {0, 0, 32, 32}, 0), 0) << technique << ": the wall must be lit";
    }
}

TEST_F(EventsTest, LightsWithoutPowerAreRefused) {
    Scene scene = lampOverFloor(1);
    scene.materials[1].emissionTexture = 0;
    scene.textures.push_back({"black", 1, 1, {0, 0, 0, 255}});
    try {
        Engine engine(scene, RenderSettings{});
        FAIL() << "a scene without light was taken";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::Input);
        EXPECT_NE(std::string(error.what()).find("holds no light"), std::string::npos) << error.what();
    }
}

// Radiance of 3·10³⁸ is a float; over a density below 1 it no longer is.
TEST_F(EventsTest, OverflowCountsForTheTechniqueThatMetIt) {
    const Scene scene = lampOverFloor(3e38f);
    const EventCounts vcm = eventsOf(scene, "vcm");
    for (EventSource source : {EventSource::NextEvent, EventSource::Connection, EventSource::Splat, EventSource::Merge,
                               EventSource::LightEmission, EventSource::LightScatter, EventSource::Film})
        EXPECT_GT(notFinite(vcm, source), 0u) << name(source);
    for (EventSource source : {EventSource::CameraRays, EventSource::CameraTrace, EventSource::LightTrace})
        EXPECT_EQ(notFinite(vcm, source), 0u) << name(source);

    const EventCounts pt = eventsOf(scene, "pt");
    EXPECT_GT(notFinite(pt, EventSource::NextEvent), 0u);
    for (EventSource source : {EventSource::Connection, EventSource::Splat, EventSource::Merge,
                               EventSource::LightEmission, EventSource::LightScatter, EventSource::CameraScatter})
        EXPECT_EQ(notFinite(pt, source), 0u) << name(source);
    EXPECT_EQ(described(eventsOf(scene, "pt-naive")), "") << "the radiance itself is finite";
}

// Doubles hold what floats do not.
TEST_F(EventsTest, DoubleHasNoOverflowThere) {
    RenderSettings settings;
    settings.width = settings.height = 16;
    settings.precision = Precision::Double;
    Engine engine(lampOverFloor(3e38f), settings);
    engine.render(1);
    EXPECT_EQ(described(engine.sums().events), "");
}

}  // namespace
}  // namespace antipode::test
