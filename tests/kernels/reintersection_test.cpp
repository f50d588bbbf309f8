// Rays that leave a surface by leaveSurface must not meet it, or its neighbours, again; what lies close by they must
// meet. On a convex body a ray that leaves outwards meets nothing at all, which leaves no room for excuses. Fixed
// seeds.
#include <cmath>
#include <numbers>

#include "support/hard_case.h"
#include "tests/kernels/tracer.h"

namespace antipode {
namespace {

class ReintersectionTest : public DeviceTest {
protected:
    struct Leaving {
        std::vector<TracedRay> rays;  ///< that leave the surface
        std::vector<Vec3d> normals;   ///< outward, exact
        size_t starts = 0;            ///< places that they leave from
    };

    /// A convex body that lies within `outer` of its centre, and around the points within `inner` of it.
    struct Body {
        Vec3d center;
        double outer, inner;
    };

    /// Aims rays at the body from outside and, where each meets it, leaves in `perHit` directions at cosines from
    /// `leastCosine` to 1 to the outward normal (`outwards`) or to the inward one. Normals are exact for triangles; a
    /// sphere's is the kernels', since far from the origin the point that they can represent is not where the ray met
    /// it.
    Leaving leavingRays(Tracer& tracer, const Body& body, size_t places, size_t perHit, bool outwards,
                        double leastCosine, Random& random) {
        std::vector<TracedRay> aimed;
        for (size_t i = 0; i < places; ++i) {
            const Vec3d from = body.center + randomDirection(random) * (3 * body.outer);
            const Vec3d to = body.center + randomDirection(random) * (body.inner * random.uniform());
            aimed.push_back({Vec3f(from), Vec3f(normalize(to - Vec3d(Vec3f(from))))});
        }
        const auto found = tracer.closest(aimed);
        const auto kernelNormals = tracer.normals(aimed, found);
        std::vector<TracedRay> rays;
        std::vector<TracedHit> hits;
        std::vector<Vec3f> directions;
        Leaving result;
        for (size_t i = 0; i < places; ++i) {
            if (!found[i].any()) continue;
            ++result.starts;
            const bool sphere = found[i].primitive >= tracer.scene().meshes.front().triangles.size();
            const Vec3d n =
                sphere ? normalize(Vec3d(kernelNormals[i])) : exactNormal(tracer.scene(), aimed[i], found[i]);
            for (size_t k = 0; k < perHit; ++k) {
                const double cosine = k % 2 ? std::pow(leastCosine, random.uniform()) : random.uniform(leastCosine, 1);
                const Vec3d tangent = normalize(cross(n, randomDirection(random)));
                const Vec3d direction = n * (outwards ? cosine : -cosine) + tangent * std::sqrt(1 - cosine * cosine);
                rays.push_back(aimed[i]);
                hits.push_back(found[i]);
                directions.push_back(Vec3f(direction));
                result.normals.push_back(n);
            }
        }
        result.rays = tracer.leave(rays, hits, directions);
        return result;
    }

    void expectNothingHit(const std::string& difficulty, Tracer& tracer, const Body& body, double leastCosine,
                          Random& random) {
        const size_t places = 300;
        const Leaving leaving = leavingRays(tracer, body, places, 1000, true, leastCosine, random);
        ASSERT_GT(leaving.starts, places / 4);
        const auto hits = tracer.closest(leaving.rays);
        size_t selfHits = 0, neighbours = 0;
        for (size_t i = 0; i < hits.size(); ++i)
            if (hits[i].any()) ++(hits[i].primitive == leaving.rays[i].startsOn ? selfHits : neighbours);
        expectNone(difficulty, "self-hits of 1000 rays from every hit", selfHits);
        expectNone(difficulty, "neighbours hit by 1000 rays from every hit", neighbours);
    }

