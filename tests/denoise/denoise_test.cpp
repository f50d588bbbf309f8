// The denoiser on images of known expectation and independent noise: what it must gain, and what it must not lose.
// Noise is drawn with fixed seeds; bounds are far from what was measured (beside each), so that none is met by chance.
#include "renderengine/denoise.h"

#include <cmath>
#include <random>

#include "renderengine/error.h"
#include "renderengine/error_classes.h"
#include "tests/film/expect_error.h"

using namespace antipode;
using test::expectError;

namespace {

constexpr int32_t scale = 24;

/// A picture's parts as they are meant.
struct Picture {
    uint32_t width, height;
    Vec3d (*radiance)(double x, double y);
    double (*albedo)(double x, double y);
};

double texture(double x, double y) { return 0.2 + 0.6 * ((int(std::floor(x / 3)) + int(std::floor(y / 3))) % 2); }
double plain(double, double) { return 0.5; }

/// Soft light on a checkered floor: all detail is in the albedo.
Vec3d litTexture(double x, double y) { return Vec3d(1, 0.8, 0.6) * (texture(x, y) * (0.3 + x / 64)); }
/// A caustic: sharp lines of light on a plain floor, which no feature tells of.
Vec3d caustic(double x, double y) {
    const double line = std::fmod(x + 0.5 * y, 13) < 2 ? 4 : 0;
    return Vec3d(0.4 + line, 0.4 + line, 0.3 + 0.7 * line);
}
Vec3d flat(double, double) { return Vec3d(0.7); }

FilmLayout layout(const Picture& picture) {
    RenderSettings settings;
    settings.width = picture.width;
    settings.height = picture.height;
    settings.layers = denoiserLayers;
    FilmLayout result = withErrorClasses(filmLayout(settings));
    for (FilmLayer& layer : result.layers) layer.scaleExponent = scale;
    return result;
}

int64_t fixedPoint(double value) { return std::llround(std::ldexp(value, scale)); }

/// Iterations of the picture whose samples have this relative standard deviation: exponential about their mean, so
/// that they are skewed as radiance is.
FilmSums render(const Picture& picture, uint64_t iterations, double deviation, uint64_t seed) {
    std::mt19937_64 random(seed);
    std::exponential_distribution<double> exponential;
    FilmSums sums{layout(picture), iterations, {}, {}};
    sums.values.resize(sums.layout.values());
    sums.residueIterations.assign(errorClasses, 0);
    for (uint64_t i = 0; i < iterations; ++i) {
        ++sums.residueIterations[errorClass(i)];
        const std::span<int64_t> image = sums.layer(errorClass(i));
        for (uint32_t p = 0; p < picture.width * picture.height; ++p) {
            const Vec3d mean = picture.radiance(p % picture.width, p / picture.width);
            const double factor = 1 + deviation * (exponential(random) - 1);
            for (int c = 0; c < 3; ++c) image[3 * p + size_t(c)] += fixedPoint(mean[c] * factor);
        }
    }
    for (size_t index = sums.layout.residueClasses(); index < sums.layout.layers.size(); ++index) {
        const std::span<int64_t> layer = sums.layer(index);
        for (uint32_t p = 0; p < picture.width * picture.height; ++p) {
            const double albedo = picture.albedo(p % picture.width, p / picture.width);
            switch (sums.layout.layers[index].kind) {
                case LayerKind::Albedo:
                    for (size_t c = 0; c < 3; ++c) layer[3 * p + c] = fixedPoint(albedo * double(iterations));
                    break;
                case LayerKind::Normal: layer[3 * p + 1] = fixedPoint(double(iterations)); break;
                case LayerKind::Depth: layer[p] = fixedPoint(5 * double(iterations)); break;
                default: layer[p] = fixedPoint(double(iterations));
            }
        }
    }
    return sums;
}

double squaredError(const Picture& picture, const Image& image) {
    double sum = 0;
    for (uint32_t p = 0; p < picture.width * picture.height; ++p) {
        const Vec3d off = Vec3d(image.pixels[p]) - picture.radiance(p % picture.width, p / picture.width);
        sum += dot(off, off);
    }
    return sum;
}

/// The squared error that is left of the noisy image's.
double leftOf(const Picture& picture, uint64_t iterations, double deviation, uint64_t seed, bool withLibrary = false) {
    const FilmSums sums = render(picture, iterations, deviation, seed);
    return squaredError(picture, denoise(sums, withLibrary).image) / squaredError(picture, sums.image());
}

const Picture litFloor{64, 64, litTexture, texture}, causticFloor{64, 64, caustic, plain}, wall{64, 64, flat, plain};

}  // namespace

