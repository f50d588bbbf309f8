// Techniques against each other, path length by path length: each is a different estimator of the same integral.
//
// Statistics. One iteration's mean over a block of pixels and one channel is one sample. Null hypothesis of every test:
// two techniques have the same expectation there, apart from merging's bias (bpm, ppm: kMergeBias of the mean; vcm
// gives its merges so little weight at this radius that it is taken as unbiased). Welch's t-test, α = .01 over all
// tests of a family (Šidák), a family being one scene; a seed for each technique, so that no two share random numbers.
// Compared are the whole image, where every standard error must stay below kGreatestError of the mean, and those of its
// 4 × 3 blocks where both do: means of rarer events are too far from normal for a t-test at this significance.
//
// There are some thirty families, and whatever changes a kernel draws all of them anew. A family that rejects is
// therefore tested once more, with other seeds and four times the iterations, at the same significance, and fails where
// it rejects again: by chance once in 10^4, while what techniques really differ by shows the more clearly.
#include <cmath>
#include <sstream>

#include "support/worst.h"
#include "tests/techniques/agreement_scenes.h"
#include "tests/techniques/engine_fixture.h"
#include "tests/techniques/row_names.h"

namespace antipode::test {
namespace {

constexpr uint32_t kWidth = 64, kHeight = 48, kColumns = 4, kRows = 3, kLongest = 6;
/// Long paths are rarer: more samples.
constexpr uint64_t iterationsFor(uint32_t edges) { return 24 + 10 * edges; }
/// Relative standard error up to which a mean is compared.
constexpr double kGreatestError = 0.08;
/// Photons are lost over the edges of the floor and of the plate: a strip of radius r .02 around pieces about 1 wide,
/// times the mean share 2/(3π) of a disk that hangs over: 2 %.
constexpr double kMergeRadius = 0.02, kMergeBias = 0.02;

struct Estimator {
    std::string name;
    RenderSettings settings;
    double bias = 0;  ///< relative
};

double relativeError(const Moments& m) { return std::sqrt(m.meanVariance()) / m.mean(); }

Estimator technique(const std::string& name) {
    Estimator e{name, {}};
    e.settings.width = kWidth;
    e.settings.height = kHeight;
    e.settings.technique = name;
    e.settings.initialRadius = kMergeRadius;
    e.settings.alpha = 1;
    if (name == "bpm" || name == "ppm") e.bias = kMergeBias;
    return e;
}

Estimator single(uint32_t s, uint32_t t, bool merge = false) {
    Estimator e = technique("vcm");
    e.name = std::string(merge ? "merge " : "single ") + std::to_string(s) + "," + std::to_string(t);
    e.settings.single = SingleTechnique{s, t, merge};
    if (merge) e.bias = kMergeBias;
    return e;
}

class EngineAgreement : public EngineTest {
protected:
    struct Series {
        Estimator estimator;
        std::vector<Image> images;
    };

    struct Row {
        std::string group, difficulty;
    };

    /// Renders every estimator with paths of exactly `edges` edges and compares all pairs.
    /// @param tests  size of the family that these comparisons belong to
    /// @param run    neighbouring iterations that are one sample together; then three times as many are rendered
    void expectEqual(const Row& row, const Scene& scene, const std::vector<Estimator>& estimators, uint32_t edges,
                     uint64_t tests, uint64_t run = 1) {
        const double bound = -std::log10(sidak(kAlpha, tests));
        const uint64_t iterations = run == 1 ? iterationsFor(edges) : 3 * iterationsFor(edges) / run * run;
        Worst surprise = surpriseOf(scene, estimators, edges, iterations, run, 100);
        if (surprise.value > bound) surprise = surpriseOf(scene, estimators, edges, 4 * iterations, run, 1100);
        SCOPED_TRACE(surprise.where);
        expectWithin(
            {row.group, row.difficulty, "largest −log₁₀ p of Welch tests over pairs of techniques and blocks", bound},
            surprise.value, deviceName());
    }

    /// Comparisons that expectEqual makes of so many estimators, at most.
    static uint64_t testsOf(uint64_t estimators) {
        return estimators * (estimators - 1) / 2 * (1 + kColumns * kRows) * 3;
    }

