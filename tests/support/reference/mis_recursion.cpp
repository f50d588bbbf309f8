#include "support/reference/mis_recursion.h"

#include <algorithm>
#include <cmath>

namespace antipode::reference {
namespace {

/// The local quantities of one surface vertex, for a sub-path that arrives by `in` and leaves by `out`.
struct Scatter {
    bool specular;
    double pdf, pdfReverse;  ///< per solid angle; non-specular only
    double cosineIn, cosineOut;
    double indexRatio;  ///< index on the arrival side over index on the leaving side
};

Scatter scatterAt(const SurfaceVertex& vertex, const Vec3d& in, const Vec3d& out) {
    const Material& material = vertex.material;
    Scatter s{isSpecular(material), 0, 0, std::abs(in.z), std::abs(out.z), 1};
    if (vertex.inMedium()) s.cosineIn = s.cosineOut = 1;
    if (!s.specular) {
        s.pdf = pdfScatter(vertex, in, out);
        s.pdfReverse = pdfScatter(vertex, out, in);
    } else if (in.z * out.z < 0) {
        s.indexRatio = in.z > 0 ? 1.0 / material.ior : double(material.ior);
    }
    return s;
}

template <class Real>
class Recursion {
public:
    Recursion(const FullPath& path, const TechniqueCounts& counts) : path_(path), counts_(counts) {
        for (size_t i = 0; i < path.surface.size(); ++i) geometry_.push_back(scatterGeometry(path, i));
        traceLight();
        traceCamera();
    }

    std::vector<TechniqueWeight> weights() const {
        std::vector<TechniqueWeight> result;
        const uint32_t k = path_.edges();
        const auto add = [&](uint32_t s, bool merge, Real count, Real others) {
            if (count > 0) result.push_back({s, merge, double(count / (count + others))});
        };
        if (!path_.light.isDelta()) add(0, false, path_.purelySpecular() ? 1 : Real(counts_.hit), hitOthers());
        for (uint32_t s = 1; s <= k && k >= 2; ++s) {
            const bool lightEnd = s == 1 || connectable(s - 1), cameraEnd = s == k || connectable(s);
            if (!lightEnd || !cameraEnd) continue;
            if (s == 1)
                add(s, false, Real(counts_.nextEvent), nextEventOthers());
            else if (s == k)
                add(s, false, Real(counts_.splat), splatOthers());
            else
                add(s, false, Real(counts_.connection), connectionOthers(s));
        }
        for (uint32_t j = 1; j < k; ++j)
            if (connectable(j) && !path_.surface[j - 1].inMedium())
                add(j + 1, true, Real(counts_.merge), mergeOthers(j));
        return result;
    }

private:
    using State = SubPathState<Real>;

    bool connectable(uint32_t vertex) const { return !isSpecular(path_.surface[vertex - 1].material); }
    double lightDistance2() const {
        const Vec3d d = path_.surface[0].position - path_.lightPoint.position;
        return dot(d, d);
    }
    double emitPdf() const { return path_.pickProbability * pdfEmit(path_.light, path_.lightPoint); }
    double directPdf() const { return path_.pickProbability * pdfDirect(path_.light, path_.lightPoint); }
    double lightCosine() const { return cosineAtLight(path_.light, path_.lightPoint); }

    Real lightCount(const State& s) const { return Real(s.edges == 1 ? counts_.nextEvent : counts_.connection); }
    Real cameraCount(const State& s) const { return Real(s.edges == 1 ? counts_.splat : counts_.connection); }

    /// Whether vertex x_i is a point in a medium; neither the light (0) nor the camera is.
    bool inMedium(size_t i) const { return i > 0 && i <= path_.surface.size() && path_.surface[i - 1].inMedium(); }
    double mergeCount(size_t surface) const { return path_.surface[surface].inMedium() ? 0 : counts_.merge; }
    /// Times the density of the flight to the vertex from its neighbour towards the light, or the camera.
    double cosineLight(size_t i) const { return geometry_[i].cosineLight * flightDensity(path_, i, inMedium(i + 1)); }
    double cosineCamera(size_t i) const {
        return geometry_[i].cosineCamera * flightDensity(path_, i + 1, inMedium(i + 1));
    }

    /// At the end of an edge: x_to from x_from.
    void arrive(State& state, Real distance2, double cosine, size_t from, size_t to) const {
        const size_t edge = std::min(from, to);
        const double here = flightDensity(path_, edge, inMedium(to)),
                     before = flightDensity(path_, edge, inMedium(from));
        state.dVCM = state.dVCM * distance2 / Real(cosine * here);
        state.dVC = state.dVC * Real(before / here) / Real(cosine);
        ++state.edges;
    }

    /// Leaves the surface vertex; `count` is that of the technique for which the old dVCM stands.
    void scatter(State& state, const Scatter& s, Real count, size_t surface) const {
        if (s.specular) {
            state.dVC *= Real(s.cosineIn * s.indexRatio * s.indexRatio);
            state.dVCM = 0;
            return;
        }
        state.dVC = Real(s.cosineOut / s.pdf) *
                    (Real(mergeCount(surface)) + count * state.dVCM + Real(s.pdfReverse) * state.dVC);
        state.dVCM = Real(1 / s.pdf);
    }

