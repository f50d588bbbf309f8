#include <limits>

#include "renderengine/film.h"
#include "tests/film/expect_error.h"

using namespace antipode;
using test::expectError;

namespace {

FilmLayout imageLayout(uint32_t width, uint32_t height, int32_t scaleExponent) {
    return {width, height, {{LayerKind::Image, "", "RGB", scaleExponent}}};
}

FilmSums twoPixels() {
    FilmSums sums{imageLayout(2, 1, 20), 4, {}, {}};
    sums.values = {4 << 20, 2 << 20, 0, -(1 << 20), 1, int64_t(1) << 62};
    return sums;
}

}  // namespace

TEST(FilmSums, ImageIsTheMeanOverIterations) {
    const Image image = twoPixels().image();
    ASSERT_EQ(image.pixels.size(), 2u);
    EXPECT_EQ(image.pixels[0], Vec3f(1.0f, 0.5f, 0.0f));
    EXPECT_EQ(image.pixels[1], Vec3f(-0.25f, 0x1p-22f, 0x1p40f));
}

TEST(FilmSums, ImageUsesNegativeScaleExponents) {
    const FilmSums sums{imageLayout(1, 1, -3), 2, {6, 0, 0}, {}};
    EXPECT_EQ(sums.image().pixels[0].x, 24.0f);
}

TEST(FilmSums, MergeAddsSumsIterationsAndEvents) {
    FilmSums a = twoPixels(), b = twoPixels();
    b.values[5] = 7;
    a.events.at(EventSource::Film, EventKind::Saturated) = 1;
    b.events.at(EventSource::Film, EventKind::Saturated) = 10;
    a.merge(b);
    EXPECT_EQ(a.iterations, 8u);
    EXPECT_EQ(a.values[0], 8 << 20);
    EXPECT_EQ(a.values[3], -(2 << 20));
    EXPECT_EQ(a.values[5], (int64_t(1) << 62) + 7);
    EXPECT_EQ(a.events.at(EventSource::Film, EventKind::Saturated), 11u);
}

TEST(FilmSums, MergeOrderDoesNotChangeTheHash) {
    FilmSums a = twoPixels(), b = twoPixels(), c = twoPixels();
    a.values[5] = 11;
    b.values[5] = -5;
    c.iterations = 9;
    FilmSums forward = a, backward = c;
    forward.merge(b);
    forward.merge(c);
    backward.merge(b);
    backward.merge(a);
    EXPECT_EQ(forward.sha256(), backward.sha256());
    EXPECT_NE(forward.sha256(), a.sha256());
}

TEST(FilmSums, MergeRefusesOtherSizesAndScales) {
    FilmSums sums = twoPixels(), tall = twoPixels(), scaled = twoPixels();
    std::swap(tall.layout.width, tall.layout.height);
    scaled.layout.layers[0].scaleExponent = 21;
    expectError(ErrorCode::Usage, "1x2", [&] { sums.merge(tall); });
    expectError(ErrorCode::Usage, "2^21", [&] { sums.merge(scaled); });
    EXPECT_EQ(sums.iterations, 4u);
}

TEST(FilmSums, MergeRefusesOverflowAndChangesNothing) {
    FilmSums sums = twoPixels(), other = twoPixels();
    other.values[5] = std::numeric_limits<int64_t>::max();
    const std::string before = sums.sha256();
    expectError(ErrorCode::Device, "pixel 1,0", [&] { sums.merge(other); });
    EXPECT_EQ(sums.sha256(), before);
}

TEST(FilmSums, ImageNeedsIterations) {
    FilmSums sums = twoPixels();
    sums.iterations = 0;
    expectError(ErrorCode::Usage, "without iterations", [&] { sums.image(); });
}

// Expected: hashlib.sha256(struct.pack('<IIiQ6q', 2, 1, 20, 4, 4<<20, 2<<20, 0, -(1<<20), 1, 1<<62)) in Python.
TEST(FilmSums, HashMatchesAnIndependentImplementation) {
    EXPECT_EQ(twoPixels().sha256(), "6af9618ca3da9f1ee1454df22e6ecd7b0004d58632ec5b142a8a2fd0be3acd04");
}

TEST(FilmSums, HashCoversFilmsLargerThanItsBuffer) {
    // Expected, in Python: hashlib.sha256(struct.pack('<IIiQ30000q', 100, 100, -1, 1, *range(30000))).hexdigest()
    FilmSums sums{imageLayout(100, 100, -1), 1, {}, {}};
    for (int64_t i = 0; i < 30000; ++i) sums.values.push_back(i);
    EXPECT_EQ(sums.sha256(), "8395e095f0d126e18c68cf6056f0603959aa0c382959164f42d7f5b064391bff");
}
