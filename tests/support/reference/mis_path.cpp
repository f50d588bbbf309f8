#include "support/reference/mis_path.h"

#include <algorithm>
#include <cmath>

namespace antipode::reference {

bool FullPath::purelySpecular() const {
    return std::all_of(surface.begin(), surface.end(), [](const SurfaceVertex& v) { return isSpecular(v.material); });
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
    g.cosineLight = std::abs(g.towardsLight.z);
    g.cosineCamera = std::abs(g.towardsCamera.z);
    return g;
}

double squaredDistanceToNext(const FullPath& path, size_t index) {
    const Vec3d d = positionTowardsCamera(path, index) - path.surface[index].position;
    return dot(d, d);
}

}  // namespace antipode::reference