    void expectNone(const std::string& difficulty, const std::string& quantity, size_t count) {
        expectWithin({"Intersection", difficulty, quantity, 0}, double(count), device->info().name);
    }

private:
    static Vec3d exactNormal(const Scene& scene, const TracedRay& ray, const TracedHit& hit) {
        const Mesh& mesh = scene.meshes.front();
        const auto& t = mesh.triangles[hit.primitive];
        const Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
        const Vec3d n = normalize(cross(b - a, c - a));
        return dot(n, Vec3d(ray.direction)) < 0 ? n : -n;
    }
};

/// Two cones of `sides` needles each about the z axis, from a ring of radius `ring` to (0, 0, ±1).
Scene spindle(uint32_t sides, float ring) {
    Scene scene = emptyScene();
    const auto at = [&](uint32_t i) {
        const double phi = 2 * std::numbers::pi * (i % sides) / sides;
        return Vec3f(float(ring * std::cos(phi)), float(ring * std::sin(phi)), 0);
    };
    for (uint32_t i = 0; i < sides; ++i) {
        addTriangle(scene, at(i), at(i + 1), {0, 0, 1});
        addTriangle(scene, at(i + 1), at(i), {0, 0, -1});
    }
    return scene;
}

TEST_F(ReintersectionTest, ConvexMeshesAtAllScales) {
    Random random(1);
    for (float scale : {1e-8f, 1.0f, 1e8f}) {
        SCOPED_TRACE(scale);
        Tracer tracer(*device, scaled(closedMesh(3, {0.5f, 0.25f, 2}, 1, 0, random), scale));
        expectNothingHit("convex meshes at coordinates of 10⁻⁸ to 10⁸", tracer,
                         {Vec3d{0.5, 0.25, 2} * double(scale), double(scale), 0.7 * double(scale)}, 1e-6, random);
    }
}

TEST_F(ReintersectionTest, ConvexMeshFarFromTheOrigin) {
    Random random(2);
    Tracer tracer(*device, closedMesh(2, {1e5f, -2e5f, 3e4f}, 300, 0, random));
    expectNothingHit("a convex mesh at a thousand times its size from the origin", tracer, {{1e5, -2e5, 3e4}, 300, 200},
                     1e-6, random);
}

TEST_F(ReintersectionTest, Needles) {
    Random random(3);
    for (float scale : {1e-8f, 1.0f, 1e8f})
        for (float ring : {1e-2f, 1e-4f}) {
            SCOPED_TRACE(testing::Message() << "ring " << ring << ", scale " << scale);
            Tracer tracer(*device, scaled(spindle(16, ring), scale));
            // A needle's normal is known as well as its width is: to 2⁻²³ over the angle at its tip.
            expectNothingHit("needles, at scales of 10⁻⁸ to 10⁸", tracer,
                             {{}, double(scale), 0.5 * double(ring * scale)}, 1e-6 / double(ring), random);
        }
}

TEST_F(ReintersectionTest, Spheres) {
    const std::string difficulty = "spheres of radius 10⁻⁸ to 2·10⁸, also far from the origin";
    Random random(4);
    struct Case {
        Vec3f center;
        float radius;
    };
    for (const Case& c : {Case{{0, 0, 0}, 1}, Case{{1, 2, 3}, 0.1f}, Case{{1e4f, -2e4f, 3e3f}, 1},
                          Case{{0, 5, 0}, 1e-3f}, Case{{1e-8f, 0, 2e-8f}, 1e-8f}, Case{{1e8f, 1e8f, 0}, 2e8f}}) {
        SCOPED_TRACE(testing::Message() << "radius " << c.radius << ", centre " << c.center.x);
        Scene scene = emptyScene();
        scene.spheres.push_back({c.center, c.radius, 0});
        Tracer tracer(*device, scene);
        const Body body{Vec3d(c.center), double(c.radius), 0.7 * double(c.radius)};
        expectNothingHit(difficulty, tracer, body, 1e-6, random);

        // Inwards the far side is met, at a distance of 2·r·cos; not the near one again.
        const Leaving inward = leavingRays(tracer, body, 100, 200, false, 1e-2, random);
        const auto hits = tracer.closest(inward.rays);
        size_t escapes = 0, selfHits = 0;
        for (size_t i = 0; i < hits.size(); ++i) {
            const double cosine = -dot(inward.normals[i], Vec3d(inward.rays[i].direction));
            escapes += !hits[i].any();
            selfHits += hits[i].any() && hits[i].t < cosine * double(c.radius);
        }
        expectNone(difficulty, "rays inwards that miss the far side", escapes);
        expectNone(difficulty, "rays inwards that meet the near side", selfHits);
    }
}

// A gap forty times the width that rounding needs: an absolute or a generous offset would jump over it.
TEST_F(ReintersectionTest, ConcentricShellsAreNotSkipped) {
    constexpr float gap = 4e-5f;
    Random random(5);
    for (const bool spheres : {true, false})
        for (const Vec3f& center : {Vec3f{0, 0, 0}, Vec3f{1, -2, 0.5f}}) {
            SCOPED_TRACE(testing::Message() << (spheres ? "spheres" : "meshes") << ", centre " << center.x);
            Scene scene = emptyScene();
            if (spheres) {
                scene.spheres = {{center, 1, 0}, {center, 1 + gap, 0}};
            } else {
                scene = closedMesh(2, {}, 1, 0, random);
                Mesh& mesh = scene.meshes.front();
                const auto outer = uint32_t(mesh.positions.size()), inner = uint32_t(mesh.triangles.size());
                for (uint32_t i = 0; i < outer; ++i) mesh.positions.push_back(mesh.positions[i] * (1 + gap));
                for (uint32_t i = 0; i < inner; ++i) {
                    const auto t = mesh.triangles[i];
                    mesh.triangles.push_back({t[0] + outer, t[1] + outer, t[2] + outer});
                }
                scene = moved(scene, center);
            }
            Tracer tracer(*device, scene);
            const auto innerPrimitives = uint32_t(spheres ? 1 : scene.meshes.front().triangles.size() / 2);
            // From within outwards: the inner shell, then the outer one.
            std::vector<TracedRay> aimed;
            for (int i = 0; i < 20000; ++i) aimed.push_back({center, Vec3f(randomDirection(random))});
            const auto first = tracer.closest(aimed);
            std::vector<Vec3f> onwards;
            for (const TracedRay& ray : aimed) onwards.push_back(ray.direction);
            const auto second = tracer.closest(tracer.leave(aimed, first, onwards));
            size_t wrongFirst = 0, skipped = 0;
            for (size_t i = 0; i < aimed.size(); ++i) {
                wrongFirst += first[i].primitive >= innerPrimitives;
                skipped += !second[i].any() || second[i].primitive < innerPrimitives || second[i].t > 2 * gap;
            }
            EXPECT_EQ(wrongFirst, 0u);
            expectNone("concentric shells with a gap of 4·10⁻⁵", "rays that skip the outer shell", skipped);
        }
}

}  // namespace
}  // namespace antipode
