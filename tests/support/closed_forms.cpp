#include "support/closed_forms.h"

#include <cmath>
#include <functional>

namespace antipode::closed_forms {
namespace {

constexpr double kPi = 3.14159265358979323846;

double square(double x) { return x * x; }

/// Composite Gauss–Legendre quadrature, 4 points per interval.
double integrate(const std::function<double(double)>& f, double from, double to, int intervals) {
    static constexpr double kNode[] = {0.3399810435848563, 0.8611363115940526};
    static constexpr double kWeight[] = {0.6521451548625461, 0.3478548451374538};
    const double half = (to - from) / (2 * intervals);
    double sum = 0;
    for (int i = 0; i < intervals; ++i) {
        const double middle = from + (2 * i + 1) * half;
        for (int j = 0; j < 2; ++j) sum += kWeight[j] * (f(middle - kNode[j] * half) + f(middle + kNode[j] * half));
    }
    return sum * half;
}

}  // namespace

double whiteFurnace(double reflectance, double radiance) { return reflectance * radiance; }

double radianceInsideGlass(double n, double radiance) { return n * n * radiance; }

double closedFurnace(double emitted, double reflectance, uint32_t bounces) {
    if (reflectance == 1) return emitted * (bounces + 1.0);
    return emitted * (1 - std::pow(reflectance, bounces + 1.0)) / (1 - reflectance);
}

double closedFurnace(double emitted, double reflectance) { return emitted / (1 - reflectance); }

double facingMirrors(double emitted, double reflectance, uint32_t bounces) {
    return closedFurnace(emitted, reflectance, bounces);
}

double integratingSphere(double reflectance, double intensity, double radius) {
    return reflectance * intensity / (kPi * radius * radius * (1 - reflectance));
}

double irradianceOfPointLight(double intensity, double height, double r) {
    return intensity * height / std::pow(height * height + r * r, 1.5);
}

double irradianceOfSphereLight(double radiance, double radius, double height, double r) {
    const double squaredDistance = height * height + r * r;
    return kPi * radiance * radius * radius / squaredDistance * height / std::sqrt(squaredDistance);
}

double irradianceOfDiskLight(double radiance, double radius, double height, double r) {
    const double h2 = height * height, r2 = r * r, d2 = radius * radius;
    return kPi * radiance / 2 * (1 - (r2 + h2 - d2) / std::sqrt(square(r2 + h2 + d2) - 4 * r2 * d2));
}

double formFactorUnderCorner(double a, double b, double height) {
    const double x = a / height, y = b / height, sx = std::sqrt(1 + x * x), sy = std::sqrt(1 + y * y);
    return (x / sx * std::atan(y / sx) + y / sy * std::atan(x / sy)) / (2 * kPi);
}

double formFactorUnderCentre(double a, double b, double height) {
    return 4 * formFactorUnderCorner(a / 2, b / 2, height);
}

double formFactorParallelSquares(double distance) {
    const double x = 1 / distance, s = std::sqrt(1 + x * x);
    return 2 / (kPi * x * x) *
           (std::log((1 + x * x) / std::sqrt(1 + 2 * x * x)) + 2 * x * s * std::atan(x / s) - 2 * x * std::atan(x));
}

double formFactorPerpendicularSquares() {
    const double root = std::sqrt(2.0);
    return (2 * std::atan(1.0) - root * std::atan(1 / root) + std::log(0.75) / 4) / kPi;
}

double fresnelS(double angle, double n) {
    const double sine = std::sin(angle) / n;
    if (sine >= 1) return 1;
    const double cosine = std::cos(angle), refracted = n * std::sqrt(1 - sine * sine);
    return square((cosine - refracted) / (cosine + refracted));
}

double fresnelP(double angle, double n) {
    const double sine = std::sin(angle) / n;
    if (sine >= 1) return 1;
    const double cosine = n * std::cos(angle), refracted = std::sqrt(1 - sine * sine);
    return square((cosine - refracted) / (cosine + refracted));
}

double fresnel(double angle, double n) { return (fresnelS(angle, n) + fresnelP(angle, n)) / 2; }

double criticalAngle(double n) { return std::asin(1 / n); }

double brewsterAngle(double n) { return std::atan(n); }

double fresnelCosineHemispherical(double n) {
    // Towards an end where R has a square-root singularity, t² spaces the nodes.
    const auto part = [n](double from, double to) {
        return integrate(
            [&](double t) {
                const double angle = to - (to - from) * t * t;
                return fresnel(angle, n) * std::sin(2 * angle) * 2 * t * (to - from);
            },
            0, 1, 400);
    };
    if (n >= 1) return part(0, kPi / 2);
    const double critical = std::asin(n);
    return part(0, critical) + square(std::cos(critical));
}

double slabTransmittance(double angle, double n) {
    const double R = fresnel(angle, n);
    return (1 - R) / (1 + R);
}

double slabCaustic(double reflectance, double irradiance, double angle, double n) {
    return reflectance * irradiance * std::cos(angle) * slabTransmittance(angle, n) / kPi;
}

namespace {

/// Signed distance from the axis at which a ray of impact parameter b, in (0, 1), meets the plane.
double ballLensLanding(double n, double planeDistance, double b) {
    const double in = std::asin(b), refracted = std::asin(b / n);
    const double exitPolar = in + kPi - 2 * refracted;  // angle of the exit point from the point that faces the light
    const double deviation = 2 * (in - refracted);      // towards the axis
    const double x = -std::cos(exitPolar), y = std::sin(exitPolar);
    return y - (planeDistance - x) * std::tan(deviation);
}

}  // namespace

double ballLensIrradiance(double n, double planeDistance, double r) {
    constexpr int kSteps = 4000;
    constexpr double kStep = 1e-6;
    double sum = 0;
    for (const double target : {r, -r}) {
        const auto miss = [&](double b) { return ballLensLanding(n, planeDistance, b) - target; };
        for (int i = 0; i < kSteps; ++i) {
            double low = (i + 1e-9) / kSteps, high = (i + 1 - 1e-9) / kSteps;
            // A ray deviated by a right angle or more never meets the plane; tan changes sign there without a root.
            if (miss(low) * miss(high) > 0 || 2 * (std::asin(high) - std::asin(high / n)) >= kPi / 2) continue;
            for (int halving = 0; halving < 60; ++halving) {
                const double middle = (low + high) / 2;
                (miss(low) * miss(middle) > 0 ? low : high) = middle;
            }
            const double b = low, slope = (miss(b + kStep) - miss(b - kStep)) / (2 * kStep);
            sum += square(1 - fresnel(std::asin(b), n)) * b / (r * std::abs(slope));
        }
    }
    return sum;
}

double ballLensTransmittance(double n) {
    return integrate([n](double angle) { return square(1 - fresnel(angle, n)) * std::sin(2 * angle); }, 0, kPi / 2,
                     400);
}

namespace {

/// `kept`(o·m, n·m, leaving): what a facet m sends out, leaving(cosine) being what masking lets out there of all light.
template <class Kept>
double overFacets(double alpha, double mu, const Kept& kept) {
    // Over the half vector m, where dωi = 4(wo·m) dωm: ∫ D·G2·(wo·m)/μ dωm.
    const double sine = std::sqrt(1 - mu * mu), a2 = alpha * alpha;
    const auto lambda = [&](double cosine) {
        return (std::sqrt(1 + a2 * (1 - cosine * cosine) / (cosine * cosine)) - 1) / 2;
    };
    const auto overAzimuth = [&](double theta) {
        const double cosM = std::cos(theta), sinM = std::sin(theta);
        const double D = a2 / (kPi * square(sinM * sinM + cosM * cosM * a2));
        return D * sinM * 2 *
               integrate(
                   [&](double phi) {
                       const double oDotM = sine * sinM * std::cos(phi) + mu * cosM;
                       const auto leaving = [&](double cosine) {
                           return cosine <= 0 ? 0.0 : oDotM / (mu * (1 + lambda(mu) + lambda(cosine)));
                       };
                       return oDotM <= 0 ? 0.0 : kept(oDotM, cosM, leaving);
                   },
                   0, kPi, 300);
    };
    return integrate(overAzimuth, 0, kPi / 2, 300);
}

}  // namespace

double ggxSingleScatterAlbedo(double alpha, double mu) {
    return overFacets(alpha, mu,
                      [&](double oDotM, double cosM, const auto& leaving) { return leaving(2 * oDotM * cosM - mu); });
}

double ggxSingleScatterGlass(double alpha, double mu, double n) {
    return overFacets(alpha, mu, [&](double oDotM, double cosM, const auto& leaving) {
        const double F = fresnel(std::acos(std::min(oDotM, 1.0)), n), reflected = F * leaving(2 * oDotM * cosM - mu);
        const double sine = std::sqrt(std::max(1 - square(oDotM), 0.0)) / n;
        if (sine >= 1) return reflected;
        return reflected + (1 - F) * leaving(mu / n - cosM * (oDotM / n - std::sqrt(1 - sine * sine)));
    });
}

}  // namespace antipode::closed_forms
