#include "support/reference/mis_enumerator.h"

#include <algorithm>
#include <cmath>

namespace antipode::reference {
namespace {

enum class Travel { FromLight, FromCamera };

/// log of the density per solid angle (times the delta for smooth materials) with which a sub-path leaves surface
/// vertex i in its direction of travel. Roulette is part of no density.
double logScatter(const FullPath& path, size_t i, Travel travel) {
    const SurfaceVertex& vertex = path.surface[i];
    const ScatterGeometry g = scatterGeometry(path, i);
    const Vec3d in = travel == Travel::FromLight ? g.towardsLight : g.towardsCamera;
    const Vec3d out = travel == Travel::FromLight ? g.towardsCamera : g.towardsLight;
    if (!isSpecular(vertex.material)) return std::log(pdfScatter(vertex, in, out));
    const bool dielectric = vertex.material.kind == MaterialKind::Dielectric;
    const double indexOut = dielectric && out.z < 0 ? vertex.material.ior : 1;
    return std::log(specularProbability(vertex.material, in, out) * indexOut * indexOut * std::abs(out.z));
}

/// log density of the first s light vertices as sampled from the light, for s = 0 … k. s = 1 is next event's choice.
std::vector<double> logLightPrefixes(const FullPath& path) {
    std::vector<double> logs{0, std::log(path.pickProbability * pdfDirect(path.light, path.lightPoint))};
    double log = std::log(path.pickProbability * pdfEmit(path.light, path.lightPoint));
    for (size_t i = 0; i < path.surface.size(); ++i) {
        log += std::log(scatterGeometry(path, i).cosineLight * flightDensity(path, i, path.surface[i].inMedium()));
        if (i > 0) {
            log += logScatter(path, i - 1, Travel::FromLight) - std::log(squaredDistanceToNext(path, i - 1));
        } else if (!path.light.isInfinite()) {
            const Vec3d d = path.surface[0].position - path.lightPoint.position;
            log -= std::log(dot(d, d));
        }
        logs.push_back(log);
    }
    return logs;
}

/// log density of the last t vertices as sampled from the camera, for t = 0 … k + 1; the camera itself counts as given.
std::vector<double> logCameraSuffixes(const FullPath& path) {
    std::vector<double> logs{0, 0};
    if (path.surface.empty()) return {0, 0, 0};  // the light directly seen: no competing technique
    const size_t last = path.surface.size() - 1;
    const Vec3d first = path.surface[last].position - path.camera.position();
    double log = std::log(path.camera.pdf(normalize(first)));
    for (size_t i = last + 1; i-- > 0;) {
        if (i < last) log += logScatter(path, i + 1, Travel::FromCamera);
        log += std::log(scatterGeometry(path, i).cosineCamera) - std::log(squaredDistanceToNext(path, i));
        log += std::log(flightDensity(path, i + 1, path.surface[i].inMedium()));
        logs.push_back(log);
    }
    log += logScatter(path, 0, Travel::FromCamera) + std::log(flightDensity(path, 0, false));
    if (path.light.isDelta()) {
        log = -kInfinity;
    } else if (!path.light.isInfinite()) {
        const Vec3d d = path.surface[0].position - path.lightPoint.position;
        log += std::log(cosineAtLight(path.light, path.lightPoint)) - std::log(dot(d, d));
    }
    logs.push_back(log);
    return logs;
}

}  // namespace

std::vector<TechniqueWeight> enumerateWeights(const FullPath& path, const TechniqueCounts& counts) {
    const uint32_t k = path.edges();
    const std::vector<double> light = logLightPrefixes(path), camera = logCameraSuffixes(path);
    const auto connectable = [&](uint32_t vertex) { return !isSpecular(path.surface[vertex - 1].material); };

    struct Entry {
        TechniqueWeight technique;
        double log;
    };
    std::vector<Entry> entries;
    const auto add = [&](uint32_t s, bool merge, double count, double log) {
        if (count > 0 && log > -kInfinity) entries.push_back({{s, merge, 0}, std::log(count) + log});
    };

    add(0, false, path.purelySpecular() ? 1 : counts.hit, camera[k + 1]);
    for (uint32_t s = 1; s <= k && k >= 2; ++s) {
        // The connecting edge is x_{s−1} x_s; the light (s = 1) and the camera (s = k) are always connectable.
        const bool lightEnd = s == 1 || connectable(s - 1), cameraEnd = s == k || connectable(s);
        const double count = s == 1 ? counts.nextEvent : s == k ? counts.splat : counts.connection;
        if (lightEnd && cameraEnd) add(s, false, count, light[s] + camera[k + 1 - s]);
    }
    for (uint32_t j = 1; j < k; ++j)
        if (connectable(j) && !path.surface[j - 1].inMedium())
            add(j + 1, true, counts.merge, light[j + 1] + camera[k + 1 - j]);

    double largest = -kInfinity, sum = 0;
    for (const Entry& entry : entries) largest = std::max(largest, entry.log);
    for (const Entry& entry : entries) sum += std::exp(entry.log - largest);
    std::vector<TechniqueWeight> weights;
    for (const Entry& entry : entries) {
        weights.push_back(entry.technique);
        weights.back().weight = std::exp(entry.log - largest) / sum;
    }
    return weights;
}

}  // namespace antipode::reference
