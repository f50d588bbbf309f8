// Films of several layers: where each lies, what is added, hashed and refused.
#include "renderengine/film_layout.h"

#include <cmath>
#include <limits>

#include "kernels/shared/layout.h"
#include "renderengine/film.h"
#include "tests/film/expect_error.h"

using namespace antipode;
using test::expectError;

namespace {

/// 2×2 pixels of the image, a normal and a depth.
FilmSums threeLayers() {
    FilmSums sums{
        {2,
         2,
         {{LayerKind::Image, "", "RGB", 20}, {LayerKind::Normal, "N", "XYZ", 32}, {LayerKind::Depth, "", "Z", -4}}},
        3,
        {},
        {}};
    for (int64_t i = 0; i < 28; ++i) sums.values.push_back(i - 14);
    return sums;
}

}  // namespace

TEST(FilmLayout, KernelsCountTheChannelsOfTheTable) {
    ASSERT_EQ(layerTable().size(), layerKinds);
    for (const LayerInfo& layer : layerTable()) {
        const bool isSingle = (shared::LAYERS_OF_ONE_CHANNEL >> uint32_t(layer.kind) & 1) != 0;
        EXPECT_EQ(std::string(layer.channels).size(), isSingle ? 1u : 3u) << layer.option;
        EXPECT_EQ(layerTable()[size_t(layer.kind)].kind, layer.kind);
    }
}

TEST(FilmLayout, LengthsComeWithWhereTheyWereMet) {
    for (const LayerInfo& layer : layerTable()) {
        RenderSettings settings;
        settings.layers.add(layer.kind);
        const FilmLayout layout = filmLayout(settings);
        EXPECT_EQ(layout.layers.size(), layer.unit == LayerUnit::Length ? 3u : 2u) << layer.option;
    }
}

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
    EXPECT_EQ(filmLayout(settings), (FilmLayout{7, 5, {{LayerKind::Image, "", "RGB", 0}}}));
}

TEST(FilmLayout, HasTheLayersThatAreAskedFor) {
    RenderSettings settings;
    settings.residueClasses = 2;
    settings.layers.add(LayerKind::Position);
    settings.layers.add(LayerKind::Splat);
    std::string text;
    for (const FilmLayer& layer : filmLayout(settings).layers) text += layer.name + "." + layer.channels + " ";
    EXPECT_EQ(text, "residue0.RGB residue1.RGB splat.RGB P.XYZ coverage.A ");
    EXPECT_EQ(name(settings.layers), "splat,P");
}

TEST(FilmLayout, CountsTheIterationsOfResidueClasses) {
    RenderSettings settings;
    EXPECT_TRUE(filmLayout(settings).residueCounts({0, 9}).empty());
    settings.residueClasses = 3;
    for (uint64_t first = 0; first < 7; ++first)
        for (uint64_t count = 0; count < 9; ++count) {
            std::vector<uint64_t> expected(3);
            for (uint64_t i = first; i < first + count; ++i) ++expected[i % 3];
            EXPECT_EQ(filmLayout(settings).residueCounts({first, count}), expected);
        }
}

TEST(FilmLayout, TheImageIsTheSumOfItsResidueClasses) {
    RenderSettings settings;
    settings.width = settings.height = 1;
    settings.residueClasses = 2;
    settings.layers.add(LayerKind::Depth);
    FilmSums sums{filmLayout(settings), 3, {1, 2, 3, 10, 20, 30, 40, int64_t(1) << 33}, {}, {2, 1}};
    sums.layout.layers.back().scaleExponent = 32;
    EXPECT_EQ(sums.imageAlone().values, (std::vector<int64_t>{11, 22, 33}));
    EXPECT_EQ(sums.image().pixels[0], (Vec3f{11, 22, 33} / 3.0f));
    const std::vector<LayerImage> images = sums.layerImages();
    ASSERT_EQ(images.size(), 4u);
    EXPECT_EQ(images[0].values, (std::vector<float>{0.5f, 1, 1.5f})) << "over its own iterations";
    EXPECT_EQ(images[1].values, (std::vector<float>{10, 20, 30}));
    EXPECT_EQ(images[2].values, (std::vector<float>{20})) << "over the two that met a surface";

    // Each class fits where their sum does not.
    FilmSums half = sums;
    half.values[0] = half.values[3] = std::numeric_limits<int64_t>::max() / 2;
    expectError(ErrorCode::Device, "pixel 0,0", [&] { sums.merge(half); });
    EXPECT_EQ(sums.iterations, 3u);
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