    void traceLight() {
        State state;
        state.dVCM = Real(directPdf() / emitPdf());
        state.dVC = path_.light.isDelta() ? Real(0) : Real(counts_.hit * lightCosine() / emitPdf());
        for (size_t i = 0; i < path_.surface.size(); ++i) {
            Real distance2 = 1;  // on the first segment from an infinite light
            if (i > 0)
                distance2 = Real(squaredDistanceToNext(path_, i - 1));
            else if (!path_.light.isInfinite())
                distance2 = Real(lightDistance2());
            arrive(state, distance2, geometry_[i].cosineLight, i, i + 1);
            light_.push_back(state);
            scatter(state, scatterAt(path_.surface[i], geometry_[i].towardsLight, geometry_[i].towardsCamera),
                    lightCount(state), i);
        }
    }

    void traceCamera() {
        camera_.resize(path_.surface.size());
        State state;
        for (size_t i = path_.surface.size(); i-- > 0;) {
            if (i + 1 == path_.surface.size())
                state.dVCM = Real(1 / path_.camera.pdf(normalize(path_.surface[i].position - path_.camera.position())));
            arrive(state, Real(squaredDistanceToNext(path_, i)), geometry_[i].cosineCamera, i + 2, i + 1);
            camera_[i] = state;
            scatter(state, scatterAt(path_.surface[i], geometry_[i].towardsCamera, geometry_[i].towardsLight),
                    cameraCount(state), i);
        }
        if (!path_.light.isInfinite() && !path_.surface.empty())
            arrive(state, Real(lightDistance2()), lightCosine(), 1, 0);
        atLight_ = state;
    }

    /// n·p of all techniques further back along a sub-path, relative to the current one, per unit of the area density
    /// with which the other side would sample the sub-path's last vertex (merging there included).
    Real further(const State& state, Real count, double reversePdf, size_t surface) const {
        return Real(mergeCount(surface)) + count * state.dVCM + Real(reversePdf) * state.dVC;
    }
    Real furtherOnLight(size_t i) const {
        const Scatter s = scatterAt(path_.surface[i], geometry_[i].towardsLight, geometry_[i].towardsCamera);
        return further(light_[i], lightCount(light_[i]), s.pdfReverse, i);
    }
    Real furtherOnCamera(size_t i) const {
        const Scatter s = scatterAt(path_.surface[i], geometry_[i].towardsCamera, geometry_[i].towardsLight);
        return further(camera_[i], cameraCount(camera_[i]), s.pdfReverse, i);
    }
    double pdfTowardsLight(size_t i) const {
        return scatterAt(path_.surface[i], geometry_[i].towardsCamera, geometry_[i].towardsLight).pdf;
    }
    double pdfTowardsCamera(size_t i) const {
        return scatterAt(path_.surface[i], geometry_[i].towardsLight, geometry_[i].towardsCamera).pdf;
    }

    Real hitOthers() const {
        if (path_.purelySpecular()) return 0;
        return Real(counts_.nextEvent * directPdf()) * atLight_.dVCM + Real(emitPdf()) * atLight_.dVC;
    }

    Real nextEventOthers() const {
        const double distance2 = path_.light.isInfinite() ? 1 : lightDistance2();
        const double directSolidAngle = directPdf() * distance2 / lightCosine();
        const double meeting = pdfTowardsLight(0) * flightDensity(path_, 0, false);
        const Real hit = path_.light.isDelta() ? Real(0) : Real(counts_.hit * meeting / directSolidAngle);
        return hit + Real(emitPdf() * cosineLight(0) / (directSolidAngle * lightCosine())) * furtherOnCamera(0);
    }

    Real splatOthers() const {
        const size_t last = path_.surface.size() - 1;
        const double pdf = path_.camera.pdf(normalize(path_.surface[last].position - path_.camera.position()));
        return Real(pdf * cosineCamera(last) / squaredDistanceToNext(path_, last)) * furtherOnLight(last);
    }

    Real connectionOthers(uint32_t s) const {
        const size_t y = s - 2, x = s - 1;  // surface indices of the light path's and the camera path's last vertex
        const double distance2 = squaredDistanceToNext(path_, y);
        return Real(pdfTowardsLight(x) * cosineCamera(y) / distance2) * furtherOnLight(y) +
               Real(pdfTowardsCamera(y) * cosineLight(x) / distance2) * furtherOnCamera(x);
    }

    Real mergeOthers(uint32_t vertex) const {
        const size_t i = vertex - 1;
        const State &l = light_[i], &c = camera_[i];
        return lightCount(l) * l.dVCM + Real(pdfTowardsLight(i)) * l.dVC + cameraCount(c) * c.dVCM +
               Real(pdfTowardsCamera(i)) * c.dVC;
    }

    const FullPath& path_;
    const TechniqueCounts& counts_;
    std::vector<ScatterGeometry> geometry_;
    std::vector<State> light_, camera_;  ///< per surface vertex, after arrival
    State atLight_;                      ///< the camera path's, where it hits the light
};

}  // namespace

template <class Real>
std::vector<TechniqueWeight> recursiveWeights(const FullPath& path, const TechniqueCounts& counts) {
    return Recursion<Real>(path, counts).weights();
}

template std::vector<TechniqueWeight> recursiveWeights<double>(const FullPath&, const TechniqueCounts&);
template std::vector<TechniqueWeight> recursiveWeights<float>(const FullPath&, const TechniqueCounts&);

}  // namespace antipode::reference