TEST(Denoise, SmoothsWhatIsSmooth) { EXPECT_LT(leftOf(wall, 8, 1, 11), 0.1); }

TEST(Denoise, KeepsWhatFeaturesTell) { EXPECT_LT(leftOf(litFloor, 8, 1, 12), 0.2); }

TEST(Denoise, LeavesAResolvedCausticAlone) {
    // No feature tells of it. Where noise is strong there is something to gain, and where it is weak nothing to lose.
    EXPECT_LT(leftOf(causticFloor, 8, 1, 13), 0.9);
    for (const double deviation : {0.3, 0.1, 0.01})
        EXPECT_LT(leftOf(causticFloor, 64, deviation, 14), 1.05) << deviation;
}

TEST(Denoise, BelievesOpenImageDenoiseAsFarAsItIsRight) {
    if (!denoise(render(wall, 2, 1, 19)).openImageDenoise) GTEST_SKIP() << "there is no libOpenImageDenoise.so.2";
    // Made for pictures, it may have nothing to add to a floor; and what it gets wrong is not to be believed.
    for (const Picture& picture : {wall, litFloor, causticFloor})
        EXPECT_LT(leftOf(picture, 8, 1, 20, true), 1.3 * leftOf(picture, 8, 1, 20));
    EXPECT_LT(leftOf(causticFloor, 64, 0.01, 21, true), 1.05) << "what it blurs is left out";
}

TEST(Denoise, IsTheImageWhereThereIsNoNoise) {
    const FilmSums sums = render(causticFloor, 4, 0, 15);
    const Image noisy = sums.image(), image = denoise(sums, false).image;
    for (size_t p = 0; p < image.pixels.size(); ++p)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.pixels[p][c], noisy.pixels[p][c], 1e-5) << p;
}

TEST(Denoise, KeepsTheLight) {
    // Mean of 64² pixels of relative deviation 1/√8: a standard error of .0055 is the noise's own; four of them.
    const FilmSums sums = render(wall, 8, 1, 16);
    Vec3d sum;
    for (const Vec3f& pixel : denoise(sums, false).image.pixels) sum += Vec3d(pixel);
    EXPECT_NEAR(sum.x / (64 * 64) / 0.7, 1, 0.022);
}

TEST(Denoise, TakesAnyShapeAndAnyClasses) {
    for (const auto& [width, height] : {std::pair(1u, 1u), {3u, 70u}, {70u, 2u}, {33u, 31u}})
        for (const uint64_t iterations : {2, 3, 5}) {
            const Picture picture{width, height, flat, plain};
            const FilmSums sums = render(picture, iterations, 0.5, 17);
            const Image image = denoise(sums, false).image;
            ASSERT_EQ(image.pixels.size(), size_t(width) * height);
            for (const Vec3f& pixel : image.pixels) {
                EXPECT_TRUE(isFinite(pixel));
                EXPECT_GE(std::min({pixel.x, pixel.y, pixel.z}), 0);
            }
        }
}

TEST(Denoise, RefusesFilmsThatTellTooLittle) {
    const FilmSums once = render(wall, 1, 1, 18);
    expectError(ErrorCode::Usage, "two classes", [&] { denoise(once); });
    FilmSums bare = render(wall, 4, 1, 18);
    bare.layout.layers.resize(errorClasses);
    bare.values.resize(bare.layout.values());
    expectError(ErrorCode::Usage, "albedo", [&] { denoise(bare); });
}
