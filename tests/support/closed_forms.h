// Radiances, irradiances and energies that are known exactly (or by quadrature to full precision), for comparison with
// renders. Units: W, m, sr; angles in radians; ρ is a diffuse reflectance in [0, 1]; n a refractive index ≥ 1.
#pragma once

#include <cstdint>

namespace antipode::closed_forms {

// --- Furnaces ---

/// Lo of a convex Lambertian body under uniform radiance L from everywhere: ρL.
double whiteFurnace(double reflectance, double radiance);
/// Radiance that a camera inside a medium of index n sees of uniform radiance L outside, radiance scaling kept: n²L.
double radianceInsideGlass(double n, double radiance);
/// Closed furnace whose surfaces all emit Le and reflect ρ, light after at most `bounces`: Le(1−ρ^(bounces+1))/(1−ρ).
double closedFurnace(double emitted, double reflectance, uint32_t bounces);
/// The same after all bounces.
double closedFurnace(double emitted, double reflectance);
/// Radiance between two facing emitting mirrors of reflectance R after at most `bounces`: the furnace's series.
double facingMirrors(double emitted, double reflectance, uint32_t bounces);
/// Wall radiance by reflection alone of a diffuse sphere of radius r with a point light (intensity I) in its centre,
/// after all bounces: ρI/(πr²(1−ρ)).
double integratingSphere(double reflectance, double intensity, double radius);

// --- Irradiance of a plane by a light, W/m² ---

/// Point light of intensity I at height h, at the distance r from the foot: Ih/(h²+r²)^(3/2).
double irradianceOfPointLight(double intensity, double height, double r);
/// Sphere of radius R and radiance L, its centre at height h > R: πL(R/d)²cosθ (above the horizon).
double irradianceOfSphereLight(double radiance, double radius, double height, double r);
/// Disk of radius R and radiance L, parallel to the plane at height h, its axis at distance r.
double irradianceOfDiskLight(double radiance, double radius, double height, double r);
/// Form factor E/(πL) of a rectangle a × b parallel to the plane at height h, under one of its corners.
double formFactorUnderCorner(double a, double b, double height);
/// The same under its centre.
double formFactorUnderCentre(double a, double b, double height);

// --- Form factors between unit squares ---

double formFactorParallelSquares(double distance);
/// Perpendicular, sharing an edge.
double formFactorPerpendicularSquares();

// --- Fresnel and glass; n is the index beyond the interface over the index in front ---

double fresnelS(double angle, double n);
double fresnelP(double angle, double n);
/// Unpolarised.
double fresnel(double angle, double n);
/// Of light inside a medium of index n against vacuum.
double criticalAngle(double n);
double brewsterAngle(double n);
/// Fresnel reflectance under cosine-weighted hemispherical light: 2∫R cosθ sinθ dθ.
double fresnelCosineHemispherical(double n);
/// Transmittance of a slab with all inner reflections: (1−R)/(1+R), R unpolarised at the outer angle.
double slabTransmittance(double angle, double n);
/// Lo of a Lambertian floor under a slab lit by a directional light (E₀ on a facing plane), without light that the
/// floor sends back: ρE₀cosθ·T/π.
double slabCaustic(double reflectance, double irradiance, double angle, double n);

// --- Ball lens: collimated light (E₀ = 1) on a glass sphere of radius 1, two refractions, polarisation ignored ---

/// Irradiance at distance `r` > 0 from the axis on a plane at `planeDistance` from the centre, behind the sphere's
/// paraxial focus, summed over all rays that arrive there.
double ballLensIrradiance(double n, double planeDistance, double r);
/// Transmitted flux over πR².
double ballLensTransmittance(double n);

// --- Microfacets ---

/// Directional albedo of GGX with F = 1 and height-correlated Smith shadowing (single scattering), at cosine μ.
double ggxSingleScatterAlbedo(double alpha, double mu);
/// The same of an interface that reflects and refracts, both together; n: index beyond over index here.
double ggxSingleScatterGlass(double alpha, double mu, double n);

}  // namespace antipode::closed_forms
