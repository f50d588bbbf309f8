// The weights of lib/mis.glsl: from ratios of densities, to the ends of float; and along whole paths, by the lines that
// the stages run, against the enumeration of every technique's full-path density.
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "support/hard_case.h"
#include "support/reference/mis_enumerator.h"
#include "support/worst.h"
#include "tests/kernels/kernel_harness.h"
#include "tests/numerics/random_paths.h"

namespace antipode {
namespace {

class MisWeightTest : public DeviceTest {
protected:
    std::vector<Texel> weights(const ProbeData& densities) {
        return KernelHarness(*device).run(kernel_probes::mis_probe(), densities).a;
    }
};

TEST_F(MisWeightTest, TwoTechniquesShareOne) {
    ProbeData densities;
    for (int a = -37; a <= 38; ++a)
        for (int b = -37; b <= 38; ++b)
            densities.a.push_back({float(std::pow(10.0, a)), float(std::pow(10.0, b)), 0, 0});
    double worst = 0;
    for (const Texel& w : weights(densities)) worst = std::max(worst, std::abs(double(w.x) + double(w.y) - 1));
    expectWithin({"MIS", "densities of two techniques from 10⁻³⁷ to 10³⁸", "largest |Σw − 1|", 1e-4}, worst,
                 device->info().name);
}

TEST_F(MisWeightTest, EndsOfFloatAreZeroAndOne) {
    constexpr float greatest = std::numeric_limits<float>::max();
    ProbeData densities;
    densities.a = {{greatest, 1, 0, 0}, {1, greatest, 0, 0}};
    const auto w = weights(densities);
    expectWithin({"MIS", "weights at the ends of float", "error of w(FLT_MAX, 1) = 1", 0}, std::abs(double(w[0].x) - 1),
                 device->info().name);
    // 1/FLT_MAX is no normal float: devices may give 0 or 2.9·10⁻³⁹.
    expectWithin({"MIS", "weights at the ends of float", "error of w(1, FLT_MAX) = 0", 3e-39}, double(w[1].x),
                 device->info().name);
    EXPECT_GE(w[1].x, 0);
}

using namespace reference;

constexpr size_t pathStride = 32, flights = 16;  // PATH_STRIDE and FLIGHTS of the probe
constexpr uint32_t greatestEdges = 15;

Texel reals(double x, double y, double z, double w = 0) { return {float(x), float(y), float(z), float(w)}; }
Texel withBits(uint32_t x, uint32_t y, double z, double w) {
    return {std::bit_cast<float>(x), std::bit_cast<float>(y), float(z), float(w)};
}

/// The path's densities as the probe reads them.
void addPath(const FullPath& path, ProbeData& data) {
    std::array<Texel, pathStride> head{}, densities{}, segments{};
    const Light& light = path.light;
    const double direct = path.pickProbability * pdfDirect(light, path.lightPoint);
    const double emit = path.pickProbability * pdfEmit(light, path.lightPoint);
    const double cosine = cosineAtLight(light, path.lightPoint);
    const Vec3d first = path.surface[0].position - path.lightPoint.position;
    const double distance = light.isInfinite() ? 1 : length(first);
    const double directSolidAngle = direct * distance * distance / cosine;
    const Vec3d seen = normalize(path.surface.back().position - path.camera.position());
    head[0] = withBits(path.edges(), (light.isDelta() ? 1u : 0u) | (light.isInfinite() ? 2u : 0u), direct / emit,
                       light.isDelta() ? 0 : cosine / emit);
    head[1] = reals(direct, emit, distance, cosine);
    head[2] = reals(directSolidAngle, emit / (directSolidAngle * cosine), path.camera.pdf(seen));
    for (size_t i = 0; i < path.surface.size(); ++i) {
        const SurfaceVertex& v = path.surface[i];
        const ScatterGeometry g = scatterGeometry(path, i);
        const bool specular = isSpecular(v.material), transmitted = g.towardsLight.z * g.towardsCamera.z < 0;
        const double ior = g.towardsLight.z > 0 ? double(v.material.ior) : 1 / double(v.material.ior);
        densities[i] = specular ? reals(0, 0, g.cosineLight, g.cosineCamera)
                                : reals(pdfScatter(v, g.towardsLight, g.towardsCamera),
                                        pdfScatter(v, g.towardsCamera, g.towardsLight), g.cosineLight, g.cosineCamera);
        segments[i] = reals(std::sqrt(squaredDistanceToNext(path, i)), 0, transmitted ? ior : 1);
        segments[i].y =
            std::bit_cast<float>((specular ? 1u : 0u) | (specular && transmitted ? 2u : 0u) | (v.inMedium() ? 4u : 0u));
    }
    const auto inMedium = [&](size_t i) {  // x_i, see mis_path.h
        return i > 0 && i < path.edges() && path.surface[i - 1].inMedium();
    };
    for (size_t e = 0; e < path.edges(); ++e)
        head[flights + e] = reals(flightDensity(path, e, inMedium(e + 1)), flightDensity(path, e, inMedium(e)), 0);
    data.a.insert(data.a.end(), head.begin(), head.end());
    data.b.insert(data.b.end(), densities.begin(), densities.end());
    data.c.insert(data.c.end(), segments.begin(), segments.end());
}

struct NamedCounts {
    const char* name;
    TechniqueCounts counts;
};

TEST_F(MisWeightTest, WholePathsAgreeWithEnumeration) {
    const NamedCounts algorithms[] = {{"pt", countsPt()},
                                      {"lt", countsLt(307200)},
                                      {"bpt", countsBpt(307200, 0.7)},
                                      {"bpm", countsBpm(12.5)},
                                      {"vcm", countsVcm(307200, 0.7, 12.5)},
                                      {"vcm, few light paths", countsVcm(1000, 3.5, 4e-3)}};
    Random random(11);
    std::vector<FullPath> paths;
    for (uint32_t edges = 2; edges <= greatestEdges; ++edges)
        for (int i = 0; i < 100; ++i)
            paths.push_back(randomPath({.edges = edges,
                                        .specularProbability = i % 4 == 0 ? 0.8 : 0.3,
                                        .mediumProbability = i % 2 == 0 ? 0 : 0.5},
                                       random));
    ProbeData data;
    for (const FullPath& path : paths) addPath(path, data);

    PackedScene packed;
    packed.lobes = shared::LOBE_DIELECTRIC;
    packed.features = shared::FEATURE_SCATTERING;
    KernelHarness harness(*device, packed, {});
    Worst difference;
    for (const auto& [name, counts] : algorithms) {
        shared::DispatchParameters<float> push{};
        push.hitCount = float(counts.hit);
        push.nextEventCount = float(counts.nextEvent);
        push.splatCount = push.lightPathCount = float(counts.splat);
        push.connectCount = float(counts.connection);
        push.mergeCount = float(counts.merge);
        push.inverseMergeCount = counts.merge > 0 ? float(1 / counts.merge) : 0;
        const ProbeData found = harness.run(kernel_probes::mis_probe(), data, 1, push);
        for (size_t p = 0; p < paths.size(); ++p)
            for (const TechniqueWeight& expected : enumerateWeights(paths[p], counts)) {
                const double weight = expected.merge ? double(found.b[p * pathStride + expected.s - 2].x)
                                                     : double(found.a[p * pathStride + expected.s].x);
                difference.add(std::abs(weight - expected.weight),
                               std::string(name) + (expected.merge ? ", merge s=" : ", technique s=") +
                                   std::to_string(expected.s) + " k=" + std::to_string(paths[p].edges()));
            }
    }
    SCOPED_TRACE(difference.where);
    expectWithin({"MIS", "whole paths of 2 to 15 edges, by the lines that the stages run",
                  "largest |w − w′|, w′ by enumeration", 1e-4},
                 difference.value, device->info().name);
}

}  // namespace
}  // namespace antipode
