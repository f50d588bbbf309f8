#include "client/view/picture.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "numerics/half.h"
#include "renderengine/exposure.h"

using namespace antipode;
using namespace antipode::view;

namespace {

/// A film whose image comes in two classes, with layers of two techniques that add up to it.
FilmSums filmOf(uint32_t width, uint32_t height) {
    FilmSums sums;
    const int32_t scale = 20;
    sums.layout = {width,
                   height,
                   {{LayerKind::Image, "class0", "RGB", scale},
                    {LayerKind::Image, "class1", "RGB", scale},
                    {LayerKind::EmitterHit, "emitter_hit", "RGB", scale},
                    {LayerKind::NextEvent, "next_event", "RGB", scale},
                    {LayerKind::Albedo, "albedo", "RGB", scale}}};
    sums.iterations = 3;
    sums.residueIterations = {2, 1};
    sums.values.resize(sums.layout.values());
    const size_t image = sums.layout.offset(1);
    for (size_t i = 0; i < image; ++i) {
        const int64_t emitted = int64_t(i * 7919 % 3000000), next = int64_t(i * 104729 % 2000000);
        sums.values[i] = emitted + next / 3;
        sums.values[image + i] = next - next / 3;
        sums.values[2 * image + i] = emitted;
        sums.values[3 * image + i] = next;
    }
    return sums;
}

bool same(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(Vec3f)) == 0;
}

uint16_t halfAt(const std::string& bytes, size_t index) {
    return uint16_t(uint8_t(bytes[2 * index]) | uint8_t(bytes[2 * index + 1]) << 8);
}

}  // namespace

TEST(Picture, OfASmallFilmIsItsImageToTheBitAndHasItsTechniques) {
    const FilmSums sums = filmOf(19, 11);
    const Picture picture = PictureTaker().takeWhole(sums);
    EXPECT_EQ(picture.iterations, 3u);
    EXPECT_EQ(picture.reduction, 1u);
    EXPECT_TRUE(same(picture.image, sums.image()));
    ASSERT_EQ(picture.techniques.size(), 2u) << "guides are no part of the picture";
    EXPECT_EQ(picture.techniques[1].kind, LayerKind::NextEvent);
    const size_t image = sums.layout.offset(1);
    EXPECT_EQ(picture.techniques[1].image.pixels[40].y, float(double(sums.values[3 * image + 121]) / 3 / (1 << 20)));
}

TEST(Picture, IsTakenInBandsThatEachEndInTime) {
    FilmSums sums = filmOf(64, 40);
    PictureTaker taker;
    std::optional<Picture> picture;
    int bands = 0;
    while (!picture) {
        ++bands;
        ASSERT_LE(bands, 40);
        picture = taker.take(sums, 0);  // no time: one row
        EXPECT_EQ(taker.busy(), !picture);
    }
    EXPECT_EQ(bands, 40);
    EXPECT_TRUE(same(picture->image, sums.image()));
}

TEST(Picture, BandsTakenAfterAnotherIterationAreMeansToo) {
    FilmSums sums = filmOf(8, 2);
    PictureTaker taker;
    EXPECT_FALSE(taker.take(sums, 0));
    for (int64_t& value : sums.values) value *= 5;
    sums.iterations *= 5;
    const std::optional<Picture> picture = taker.take(sums, 0);
    ASSERT_TRUE(picture);
    EXPECT_TRUE(same(picture->image, filmOf(8, 2).image()));
}

TEST(Picture, ReductionKeepsItWithinFourMegapixelsAndItsPixelsMeans) {
    EXPECT_EQ(pictureReduction(1920, 1080), 1u);
    EXPECT_EQ(pictureReduction(2048, 2048), 1u);
    EXPECT_EQ(pictureReduction(2049, 2048), 2u);
    EXPECT_EQ(pictureReduction(3840, 2160), 2u);
    EXPECT_EQ(pictureReduction(65536, 65536), 32u);

    // Wide and low, and odd, so that the last column is half as wide as others.
    FilmSums sums;
    sums.layout = {4194305, 1, {{LayerKind::Image, "", "RGB", 4}}};
    sums.iterations = 2;
    sums.values.resize(sums.layout.values());
    for (size_t i = 0; i < sums.values.size(); ++i) sums.values[i] = int64_t(i % 97);
    const Picture picture = PictureTaker().takeWhole(sums);
    EXPECT_EQ(picture.reduction, 2u);
    ASSERT_EQ(picture.image.width, 2097153u);
    ASSERT_EQ(picture.image.height, 1u);
    const Image whole = sums.image();
    EXPECT_EQ(picture.image.pixels[1000].z, (whole.pixels[2000].z + whole.pixels[2001].z) / 2);
    EXPECT_EQ(picture.image.pixels.back().x, whole.pixels.back().x);
}

TEST(Picture, IsSentAsHalvesInRangeWhateverItsBrightness) {
    FilmSums sums = filmOf(16, 16);
    for (const int32_t brighter : {0, 24, -20}) {
        for (FilmLayer& layer : sums.layout.layers) layer.scaleExponent = 20 - brighter;
        const Picture picture = PictureTaker().takeWhole(sums);
        const EncodedPicture encoded = encodePicture(picture);
        EXPECT_EQ(encoded.width, 16u);
        ASSERT_EQ(encoded.halves.size(), 16u * 16 * 6);
        EXPECT_EQ(encoded.stops, autoExposure(picture.image));
        EXPECT_NEAR(encoded.exponent, encoded.stops, 0.5);
        for (size_t pixel = 0; pixel < picture.image.pixels.size(); ++pixel)
            EXPECT_EQ(halfAt(encoded.halves, 3 * pixel + 1),
                      toHalf(std::ldexp(picture.image.pixels[pixel].y, encoded.exponent)));
    }
}

TEST(Picture, TechniquesAddUpToWhatIsAskedFor) {
    const Picture picture = PictureTaker().takeWhole(filmOf(8, 8));
    const uint32_t emitterHit = 1u << uint32_t(LayerKind::EmitterHit), nextEvent = 1u << uint32_t(LayerKind::NextEvent);
    const EncodedPicture all = encodePicture(picture), both = encodePicture(picture, emitterHit | nextEvent),
                         one = encodePicture(picture, nextEvent), none = encodePicture(picture, 0);
    EXPECT_EQ(all.halves, both.halves);
    EXPECT_EQ(halfAt(one.halves, 50), toHalf(std::ldexp(picture.techniques[1].image.pixels[16].z, one.exponent)));
    EXPECT_EQ(one.stops, all.stops) << "one technique's exposure is the picture's, so that they can be compared";
    EXPECT_EQ(none.halves, std::string(8 * 8 * 6, '\0'));
}
