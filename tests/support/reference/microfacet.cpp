#include "support/reference/microfacet.h"

#include <cmath>
#include <complex>

#include "support/reference/geometry.h"

namespace antipode::reference {
namespace {

double square(double x) { return x * x; }

/// Cosine beyond the interface; negative on total reflection.
double refractedCosine(double cosine, double relativeIor) {
    const double sine2 = (1 - cosine * cosine) / square(relativeIor);
    return sine2 >= 1 ? -1 : std::sqrt(1 - sine2);
}

}  // namespace

double fresnelDielectricS(double cosine, double relativeIor) {
    const double cosT = refractedCosine(cosine, relativeIor);
    return cosT < 0 ? 1 : square((cosine - relativeIor * cosT) / (cosine + relativeIor * cosT));
}

double fresnelDielectricP(double cosine, double relativeIor) {
    const double cosT = refractedCosine(cosine, relativeIor);
    return cosT < 0 ? 1 : square((relativeIor * cosine - cosT) / (relativeIor * cosine + cosT));
}

double fresnelDielectric(double cosine, double relativeIor) {
    if (relativeIor == 1) return 0;  // also at grazing incidence, where the quotients are 0/0
    return (fresnelDielectricS(cosine, relativeIor) + fresnelDielectricP(cosine, relativeIor)) / 2;
}

double fresnelConductor(double cosine, double eta, double k) {
    const std::complex<double> n(eta, k);
    const std::complex<double> cosT = std::sqrt(1.0 - (1 - cosine * cosine) / (n * n));
    return (std::norm((cosine - n * cosT) / (cosine + n * cosT)) +
            std::norm((n * cosine - cosT) / (n * cosine + cosT))) /
           2;
}

double ggxDistribution(const Vec3d& m, double alpha) {
    if (m.z <= 0) return 0;
    const double a2 = alpha * alpha;
    return a2 / (kPi * square(m.x * m.x + m.y * m.y + m.z * m.z * a2));
}

double ggxLambda(const Vec3d& w, double alpha) {
    const double tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
    return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
}

double ggxShadowing(const Vec3d& wo, const Vec3d& wi, double alpha) {
    return 1 / (1 + ggxLambda(wo, alpha) + ggxLambda(wi, alpha));
}

Vec3d sampleVisibleNormal(const Vec3d& wo, double alpha, double u1, double u2) {
    const Vec3d stretched = normalize(Vec3d{alpha * wo.x, alpha * wo.y, wo.z});
    const double lengthXy = std::hypot(stretched.x, stretched.y);
    const Vec3d t1 = lengthXy > 0 ? Vec3d{-stretched.y, stretched.x, 0} / lengthXy : Vec3d{1, 0, 0};
    const Vec3d t2 = cross(stretched, t1);
    const double r = std::sqrt(u1), phi = 2 * kPi * u2, s = (1 + stretched.z) / 2;
    const double p1 = r * std::cos(phi);
    const double p2 = (1 - s) * std::sqrt(1 - p1 * p1) + s * r * std::sin(phi);
    const Vec3d n = t1 * p1 + t2 * p2 + stretched * std::sqrt(std::fmax(0, 1 - p1 * p1 - p2 * p2));
    return normalize(Vec3d{alpha * n.x, alpha * n.y, std::fmax(0, n.z)});
}

double pdfVisibleNormal(const Vec3d& wo, const Vec3d& m, double alpha) {
    const double cosine = dot(wo, m);
    if (cosine <= 0 || wo.z <= 0) return 0;
    return cosine * ggxDistribution(m, alpha) / ((1 + ggxLambda(wo, alpha)) * wo.z);
}

}  // namespace antipode::reference
