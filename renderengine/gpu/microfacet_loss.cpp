#include "gpu/microfacet_loss.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace antipode {
namespace {

/// Smith's Λ.
double lambda(double cosine, double alpha) {
    const double c2 = cosine * cosine;
    return 0.5 * (std::sqrt(1 + alpha * alpha * std::max(1 - c2, 0.0) / c2) - 1);
}

/// A facet that is seen: the cosines that its normal makes with the direction it is seen from, and with the surface's.
struct Facet {
    double toView, toNormal;
};

/// Two successive Fibonacci numbers.
struct Lattice {
    int points, step;
};

/// The part of what leaves a facet at this cosine to the surface that other facets stop: all of it below the surface.
double shadowed(double known, double cosine, double alpha) {
    if (cosine <= 0) return 1;
    const double shadowing = lambda(cosine, alpha);
    return shadowing / (known + shadowing);
}

double fresnel(double cosine, double eta) {
    const double sine2 = std::max(1 - cosine * cosine, 0.0) / (eta * eta);
    if (sine2 >= 1) return 1;
    const double beyond = std::sqrt(1 - sine2);
    const double p = (eta * cosine - beyond) / (eta * cosine + beyond),
                 s = (cosine - eta * beyond) / (cosine + eta * beyond);
    return 0.5 * (p * p + s * s);
}

/// The mean over the facets that are seen from the cosine μ (Heitz, JCGT 7(4), 2018) of `lost(facet)`, in [0,1]. The
/// facets are symmetric about the plane of incidence, of which one side is taken, at the points of a Fibonacci lattice:
/// what leaves below the horizon, or the angle of total reflection, makes integrands that no product rule likes. They
/// crowd where facets are steep, which of smooth surfaces are few, and all that loses light.
template <class Lost>
double meanOverSeenFacets(double cosine, double alpha, Lattice lattice, const Lost& lost) {
    const auto [points, step] = lattice;
    const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.0));
    // In the space where the facets are a sphere: the view (vx, 0, vz), the disk's axes across and along.
    const double length = std::hypot(alpha * sine, cosine), vx = alpha * sine / length, vz = cosine / length;
    const double s = 0.5 * (1 + vz);
    double sum = 0;
    for (int i = 0; i < points; ++i) {
        const double inside = 1 - (i + 0.5) / points, r = std::sqrt(1 - inside * inside),
                     phi = std::numbers::pi * (std::fmod(double(i) * step / points + 0.25, 1.0) - 0.5);
        const double across = r * std::cos(phi),
                     along = (1 - s) * std::sqrt(std::max(1 - across * across, 0.0)) + s * r * std::sin(phi),
                     out = std::sqrt(std::max(1 - across * across - along * along, 0.0));
        const double x = alpha * (-vz * along + vx * out), y = alpha * across, z = std::max(vx * along + vz * out, 0.0),
                     n = std::sqrt(x * x + y * y + z * z);
        const Facet facet{(sine * x + cosine * z) / n, z / n};
        sum += 2 * inside * (facet.toView > 0 ? lost(facet) : 1.0);
    }
    return sum / points;
}

}  // namespace

double metalLoss(double cosine, double alpha) {
    const double known = 1 + lambda(cosine, alpha);
    return meanOverSeenFacets(cosine, alpha, {4181, 2584}, [&](const Facet& facet) {
        return shadowed(known, 2 * facet.toView * facet.toNormal - cosine, alpha);
    });
}

double coatAlbedo(double cosine, double alpha) {
    const double known = 1 + lambda(cosine, alpha);
    return 1 - meanOverSeenFacets(cosine, alpha, {4181, 2584}, [&](const Facet& facet) {
               const double passed = 1 - shadowed(known, 2 * facet.toView * facet.toNormal - cosine, alpha);
               return 1 - fresnel(facet.toView, 1.5) * passed;
           });
}

double glassLoss(double cosine, double alpha, double eta) {
    const double known = 1 + lambda(cosine, alpha);
    return meanOverSeenFacets(cosine, alpha, {1597, 987}, [&](const Facet& facet) {
        const double reflected = fresnel(facet.toView, eta);
        const double lost = reflected * shadowed(known, 2 * facet.toView * facet.toNormal - cosine, alpha);
        if (reflected == 1) return lost;
        const double refracted = std::sqrt(1 - (1 - facet.toView * facet.toView) / (eta * eta));
        const double depth = cosine / eta - facet.toNormal * (facet.toView / eta - refracted);
        return lost + (1 - reflected) * shadowed(known, depth, alpha);
    });
}

}  // namespace antipode
