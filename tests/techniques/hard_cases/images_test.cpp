// Images of every shape: each pixel, the first and last row and column among them, gets what is its. The image shows a
// floor of its own shape, pixel for pixel, so that what each has to show is known.
#include <algorithm>
#include <cmath>

#include "tests/techniques/hard_cases/hard_case_fixture.h"
#include "tests/techniques/scenes.h"

namespace antipode::test {
namespace {

const char* const kGroup = "Images";

struct Shape {
    uint32_t width, height;

    uint32_t longer() const { return std::max(width, height); }
    bool isStrip() const { return std::min(width, height) == 1 && longer() > 1; }
    double pitch() const { return 1.0 / longer(); }
};

std::string nameOfShape(const Shape& s) { return std::to_string(s.width) + "x" + std::to_string(s.height); }

/// A texture of 2 × 2 texels, whose look-ups are linear in between: the corners (0,0), (1,0), (0,1), (1,1).
Texture linearTexture(const std::array<Vec3f, 4>& corners) {
    Texture texture;
    texture.width = texture.height = 2;
    texture.srgb = false;
    for (const Vec3f& c : corners)
        for (const float value : {c.x, c.y, c.z, 1.0f}) texture.rgba.push_back(uint8_t(255 * value));
    return texture;
}

/// A floor whose longer side is 1, and the camera above it that sees each pixel's square in that pixel. It is a
/// hundredth wider than the image, where the material's texture goes from corner to corner.
Scene imageFloor(const Shape& shape, const Material& material) {
    constexpr float margin = 1.01f;
    const double halfHeight = 0.5 * shape.height * shape.pitch(), distance = 0.5;
    Scene scene;
    scene.materials.push_back(material);
    addQuad(scene, {0, 0, 0}, {margin * float(0.5 * shape.width * shape.pitch()), 0, 0},
            {0, margin * float(halfHeight), 0}, 0);
    for (auto& uv : scene.meshes[0].uvs)
        for (float& x : uv) x = 0.5f + 0.25f * margin * (x > 0 ? 1.0f : -1.0f);
    scene.camera = lookAt({0, 0, float(distance)}, {0, 0, 0}, {0, 1, 0}, 2 * std::atan(halfHeight / distance));
    return scene;
}

RenderSettings settingsOf(const Shape& shape) {
    RenderSettings settings = smallImage(1, 0.01 * shape.pitch());
    settings.width = shape.width;
    settings.height = shape.height;
    return settings;
}

class ImageShapes : public HardCaseTest, public testing::WithParamInterface<Shape> {};

/// The floor emits its own coordinates: red to the right, green upwards. A pixel's only sample comes from its square,
/// so that it shows a place within half a pixel of its middle; the neighbour's is half a pixel or more away.
TEST_P(ImageShapes, EveryPixelSeesItsOwnSquare) {
    const Shape& shape = GetParam();
    Material lamp;
    lamp.baseColor = Vec3f(0.0f);
    lamp.emission = Vec3f(1.0f);
    lamp.emissionTexture = 0;
    Scene scene = imageFloor(shape, lamp);
    scene.textures.push_back(linearTexture({Vec3f{0, 0, 1}, Vec3f{1, 0, 1}, Vec3f{0, 1, 1}, Vec3f{1, 1, 1}}));
    RenderSettings settings = settingsOf(shape);
    settings.lightPathCount = 256;
    double furthest = 0;
    for (const TechniqueInfo& technique : techniqueTable()) {
        settings.technique = technique.name;
        for (const Image& image : samplesOf(scene, settings, 2)) {
            ASSERT_EQ(image.pixels.size(), size_t(shape.width) * shape.height);
            for (uint32_t y = 0; y < shape.height; ++y)
                for (uint32_t x = 0; x < shape.width; ++x) {
                    const Vec3f& pixel = image.pixels[size_t(y) * shape.width + x];
                    furthest = std::max({furthest, std::abs(double(pixel.x) * shape.width - (x + 0.5)),
                                         std::abs((1 - double(pixel.y)) * shape.height - (y + 0.5))});
                    EXPECT_NEAR(pixel.z, 1, 1e-6);
                }
        }
    }
    // Half a pixel, and the float roundings of coordinates of 4096 pixels.
    expectMeasured({kGroup, "a floor that emits its coordinates, " + nameOfShape(shape) + " pixels",
                    "furthest that a pixel sees from its middle, in pixels", 0.502},
                   furthest);
}

/// A floor whose reflectance is 1 − u(1 − v), under a sun; a strip of pixels under the long wall beside it, which a
/// light path hits as often as a narrow strip allows.
struct SplatFloor {
    Shape shape;
    double wallDistance = 0, wallHeight = 0;  ///< 0: a sun