    inline static const Row kAlone{"MIS", "every technique alone, unweighted, against their weighted sum"};

private:
    /// The least likely comparison of all pairs, with seeds from firstSeed on.
    Worst surpriseOf(const Scene& scene, const std::vector<Estimator>& estimators, uint32_t edges, uint64_t iterations,
                     uint64_t run, uint64_t firstSeed) {
        std::vector<Series> all;
        for (size_t i = 0; i < estimators.size(); ++i) {
            SCOPED_TRACE(estimators[i].name);
            RenderSettings settings = estimators[i].settings;
            settings.minPathLength = settings.maxPathLength = edges;
            settings.seed = firstSeed + i;
            all.push_back({estimators[i], meansOfRuns(renderEach(scene, settings, iterations), run)});
        }
        Worst surprise;
        for (size_t j = 1; j < all.size(); ++j)
            for (size_t i = 0; i < j; ++i) comparePair(all[i], all[j], surprise);
        return surprise;
    }

    static std::vector<Image> meansOfRuns(const std::vector<Image>& images, uint64_t run) {
        std::vector<Image> means;
        for (size_t i = 0; i < images.size(); ++i) {
            if (i % run == 0) means.emplace_back(images[i]).pixels.assign(images[i].pixels.size(), Vec3f(0.0f));
            for (size_t p = 0; p < images[i].pixels.size(); ++p)
                means.back().pixels[p] += images[i].pixels[p] / float(run);
        }
        return means;
    }

