// sampleBsdf against the density that evalBsdf gives. Null hypothesis of each χ²: the counts in cells of solid angle,
// and of draws that end the path, follow it. Significance 0.01 over all settings (Šidák); seeds fixed.
#include <cmath>
#include <numbers>

#include "support/hard_case.h"
#include "support/random.h"
#include "support/statistics.h"
#include "tests/kernels/bsdf_bench.h"

namespace antipode {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int rows = 24, columns = 24, subRows = 32, subColumns = 12;

/// Cells around an axis, rows equal in log(1 + (1 − cosθ)/width²): even steps in a lobe, geometric ones beyond. They
/// cover the sphere; only directions on one side of the surface count.
class LobeChart {
public:
    LobeChart(const Vec3d& axis, double width, double side)
        : frame_(axis), width2_(width * width), span_(std::log1p(2 / width2_)), side_(side) {}

    bool holds(const Vec3d& d) const { return d.z * side_ > 0; }

    size_t cell(const Vec3d& d) const {
        const Vec3d local = frame_.toLocal(d), off = d - frame_.normal;
        const double t = std::log1p(dot(off, off) / 2 / width2_) / span_, phi = std::atan2(local.y, local.x) / (2 * pi);
        const auto at = [](double x, int count) { return std::min(size_t(x * count), size_t(count - 1)); };
        return at(t, rows) * columns + at(phi < 0 ? phi + 1 : phi, columns);
    }

    struct Node {
        Vec3d direction;
        double solidAngle;
        size_t cell;
    };

    /// Midpoints of a finer grid, those on this side.
    std::vector<Node> nodes() const {
        std::vector<Node> result;
        for (int i = 0; i < rows * subRows; ++i)
            for (int j = 0; j < columns * subColumns; ++j) {
                const auto m = [&](double step) { return width2_ * std::expm1(span_ * step / (rows * subRows)); };
                const double height = m(i + 0.5), phi = 2 * pi * (j + 0.5) / (columns * subColumns);
                const double s = std::sqrt(height * (2 - height));
                const Vec3d d = frame_.toWorld({s * std::cos(phi), s * std::sin(phi), 1 - height});
                if (holds(d))
                    result.push_back({d, (m(i + 1) - m(i)) * 2 * pi / (columns * subColumns),
                                      size_t(i / subRows) * columns + size_t(j / subColumns)});
            }
        return result;
    }

private:
    reference::Frame frame_;
    double width2_, span_, side_;
};

struct Setting {
    size_t index;
    double cosine;
};

/// Normal and grazing incidence, the back, and for glass total reflection. Narrow lobes at grazing angles are narrower
/// across than what the quadrature of the density resolves, and left out.
std::vector<Setting> settings() {
    std::vector<Setting> all;
    for (size_t i = 0; i < bsdfCases().size(); ++i)
        for (double c : {1.0, 0.8, 0.3, 0.05, -0.8, -0.4})
            if (!(std::abs(c) < 0.2 && bsdfCases()[i].lobeWidth * bsdfCases()[i].relativeLobeWidthBeyond < 5e-3))
                all.push_back({i, c});
    return all;
}

class BsdfTest : public DeviceTest {
protected:
    BsdfTest() : bench(*device, bsdfCases()) {}

    void expectSamplesFollowPdf(const Setting& s, double significance, uint64_t seed) {
        constexpr size_t samples = 40000;
        const BsdfCase& c = bsdfCases()[s.index];
        const Vec3d known = bench.rounded(atCosine(s.cosine));
        const double side = s.cosine > 0 ? 1 : -1, width = c.lobeWidth * std::abs(s.cosine);
        std::vector<LobeChart> charts{LobeChart({-known.x, -known.y, known.z}, width, side)};
        if (c.transmits) {
            const double eta = s.cosine > 0 ? c.indexBehind() : 1 / c.indexBehind();
            const double cosT2 = 1 - (1 - known.z * known.z) / (eta * eta);
            const Vec3d beyond = cosT2 > 0 ? Vec3d{-known.x / eta, -known.y / eta, -side * std::sqrt(cosT2)} : -known;
            charts.push_back(LobeChart(normalize(beyond), width * c.relativeLobeWidthBeyond, -side));
        }

        std::vector<double> expected(charts.size() * rows * columns + 1), observed(expected.size());
        double integral = 0;
        for (size_t k = 0; k < charts.size(); ++k) {
            const auto nodes = charts[k].nodes();
            std::vector<Vec3d> directions;
            for (const auto& node : nodes) directions.push_back(node.direction);
            const auto values = bench.eval(s.index, std::vector<Vec3d>(nodes.size(), known), directions);
            for (size_t i = 0; i < nodes.size(); ++i) {
                ASSERT_TRUE(std::isfinite(values[i].pdf) && values[i].pdf >= 0);
                const double share = values[i].pdf * nodes[i].solidAngle;
                expected[k * rows * columns + nodes[i].cell] += share * double(samples);
                integral += share;
            }
        }
        expectMeasured("density's integral less 1", 0.004, integral - 1);
        expected.back() = std::max(0.0, 1 - integral) * double(samples);

        // The sliver of a cell that no midpoint saw is not empty.
        for (double& e : expected) e += 1e-3;

        Random random(seed);
        size_t impossible = 0;
        const auto drawn = bench.sample(s.index, known, uniformTexels(samples, random));
        std::vector<Vec3d> directions;
        for (const DrawnBsdf& d : drawn) {
            directions.push_back(d.valid ? d.direction : Vec3d{0, 0, 1});
            if (!d.valid || d.specular) {  // the smooth part of a mix has no density
                ++observed.back();
                continue;
            }
            impossible += !(d.pdf > 0 && std::isfinite(d.pdf) && std::abs(length(d.direction) - 1) < 1e-6);
            size_t k = 0;
            while (k < charts.size() && !charts[k].holds(d.direction)) ++k;
            if (k == charts.size()) {
                ++impossible;
                continue;
            }
            ++observed[k * rows * columns + charts[k].cell(normalize(d.direction))];
        }
        expectMeasured("draws without a density, or not unit, or on the wrong side", 0, double(impossible));
        if (integral > 1e-3) {
            const TestResult result = chiSquareTest(observed, expected);
            SCOPED_TRACE(testing::Message()
                         << "χ² " << result.statistic << " of " << result.degreesOfFreedom << ", integral " << integral
                         << ", drawn " << 1 - observed.back() / double(samples));
            expectMeasured("largest −log₁₀ p of χ² tests", -std::log10(significance), -std::log10(result.pValue));
        } else {
            EXPECT_LE(double(samples) - observed.back(), 2e-3 * double(samples));
        }
        expectDrawsAgreeWithEval(s, known, drawn, directions);
    }

