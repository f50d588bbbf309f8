// Parts that the scenes of these tests are built from. Colours are grey unless said otherwise.
#pragma once

#include "renderengine/scene.h"

namespace antipode::test {

// --- Materials: each adds one and returns its index ---

uint32_t addLambert(Scene& scene, Vec3f reflectance);
/// Reflects nothing, emits `radiance` to the front, or to both sides.
uint32_t addLamp(Scene& scene, Vec3f radiance, bool twoSided = false);
uint32_t addMirror(Scene& scene, float reflectance, float emission = 0);
uint32_t addGlass(Scene& scene, float ior = 1.5f);
uint32_t addMaterial(Scene& scene, MaterialKind kind, Vec3f baseColor, float roughness);

// --- Shapes ---

/// A parallelogram about `center` with half-edges u and v; its front is on the side of u × v. Carries uvs in [0,1]².
void addQuad(Scene& scene, Vec3f center, Vec3f u, Vec3f v, uint32_t material);
/// Horizontal square of the given half-width about (x, y, z); its front looks up, or down.
void addHorizontalSquare(Scene& scene, Vec3f center, float halfWidth, uint32_t material, bool facesUp = true);
/// A regular polygon of 256 corners that faces down, with the area of a disk of the given radius.
void addDiskFacingDown(Scene& scene, Vec3f center, float radius, uint32_t material);
/// An icosahedron subdivided `levels` times, corners on the sphere. `smooth`: with the sphere's normals, else flat.
/// `inward`: its front is the inside.
void addGeodesicSphere(Scene& scene, Vec3f center, float radius, uint32_t levels, bool smooth, bool inward,
                       uint32_t material);

// --- Lights and camera ---

void addPointLight(Scene& scene, Vec3f position, Vec3f intensity);
void setConstantSky(Scene& scene, Vec3f radiance);
/// Perspective camera, square images cover `fov` radians both ways.
Camera lookAt(Vec3f position, Vec3f target, Vec3f up, double fov);
/// A camera at (x, y, height) above the plane z = 0 that looks down on a square of the given half-width.
Camera lookDownOn(double x, double y, double height, double halfWidth);

}  // namespace antipode::test