    static void comparePair(const Series& a, const Series& b, Worst& surprise) {
        const std::vector<Block> blocks = blocksOf(kWidth, kHeight, kColumns, kRows);
        for (size_t at = 0; at < blocks.size(); ++at)
            for (int channel = 0; channel < 3; ++channel) {
                const Block& block = blocks[at];
                const Moments ma = momentsOf(a.images, block, channel), mb = momentsOf(b.images, block, channel);
                const bool sharp = relativeError(ma) < kGreatestError && relativeError(mb) < kGreatestError;
                if (at == 0)
                    EXPECT_TRUE(sharp) << a.estimator.name << " " << relativeError(ma) << ", " << b.estimator.name
                                       << " " << relativeError(mb);
                else if (!sharp)
                    continue;
                const double bias = std::max(a.estimator.bias, b.estimator.bias) * ma.mean();
                const double shift = std::clamp(ma.mean() - mb.mean(), -bias, bias);
                Moments nearest;
                for (const Image& image : b.images) nearest.add(meanOf(image, block, channel) + shift);
                std::ostringstream said;
                said << a.estimator.name << " " << ma.mean() << " ± " << std::sqrt(ma.meanVariance()) << ", "
                     << b.estimator.name << " " << mb.mean() << " ± " << std::sqrt(mb.meanVariance()) << ", ratio "
                     << mb.mean() / ma.mean() << ", channel " << channel << ", block " << block.left << "," << block.top
                     << " to " << block.right << "," << block.bottom;
                surprise.add(-std::log10(welchTest(ma, nearest).pValue), said.str());
            }
    }
};

class EngineAgreementPerLength : public EngineAgreement, public testing::WithParamInterface<uint32_t> {};

/// Lights that nothing can hit exclude pt-naive; every other technique can make every path.
TEST_P(EngineAgreementPerLength, Lamps) {
    const std::vector<Estimator> all{technique("pt"), technique("lt"), technique("bpt"), technique("vcm"),
                                     technique("bpm")};
    expectEqual({"Shading normals", "a normal map and a smoothly shaded mesh, paths of exactly so many edges"},
                lampsScene(), all, GetParam(), kLongest * testsOf(all.size()));
}

/// Through a thin lens; fewer light paths than pixels for bpt, more for lt and vcm.
TEST_P(EngineAgreementPerLength, Sky) {
    std::vector<Estimator> all{technique("pt"), technique("lt"), technique("bpt"), technique("vcm"), technique("bpm")};
    all[1].settings.lightPathCount = 16000;
    all[2].settings.lightPathCount = 2000;
    all[3].settings.lightPathCount = 5000;
    expectEqual({"MIS", "lights at infinity, fewer or more light paths than pixels, exactly so many edges"}, skyScene(),
                all, GetParam(), kLongest * testsOf(all.size()));
}

/// Mirror and glass: lt cannot make what is seen in them. Three connections per vertex for bpt and vcm.
TEST_P(EngineAgreementPerLength, Specular) {
    std::vector<Estimator> all{technique("pt"),  technique("pt-naive"), technique("bpt"),
                               technique("vcm"), technique("bpm"),      technique("ppm")};
    all[2].settings.connectionsPerVertex = all[3].settings.connectionsPerVertex = 3;
    all[5].settings.lightPathCount = 16000;
    expectEqual({"MIS", "mirror and glass, several connections a vertex, exactly so many edges"}, specularScene(), all,
                GetParam(), kLongest * testsOf(all.size()));
}

/// Panes, shares of glass and absorption: surfaces that are smooth and rough at once.
TEST_P(EngineAgreementPerLength, Glass) {
    const std::vector<Estimator> all{technique("pt"), technique("pt-naive"), technique("bpt"), technique("vcm"),
                                     technique("bpm")};
    expectEqual({"MIS", "panes, surfaces part glass and part paint, absorption, exactly so many edges"}, glassScene(),
                all, GetParam(), kLongest * testsOf(all.size()));
}

/// Clear coats and sheen over paint and metal.
TEST_P(EngineAgreementPerLength, Layered) {
    const std::vector<Estimator> all{technique("pt"),  technique("pt-naive"), technique("lt"),
                                     technique("bpt"), technique("vcm"),      technique("bpm")};
    expectEqual({"MIS", "clear coats and sheen over paint and metal, exactly so many edges"}, layeredScene(), all,
                GetParam(), kLongest * testsOf(all.size()));
}

/// One wavelength an iteration, seen once where both sub-paths depend on it. Eight iterations from a multiple of eight
/// on, whose wavelengths are stratified, are one sample.
TEST_P(EngineAgreementPerLength, Dispersive) {
    const std::vector<Estimator> all{technique("pt"), technique("pt-naive"), technique("bpt"), technique("vcm"),
                                     technique("bpm")};
    expectEqual({"MIS", "glass that disperses light, smooth, rough and nested, exactly so many edges"},
                dispersiveScene(), all, GetParam(), kLongest * testsOf(all.size()), 8);
}

/// Alpha that blends: surfaces and lamps that segments meet by chance.
TEST_P(EngineAgreementPerLength, Blended) {
    const std::vector<Estimator> all{technique("pt"),  technique("pt-naive"), technique("lt"),
                                     technique("bpt"), technique("vcm"),      technique("bpm")};
    expectEqual({"MIS", "alpha that blends: walls, a ball and a lamp that light passes in part, exactly so many edges"},
                blendedScene(), all, GetParam(), kLongest * testsOf(all.size()));
}

class EngineAgreementInMedia : public EngineAgreement, public testing::WithParamInterface<uint32_t> {};

/// Lamps in fog, milk in glass and smoke that glass does not hold: next events, connections and splats at points in
/// media and through them, and merges on the surfaces.
TEST_P(EngineAgreementInMedia, EveryTechnique) {
    const std::vector<Estimator> all{technique("pt"),  technique("pt-naive"), technique("bpt"),
                                     technique("vcm"), technique("bpm"),      technique("ppm")};
    expectEqual({"Media", "lamps in fog, milk in glass, unlike in each channel, exactly so many edges"}, mediaScene(),
                all, GetParam(), kLongest * testsOf(all.size()));
}

INSTANTIATE_TEST_SUITE_P(Media, EngineAgreementInMedia, testing::Range(1u, kLongest + 1),
                         [](const auto& length) { return std::to_string(length.param); });

INSTANTIATE_TEST_SUITE_P(Edges, EngineAgreementPerLength, testing::Range(1u, kLongest + 1),
                         [](const auto& length) { return std::to_string(length.param); });

/// Every technique of one path length, alone and without weights, is an estimator of the whole; bpt is the weighted sum
/// of those of them that it uses. Merges join one more vertex.
TEST_F(EngineAgreement, SingleTechniquesOfThreeEdges) {
    const std::vector<Estimator> all{technique("bpt"), single(0, 4),       single(1, 3),      single(2, 2),
                                     single(3, 1),     single(2, 3, true), single(3, 2, true)};
    expectEqual(kAlone, scatteredLampsScene(), all, 3, testsOf(all.size()));
}

TEST_F(EngineAgreement, SingleTechniquesOfTwoEdges) {
    const std::vector<Estimator> all{technique("bpt"), single(0, 3), single(1, 2), single(2, 1), single(2, 2, true)};
    expectEqual(kAlone, scatteredLampsScene(), all, 2, testsOf(all.size()));
}

}  // namespace
}  // namespace antipode::test