    /// What a draw says of itself is what evalBsdf says of its direction. Both are evaluated in float, on directions
    /// that passed through double and back.
    void expectDrawsAgreeWithEval(const Setting& s, const Vec3d& known, const std::vector<DrawnBsdf>& drawn,
                                  const std::vector<Vec3d>& directions) {
        const auto again = bench.eval(s.index, std::vector<Vec3d>(drawn.size(), known), directions);
        size_t different = 0;
        for (size_t i = 0; i < drawn.size(); ++i) {
            if (!drawn[i].valid || drawn[i].specular) continue;
            const double tolerance =
                2e-5 + 2e-6 / (bsdfCases()[s.index].lobeWidth * bsdfCases()[s.index].relativeLobeWidthBeyond);
            different += std::abs(again[i].pdf / drawn[i].pdf - 1) > tolerance ||
                         std::abs(again[i].reversePdf - drawn[i].reversePdf) > tolerance * drawn[i].reversePdf;
            different += maxComponent(drawn[i].value) > 0 &&
                         std::abs(maxComponent(again[i].value) / maxComponent(drawn[i].value) - 1) > tolerance;
        }
        // Directions within rounding of the horizon or of the critical angle change more.
        expectMeasured("share of draws that differ from what evaluation says of them", 0.002,
                       double(different) / double(drawn.size()));
    }

    void expectMeasured(const std::string& quantity, double bound, double measured) {
        expectWithin({"Sampling", "exponents to 10⁶, α from 10⁻³, ior from 1.0001; grazing, inside, total reflection",
                      quantity, bound},
                     measured, device->info().name);
    }

    BsdfBench bench;
};

TEST_F(BsdfTest, SamplesFollowTheirDensity) {
    const auto all = settings();
    const double significance = sidak(0.01, all.size());
    uint64_t seed = 1;
    for (const Setting& s : all) {
        SCOPED_TRACE(bsdfCases()[s.index].name + ", cosine " + std::to_string(s.cosine));
        expectSamplesFollowPdf(s, significance, seed++);
    }
}

// A surface cannot send on more than arrives, but for what the tables of rough glass round: 5·10^-3. With adjoint
// transport refraction does not scale by η².
TEST_F(BsdfTest, NothingIsBrighterThanWhatArrives) {
    Random random(1);
    for (const Setting& s : settings()) {
        SCOPED_TRACE(bsdfCases()[s.index].name + ", cosine " + std::to_string(s.cosine));
        const auto drawn = bench.sample(s.index, bench.rounded(atCosine(s.cosine)), uniformTexels(20000, random), true);
        Moments red, green, blue;
        for (const DrawnBsdf& d : drawn) {
            const Vec3d weight = !d.valid     ? Vec3d()
                                 : d.specular ? d.value
                                              : d.value * (std::abs(d.direction.z) / d.pdf);
            red.add(weight.x), green.add(weight.y), blue.add(weight.z);
            ASSERT_TRUE(isFinite(weight));
        }
        const double tables = bsdfCases()[s.index].transmits ? 5e-3 : 1e-4;
        // Five standard errors: no false alarm in 10^4 settings.
        for (const Moments& m : {red, green, blue}) EXPECT_LE(m.mean(), 1 + tables + 5 * std::sqrt(m.meanVariance()));
    }
}

}  // namespace
}  // namespace antipode
