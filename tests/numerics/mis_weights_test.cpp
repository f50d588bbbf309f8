// The recursive MIS weights against brute-force enumeration of every technique's full-path density.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>

#include "random_paths.h"
#include "support/hard_case.h"
#include "support/reference/mis_enumerator.h"
#include "support/reference/mis_recursion.h"
#include "support/worst.h"

namespace antipode {
namespace {

using namespace reference;

struct NamedCounts {
    const char* name;
    TechniqueCounts counts;
};
void PrintTo(const NamedCounts& c, std::ostream* out) { *out << c.name; }

std::vector<NamedCounts> algorithms() {
    return {{"pt", countsPt()},
            {"pt-naive", countsNaivePt()},
            {"lt", countsLt(307200)},
            {"bpt", countsBpt(307200, 0.7)},
            {"bpm", countsBpm(12.5)},
            {"vcm", countsVcm(307200, 0.7, 12.5)},
            {"vcm, few light paths", countsVcm(1000, 3.5, 4e-3)},
            {"vcm without hits", {.hit = 0, .nextEvent = 1, .splat = 640, .connection = 2, .merge = 0.5}},
            {"vcm without next events", {.hit = 1, .nextEvent = 0, .splat = 640, .connection = 2, .merge = 0.5}},
            {"vcm without light tracing", {.hit = 1, .nextEvent = 1, .splat = 0, .connection = 2, .merge = 0.5}},
            {"vcm without connections", {.hit = 1, .nextEvent = 1, .splat = 640, .connection = 0, .merge = 0.5}},
            {"connections only", {.hit = 0, .nextEvent = 0, .connection = 1}}};
}

/// How far the recursion is from the enumeration, over many paths.
template <class Real>
class Errors {
public:
    void add(const FullPath& path, const TechniqueCounts& counts) {
        const auto expected = enumerateWeights(path, counts), actual = recursiveWeights<Real>(path, counts);
        ASSERT_EQ(expected.size(), actual.size());
        double sum = 0;
        for (size_t i = 0; i < expected.size(); ++i) {
            ASSERT_EQ(expected[i].s, actual[i].s);
            ASSERT_EQ(expected[i].merge, actual[i].merge);
            weight_.add(std::abs(expected[i].weight - actual[i].weight),
                        (expected[i].merge ? "merge s=" : "technique s=") + std::to_string(expected[i].s) +
                            " k=" + std::to_string(path.edges()));
            sum += actual[i].weight;
        }
        if (!expected.empty()) sum_.add(std::abs(sum - 1), "k=" + std::to_string(path.edges()));
    }

