// A complete light transport path, and how many samples each technique that can make it takes: what both evaluations of
// MIS weights (mis_enumerator.h, mis_recursion.h) start from.
//
// Vertices: x_0 on the light, x_1 … x_{k−1} on surfaces or points in media that scatter, x_k the camera; k edges.
// Technique (s, t), s + t = k + 1:
//   s = 0 emitter hit, s = 1 next event, t = 1 splat, else connection; merging at x_j joins light vertices 0 … j with
//   camera vertices j … k.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "support/reference/bsdf.h"
#include "support/reference/camera.h"
#include "support/reference/lights.h"

namespace antipode::reference {

struct SurfaceVertex {
    Vec3d position;
    Vec3d normal;  ///< unit, front
    Material material;
    std::optional<double> anisotropy{};  ///< of a point in a medium, of which normal and material say nothing

    bool inMedium() const { return anisotropy.has_value(); }
};

/// Density per solid angle of leaving a vertex that is not specular: local unit directions. In a medium by Henyey and
/// Greenstein's phase function.
double pdfScatter(const SurfaceVertex& vertex, const Vec3d& in, const Vec3d& out);

struct FullPath {
    Light light{};
    double pickProbability = 1;
    LightPoint lightPoint{};               ///< directionFromLight leads to the next vertex
    std::vector<SurfaceVertex> surface{};  ///< x_1 … x_{k−1}
    PinholeCamera camera;
    /// Of the media between vertices: what a unit of length takes from each channel on edge x_i x_{i+1}. Empty:
    /// nothing.
    std::vector<Vec3d> extinction{};

    uint32_t edges() const { return uint32_t(surface.size()) + 1; }
    /// Only the emitter hit can sample a path without a non-specular surface vertex.
    bool purelySpecular() const;
};

/// Samples per pixel and iteration of every technique; 0 switches one off.
struct TechniqueCounts {
    double hit = 1;         ///< 0 or 1; taken as 1 for purely specular paths, which nothing else can sample
    double nextEvent = 1;   ///< 0 or 1
    double splat = 0;       ///< N light paths, or 0
    double connection = 0;  ///< κ = K·N/M̂: K connections per camera vertex, M̂ stored light vertices per iteration
    double merge = 0;       ///< η = πr²N
};

/// The named algorithms' counts for N light paths, merge factor η and connection count κ.
TechniqueCounts countsPt();
TechniqueCounts countsNaivePt();
TechniqueCounts countsLt(double lightPaths);
TechniqueCounts countsBpt(double lightPaths, double kappa);
TechniqueCounts countsBpm(double eta);
TechniqueCounts countsVcm(double lightPaths, double kappa, double eta);

struct TechniqueWeight {
    uint32_t s = 0;  ///< light vertices; for a merge, those up to and including the merged one
    bool merge = false;
    double weight = 0;
};

/// Densities at surface vertex i (index into FullPath::surface), seen along one direction of travel.
struct ScatterGeometry {
    Vec3d towardsLight, towardsCamera;  ///< local unit directions at the vertex
    double cosineLight, cosineCamera;   ///< their |z|
};
ScatterGeometry scatterGeometry(const FullPath& path, size_t index);

/// What a density per solid angle over the squared distance is multiplied with, beside a cosine, on edge x_i x_{i+1}:
/// towards a surface the chance to fly over it, towards a point in a medium the flight's density per length there, both
/// means over the three channels.
double flightDensity(const FullPath& path, size_t edge, bool endsInMedium);

/// Square of the distance from surface vertex i to its neighbour towards the camera (the camera itself for the last).
double squaredDistanceToNext(const FullPath& path, size_t index);

}  // namespace antipode::reference
