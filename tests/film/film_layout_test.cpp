// Films of several layers: where each lies, what is added, hashed and refused.
#include "renderengine/film_layout.h"

#include <cmath>
#include <limits>

#include "renderengine/film.h"
#include "tests/film/expect_error.h"

using namespace antipode;
using test::expectError;

namespace {

/// 2×2 pixels of the image, a normal and a depth.
FilmSums threeLayers() {
    FilmSums sums{{2, 2, {{"", "RGB", 20}, {"N", "XYZ", 32}, {"", "Z", -4}}}, 3, {}, {}};
    for (int64_t i = 0; i < 28; ++i) sums.values.push_back(i - 14);
    return sums;
}

}  // namespace

TEST(FilmLayout, LayersLieOneAfterTheOther) {
    const FilmLayout layout = threeLayers().layout;
    EXPECT_EQ(layout.channels(), 7u);
    EXPECT_EQ(layout.values(), 28u);
    EXPECT_EQ(layout.offset(0), 0u);
    EXPECT_EQ(layout.offset(1), 12u);
    EXPECT_EQ(layout.offset(2), 24u);
    FilmSums sums = threeLayers();
    EXPECT_EQ(sums.layer(1).front(), -2);
    EXPECT_EQ(sums.layer(2).size(), 4u);
    sums.layer(2).back() = 77;
    EXPECT_EQ(sums.values.back(), 77);
}

TEST(FilmLayout, OfAJobIsItsImage) {
    RenderSettings settings;
    settings.width = 7, settings.height = 5;
    EXPECT_EQ(filmLayout(settings), (FilmLayout{7, 5, {{"", "RGB", 0}}}));
}

TEST(FilmLayout, LayersAreTheSameAtWhateverScale) {
    const FilmLayout layout = threeLayers().layout;
    FilmLayout other = layout;
    other.layers[1].scaleExponent = 3;
    EXPECT_TRUE(layout.sameLayers(other));
    EXPECT_NE(layout, other);
    other.layers[1].channels = "XY";
    EXPECT_FALSE(layout.sameLayers(other));
    other = layout;
    other.layers.pop_back();
    EXPECT_FALSE(layout.sameLayers(other));
    EXPECT_FALSE(layout.sameLayers({2, 3, layout.layers}));
}

TEST(FilmLayout, MergeNamesTheLayerThatOverflows) {
    FilmSums sums = threeLayers(), other = threeLayers();
    other.layer(1)[5] = std::numeric_limits<int64_t>::max();
    sums.layer(1)[5] = 1;
    const std::string before = sums.sha256();
    expectError(ErrorCode::Device, "pixel 1,0 of layer 'N'", [&] { sums.merge(other); });
    EXPECT_EQ(sums.sha256(), before);
    other.layer(1)[5] = 0;
    other.layout.layers[2].scaleExponent = 0;
    expectError(ErrorCode::Usage, "2^0", [&] { sums.merge(other); });
}

// Expected, in Python: h = hashlib.sha256(); for e, a, b in (20, 0, 12), (32, 12, 24), (-4, 24, 28):
// h.update(struct.pack('<IIiQ', 2, 2, e, 3)); h.update(struct.pack(f'<{b-a}q', *range(a - 14, b - 14)))
TEST(FilmLayout, TheHashCoversAllLayers) {
    EXPECT_EQ(threeLayers().sha256(), "2c012dabd08ccaea2b21f23216fd81b18b68a2dee00eb0d09e7e706467132e0d");
    FilmSums other = threeLayers();
    ++other.values.back();
    EXPECT_NE(other.sha256(), threeLayers().sha256());
}

TEST(FilmLayout, ScalesLeaveRoomForAMillionIterations) {
    for (const double greatest : {1e-20, 0.7, 1.0, 3.0, 1e9, 2.5e11}) {
        const double sum = 1e6 * std::ldexp(greatest, filmScaleExponent(greatest));
        EXPECT_LT(sum, 0x1p62) << greatest;
        EXPECT_GT(sum, 0x1p59) << greatest;
    }
    EXPECT_EQ(filmScaleExponent(1e-38), 126) << "2^S is a float";
}