    void expectWithin(const std::string& difficulty, double bound) const {
        constexpr Precision precision = std::is_same_v<Real, double> ? Precision::Double : Precision::Float;
        SCOPED_TRACE(weight_.where + ", " + sum_.where);
        antipode::expectWithin({"MIS", difficulty, "largest |w − w′|, w′ by enumeration", bound}, weight_.value, "host",
                               precision);
        antipode::expectWithin({"MIS", difficulty, "largest |Σw − 1|", bound}, sum_.value, "host", precision);
    }

private:
    Worst weight_, sum_;
};

constexpr double kFloatBound = 1e-4, kDoubleBound = 1e-9;

class MisWeights : public testing::TestWithParam<NamedCounts> {
protected:
    void expectAgreement(const std::vector<FullPath>& paths, const std::string& difficulty) {
        Errors<float> inFloat;
        Errors<double> inDouble;
        for (const FullPath& path : paths) {
            ASSERT_NO_FATAL_FAILURE(inFloat.add(path, GetParam().counts));
            ASSERT_NO_FATAL_FAILURE(inDouble.add(path, GetParam().counts));
        }
        inFloat.expectWithin(difficulty, kFloatBound);
        inDouble.expectWithin(difficulty, kDoubleBound);
    }
};

TEST_P(MisWeights, RecursionEqualsEnumerationOnRandomPaths) {
    Random random(1);
    std::vector<FullPath> paths;
    for (uint32_t edges = 1; edges <= 16; ++edges)
        for (int i = 0; i < 200; ++i)
            paths.push_back(randomPath({.edges = edges, .specularProbability = i % 4 == 0 ? 0.8 : 0.3}, random));
    expectAgreement(paths, "random paths of 1 to 16 edges, specular chains, delta and infinite lights");
}

TEST_P(MisWeights, RecursionEqualsEnumerationInMedia) {
    Random random(3);
    std::vector<FullPath> paths;
    for (uint32_t edges = 2; edges <= 12; ++edges)
        for (int i = 0; i < 100; ++i)
            paths.push_back(randomPath({.edges = edges, .mediumProbability = i % 2 == 0 ? 0.4 : 0.8}, random));
    expectAgreement(paths, "random paths over surfaces and points in media that scatter");
}

TEST_P(MisWeights, RecursionEqualsEnumerationOverThirtyOrdersOfMagnitude) {
    Random random(2);
    std::vector<FullPath> paths;
    for (int i = 0; i < 500; ++i)
        paths.push_back(randomPath({.edges = 2 + random.index(11), .logScaleRange = 7.5}, random));
    expectAgreement(paths, "densities over thirty orders of magnitude");
}

INSTANTIATE_TEST_SUITE_P(Algorithms, MisWeights, testing::ValuesIn(algorithms()), [](const auto& test) {
    std::string name = test.param.name;
    std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
    return name;
});

TEST(MisWeights, VanishingRadiusGivesBidirectionalPathTracing) {
    Random random(4);
    Worst difference, merge;
    for (int i = 0; i < 500; ++i) {
        const FullPath path = randomPath({.edges = 2 + random.index(12)}, random);
        const auto bpt = recursiveWeights<double>(path, countsBpt(1000, 1));
        if (bpt.empty())
            continue;  // a point light, only seen through a mirror and reflected by a mirror: merging alone
        const auto vcm = recursiveWeights<double>(path, countsVcm(1000, 1, 1e-60));
        for (size_t j = 0; j < vcm.size(); ++j)
            vcm[j].merge ? merge.add(vcm[j].weight) : difference.add(std::abs(vcm[j].weight - bpt[j].weight));
    }
    const std::string difficulty = "a merge radius that vanishes must leave bidirectional path tracing";
    expectWithin({"MIS", difficulty, "largest difference of a weight", 1e-12}, difference.value, "host",
                 Precision::Double);
    expectWithin({"MIS", difficulty, "largest weight of a merge", 1e-30}, merge.value, "host", Precision::Double);
}

TEST(MisWeights, HugeRadiusLeavesMergingOnly) {
    Random random(5);
    Worst difference;
    for (int i = 0; i < 500; ++i) {
        const FullPath path = randomPath({.edges = 2 + random.index(12)}, random);
        if (path.purelySpecular()) continue;
        const auto bpm = recursiveWeights<double>(path, countsBpm(1));
        std::vector<TechniqueWeight> merges;
        for (const TechniqueWeight& w : recursiveWeights<double>(path, countsVcm(1000, 1, 1e60)))
            if (w.merge) merges.push_back(w);
        ASSERT_EQ(merges.size(), bpm.size());
        for (size_t j = 0; j < bpm.size(); ++j) difference.add(std::abs(merges[j].weight - bpm[j].weight));
    }
    expectWithin(
        {"MIS", "a merge radius beyond all else must leave merging only", "largest difference of a weight", 1e-12},
        difference.value, "host", Precision::Double);
}

/// Next event and emitter hit compete in path tracing by p/(p + p'), whatever stands behind: the two-vertex case by
/// hand.
TEST(MisWeights, PathTracingWeightsByHand) {
    Random random(6);
    for (int i = 0; i < 200; ++i) {
        const FullPath path = randomPath({.edges = 2, .specularProbability = 0}, random);
        if (path.light.isDelta()) continue;
        const ScatterGeometry g = scatterGeometry(path, 0);
        const Vec3d d = path.surface[0].position - path.lightPoint.position;
        const double toSolidAngle =
            path.light.isInfinite() ? 1 : dot(d, d) / cosineAtLight(path.light, path.lightPoint);
        const double next = path.pickProbability * pdfDirect(path.light, path.lightPoint) * toSolidAngle;
        const double hit = pdfBsdf(path.surface[0].material, g.towardsCamera, g.towardsLight);
        const auto weights = recursiveWeights<double>(path, countsPt());
        ASSERT_EQ(weights.size(), 2u);
        EXPECT_NEAR(weights[0].weight, hit / (hit + next), 1e-12);
        EXPECT_NEAR(weights[1].weight, next / (hit + next), 1e-12);
    }
}

/// The étendue rule n²·cosθ·dω = const that the enumerator's densities through smooth interfaces rest on, against the
/// finite-difference Jacobian of Snell's law as bsdf.h refracts.
TEST(MisWeights, RefractionConservesEtendue) {
    Random random(7);
    for (int i = 0; i < 200; ++i) {
        const double ior = random.uniform(1.1, 2), theta = random.uniform(0.1, 1.3), step = 1e-5;
        const auto refractedAngle = [&](double angle) {
            const auto wi = refract({std::sin(angle), 0, std::cos(angle)}, ior);
            return std::acos(-wi->z);
        };
        const double inside = refractedAngle(theta);
        const double dTheta = (refractedAngle(theta + step) - refractedAngle(theta - step)) / (2 * step);
        const double solidAngleRatio = dTheta * std::sin(inside) / std::sin(theta);  // dω_inside/dω_outside
        EXPECT_NEAR(solidAngleRatio, std::cos(theta) / (ior * ior * std::cos(inside)), 1e-7);
    }
}

}  // namespace
}  // namespace antipode
