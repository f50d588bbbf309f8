// gpu/texel_sums.h against the texels that bilinear look-ups touch, found by looking up a dense grid of points. Fixed
// seed.
#include "gpu/texel_sums.h"

#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

namespace antipode {
namespace {

constexpr uint32_t kWidth = 13, kHeight = 8;  // no powers of two but one

Texture blackTexture(WrapMode u, WrapMode v) {
    Texture t;
    t.width = kWidth, t.height = kHeight;
    t.wrapU = u, t.wrapV = v;
    t.rgba.assign(4 * kWidth * kHeight, 0);
    return t;
}

double red(const uint8_t* rgba) { return rgba[0] / 255.0; }

int wrappedTexel(int i, int size, WrapMode mode) {
    if (mode == WrapMode::Clamp) return std::clamp(i, 0, size - 1);
    const int period = mode == WrapMode::Mirror ? 2 * size : size;
    i = ((i % period) + period) % period;
    return i < size ? i : period - 1 - i;
}

/// Indices of the texels that look-ups at points of the triangle weigh by more than 0.
std::set<uint32_t> touchedTexels(const Texture& t, const UvTriangle& uv) {
    constexpr int steps = 160;
    std::set<uint32_t> touched;
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; i + j <= steps; ++j) {
            const double b1 = double(i) / steps, b2 = double(j) / steps, b0 = 1 - b1 - b2;
            const double x = (b0 * uv[0][0] + b1 * uv[1][0] + b2 * uv[2][0]) * kWidth - 0.5;
            const double y = (b0 * uv[0][1] + b1 * uv[1][1] + b2 * uv[2][1]) * kHeight - 0.5;
            for (int dy = 0; dy < (y > std::floor(y) ? 2 : 1); ++dy)
                for (int dx = 0; dx < (x > std::floor(x) ? 2 : 1); ++dx)
                    touched.insert(uint32_t(wrappedTexel(int(std::floor(y)) + dy, kHeight, t.wrapV) * int(kWidth) +
                                            wrappedTexel(int(std::floor(x)) + dx, kWidth, t.wrapU)));
        }
    return touched;
}

/// Triangles from a fraction of a texel to several periods wide, about places up to three periods away.
UvTriangle randomTriangle(std::mt19937& random) {
    std::uniform_real_distribution<float> place(-3, 3), size(-7, 1), offset(-1, 1);
    const float u = place(random), v = place(random), width = std::exp2(size(random)), height = std::exp2(size(random));
    UvTriangle uv;
    for (auto& corner : uv) corner = {u + width * offset(random), v + height * offset(random)};
    return uv;
}

class TexelSumsWrap : public testing::TestWithParam<WrapMode> {};

/// A texel alone that shines gives every triangle that shows it some power.
TEST_P(TexelSumsWrap, NoTriangleThatShowsALitTexelHasNone) {
    std::mt19937 random(1);
    uint32_t shown = 0;
    for (int trial = 0; trial < 200; ++trial) {
        Texture t = blackTexture(GetParam(), trial % 2 ? WrapMode::Repeat : WrapMode::Clamp);
        const UvTriangle uv = randomTriangle(random);
        const std::set<uint32_t> touched = touchedTexels(t, uv);
        for (uint32_t texel : {*touched.begin(), *touched.rbegin(), *std::next(touched.begin(), touched.size() / 2)}) {
            t.rgba[4 * texel] = 1;
            EXPECT_GT(TexelSums(t, red).mean(uv), 0.0) << trial << ", texel " << texel;
            t.rgba[4 * texel] = 0;
            ++shown;
        }
    }
    EXPECT_EQ(shown, 600u);
}

/// Where nothing shines within two texels of the triangle it has exactly none, so that it is never drawn in vain.
TEST_P(TexelSumsWrap, ATriangleFarFromLitTexelsHasNone) {
    std::mt19937 random(2);
    uint32_t dark = 0;
    for (int trial = 0; trial < 200; ++trial) {
        Texture t = blackTexture(GetParam(), GetParam());
        UvTriangle uv = randomTriangle(random);
        for (auto& corner : uv)
            corner = {uv[0][0] + 0.1f * (corner[0] - uv[0][0]), uv[0][1] + 0.1f * (corner[1] - uv[0][1])};
        std::fill(t.rgba.begin(), t.rgba.end(), uint8_t(255));
        for (uint32_t texel : touchedTexels(t, uv))
            for (int dy = -2; dy <= 2; ++dy)
                for (int dx = -2; dx <= 2; ++dx) {
                    const int x = wrappedTexel(int(texel % kWidth) + dx, kWidth, GetParam());
                    const int y = wrappedTexel(int(texel / kWidth) + dy, kHeight, GetParam());
                    t.rgba[4 * size_t(y * int(kWidth) + x)] = 0;
                }
        dark += std::any_of(t.rgba.begin(), t.rgba.end(), [](uint8_t v) { return v != 0; }) ? 1 : 0;
        for (size_t i = 1; i < t.rgba.size(); i += 4) t.rgba[i] = 255;  // the other channels mean nothing
        EXPECT_EQ(TexelSums(t, red).mean(uv), 0.0) << trial;
    }
    EXPECT_EQ(dark, 200u);
}

/// Of a gradient over 13 texels the mean over a large triangle is that at its centre, but for the border of a texel.
TEST_P(TexelSumsWrap, LargeTrianglesHaveTheirOwnMean) {
    Texture t = blackTexture(GetParam(), GetParam());
    for (uint32_t i = 0; i < kWidth * kHeight; ++i) t.rgba[4 * i] = uint8_t(20 * (i % kWidth));
    const TexelSums sums(t, red);
    const UvTriangle left{{{0.1f, 0.1f}, {0.4f, 0.1f}, {0.1f, 0.9f}}},
        right{{{0.9f, 0.9f}, {0.6f, 0.9f}, {0.9f, 0.1f}}};
    const auto at = [](double u) { return 20 * (u * kWidth - 0.5) / 255; };
    EXPECT_NEAR(sums.mean(left), at(0.2), 0.03);
    EXPECT_NEAR(sums.mean(right), at(0.8), 0.03);
}

INSTANTIATE_TEST_SUITE_P(Modes, TexelSumsWrap, testing::Values(WrapMode::Repeat, WrapMode::Mirror, WrapMode::Clamp),
                         [](const auto& mode) {
                             return mode.param == WrapMode::Repeat   ? "Repeat"
                                    : mode.param == WrapMode::Mirror ? "Mirror"
                                                                     : "Clamp";
                         });

TEST(TexelSums, APeriodIsTheWholeTextureWhereverItLies) {
    Texture t = blackTexture(WrapMode::Repeat, WrapMode::Mirror);
    double total = 0;
    for (uint32_t i = 0; i < kWidth * kHeight; ++i) total += t.rgba[4 * i] = uint8_t(i);
    const TexelSums sums(t, red);
    const double mean = total / 255 / (kWidth * kHeight);
    for (float away : {0.0f, -7.3f, 1e5f, 1e30f}) {
        const UvTriangle uv{{{away, away}, {away + 500, away - 400}, {away - 700, away + 900}}};
        EXPECT_NEAR(sums.mean(uv), mean, away < 1e6f ? 1e-6 : 1.0);  // far away floats have no texels, but it is a mean
    }
}

}  // namespace
}  // namespace antipode
