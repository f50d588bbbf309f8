#include "support/reference/mis_path.h"

#include <algorithm>
#include <cmath>

namespace antipode::reference {

bool FullPath::purelySpecular() const {
    return std::all_of(surface.begin(), surface.end(),
                       [](const SurfaceVertex& v) { return !v.inMedium() && isSpecular(v.material); });
}

double pdfScatter(const SurfaceVertex& vertex, const Vec3d& in, const Vec3d& out) {
    if (!vertex.inMedium()) return pdfBsdf(vertex.material, in, out);
    const double g = *vertex.anisotropy, turned = -dot(in, out);
    return (1 - g * g) / (4 * kPi * std::pow(1 + g * g - 2 * g * turned, 1.5));
}

TechniqueCounts countsPt() { return {.hit = 1, .nextEvent = 1}; }
TechniqueCounts countsNaivePt() { return {.hit = 1, .nextEvent = 0}; }
TechniqueCounts countsLt(double lightPaths) { return {.hit = 0, .nextEvent = 0, .splat = lightPaths}; }
TechniqueCounts countsBpt(double lightPaths, double kappa) {
    return {.hit = 1, .nextEvent = 1, .splat = lightPaths, .connection = kappa};
}
TechniqueCounts countsBpm(double eta) { return {.hit = 0, .nextEvent = 0, .merge = eta}; }
TechniqueCounts countsVcm(double lightPaths, double kappa, double eta) {
    return {.hit = 1, .nextEvent = 1, .splat = lightPaths, .connection = kappa, .merge = eta};
}

namespace {

Vec3d positionTowardsCamera(const FullPath& path, size_t index) {
    return index + 1 < path.surface.size() ? path.surface[index + 1].position : path.camera.position();
}

}  // namespace

ScatterGeometry scatterGeometry(const FullPath& path, size_t index) {
    const SurfaceVertex& vertex = path.surface[index];
    const Frame frame(vertex.normal);
    ScatterGeometry g;
    g.towardsLight = frame.toLocal(index == 0 ? -path.lightPoint.directionFromLight
                                              : normalize(path.surface[index - 1].position - vertex.position));
    g.towardsCamera = frame.toLocal(normalize(positionTowardsCamera(path, index) - vertex.position));
    g.cosineLight = vertex.inMedium() ? 1 : std::abs(g.towardsLight.z);
    g.cosineCamera = vertex.inMedium() ? 1 : std::abs(g.towardsCamera.z);
    return g;
}

double flightDensity(const FullPath& path, size_t edge, bool endsInMedium) {
    if (path.extinction.empty()) return 1;
    double distance = 0;
    if (edge > 0)
        distance = std::sqrt(squaredDistanceToNext(path, edge - 1));
    else if (!path.light.isInfinite())
        distance = length(path.surface[0].position - path.lightPoint.position);
    double density = 0;
    for (const double lost : {path.extinction[edge].x, path.extinction[edge].y, path.extinction[edge].z})
        density += (endsInMedium ? lost : 1) * std::exp(-lost * distance) / 3;
    return density;
}

double squaredDistanceToNext(const FullPath& path, size_t index) {
    const Vec3d d = positionTowardsCamera(path, index) - path.surface[index].position;
    return dot(d, d);
}

}  // namespace antipode::reference