    explicit SplatFloor(const Shape& s) : shape(s) {
        if (s.isStrip()) wallDistance = 0.6 * s.pitch(), wallHeight = s.pitch();
    }

    Scene scene() const {
        Material grey;
        grey.baseColor = Vec3f(1.0f);
        grey.baseColorTexture = 0;
        Scene scene = imageFloor(shape, grey);
        scene.textures.push_back(linearTexture({Vec3f(1.0f), Vec3f(0.0f), Vec3f(1.0f), Vec3f(1.0f)}));
        if (!shape.isStrip()) {
            scene.directionalLights.push_back({{0, 0, -1}, Vec3f(1.0f)});
            return scene;
        }
        // 200 pixels longer than the strip at both ends: what is missing of an endless one is 1e-5.
        const auto half = float(0.5 + 200 * shape.pitch()), up = float(0.5 * wallHeight), d = float(wallDistance);
        const uint32_t lamp = addLamp(scene, Vec3f(1.0f));
        shape.width > 1 ? addQuad(scene, {0, -d, up}, {0, 0, up}, {half, 0, 0}, lamp)
                        : addQuad(scene, {-d, 0, up}, {0, half, 0}, {0, 0, up}, lamp);
        return scene;
    }

    /// Where u goes to the right and v upwards.
    double radiance(double u, double v) const {
        const double reflectance = 1 - u * (1 - v);
        if (!shape.isStrip()) return reflectance / std::numbers::pi;
        // An endless wall at the distance x fills ½(1 − x/√(x² + h²)) of the floor's cosine-weighted hemisphere.
        const double x = ((shape.width > 1 ? v : u) - 0.5) * shape.pitch() + wallDistance;
        return reflectance * 0.5 * (1 - x / std::hypot(x, wallHeight));
    }

    double meanOver(const Block& block) const {
        const uint32_t sub = shape.isStrip() ? 32 : 1;  // the reflectance alone is bilinear
        double sum = 0;
        for (uint32_t y = sub * block.top; y < sub * block.bottom; ++y)
            for (uint32_t x = sub * block.left; x < sub * block.right; ++x)
                sum += radiance((x + 0.5) / (sub * shape.width), 1 - (y + 0.5) / (sub * shape.height));
        return sum / (double(sub * (block.right - block.left)) * (sub * (block.bottom - block.top)));
    }
};

/// The first and the last of `count` rows or columns, and all between: each, or in 8 parts where there are many.
std::vector<std::pair<uint32_t, uint32_t>> partsOf(uint32_t count) {
    if (count == 1) return {};
    std::vector<std::pair<uint32_t, uint32_t>> parts{{0, 1}, {count - 1, count}};
    const uint32_t n = std::min(count - 2, count > 64 ? 8u : 64u);
    for (uint32_t i = 0; i < n; ++i) parts.push_back({1 + i * (count - 2) / n, 1 + (i + 1) * (count - 2) / n});
    return parts;
}

/// Row by row and column by column: a splat in the wrong one, or lost at a border, shows.
TEST_P(ImageShapes, SplatsMeetTheirRowsAndColumns) {
    const Shape& shape = GetParam();
    const SplatFloor floor(shape);
    MeanCase c{.group = kGroup,
               .difficulty = "a floor of known gradient, " + nameOfShape(shape) + " pixels, row and column means"};
    c.scene = floor.scene();
    c.settings = settingsOf(shape);
    c.settings.lightPathCount = shape.isStrip() ? 1 << 20 : 1 << 15;
    c.iterations = shape.isStrip() ? 32 : shape.longer() == 1 ? 192 : 24;  // of one pixel, path tracing has one sample
    c.blocks = {{0, 0, shape.width, shape.height}};
    for (const auto& [first, last] : partsOf(shape.width)) c.blocks.push_back({first, 0, last, shape.height});
    for (const auto& [first, last] : partsOf(shape.height)) c.blocks.push_back({0, first, shape.width, last});
    // A strip's pixel rarely picks the nearby part of the wall: only splats are sharp there.
    c.techniques =
        shape.isStrip() ? std::vector<std::string>{"lt"} : std::vector<std::string>{"pt", "lt", "bpt", "vcm"};
    std::vector<double> expected;
    for (const Block& block : c.blocks) expected.push_back(floor.meanOver(block));
    expectMeans(c, expected);
}

INSTANTIATE_TEST_SUITE_P(Of, ImageShapes,
                         testing::Values(Shape{1, 1}, Shape{7, 5}, Shape{33, 17}, Shape{1, 4096}, Shape{4096, 1}),
                         [](const auto& shape) { return nameOfShape(shape.param); });

}  // namespace
}  // namespace antipode::test
