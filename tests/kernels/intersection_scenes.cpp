#include "tests/kernels/intersection_scenes.h"

#include <cmath>
#include <map>
#include <numbers>

namespace antipode {

Scene emptyScene() {
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.emplace_back();
    return scene;
}

void addTriangle(Scene& scene, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
    Mesh& mesh = scene.meshes.front();
    const auto first = uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
}

Vec3d randomDirection(Random& random) {
    const double z = random.uniform(-1, 1), phi = random.uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
}

namespace {

Vec3d inCube(Random& random) { return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; }

/// Index of the vertex half-way along an edge, made when first asked for.
uint32_t middle(Mesh& mesh, std::map<std::pair<uint32_t, uint32_t>, uint32_t>& known, uint32_t a, uint32_t b) {
    const auto [at, isNew] = known.try_emplace(std::minmax(a, b), uint32_t(mesh.positions.size()));
    if (isNew) mesh.positions.push_back(normalize(mesh.positions[a] + mesh.positions[b]));
    return at->second;
}

}  // namespace

Scene randomSoup(uint32_t triangles, uint32_t spheres, Random& random) {
    Scene scene = emptyScene();
    const auto size = [&] { return std::pow(10.0, random.uniform(-3, 0)); };
    for (uint32_t i = 0; i < triangles; ++i) {
        const Vec3d center = inCube(random);
        const double s = size();
        addTriangle(scene, Vec3f(center + inCube(random) * s), Vec3f(center + inCube(random) * s),
                    Vec3f(center + inCube(random) * s));
    }
    for (uint32_t i = 0; i < spheres; ++i) scene.spheres.push_back({Vec3f(inCube(random)), float(0.3 * size()), 0});
    return scene;
}

Scene closedMesh(uint32_t levels, const Vec3f& center, float radius, float roughness, Random& random) {
    Scene scene = emptyScene();
    Mesh& mesh = scene.meshes.front();
    const float g = std::numbers::phi_v<float>;
    for (const Vec3f& p : {Vec3f{-1, g, 0},
                           {1, g, 0},
                           {-1, -g, 0},
                           {1, -g, 0},
                           {0, -1, g},
                           {0, 1, g},
                           {0, -1, -g},
                           {0, 1, -g},
                           {g, 0, -1},
                           {g, 0, 1},
                           {-g, 0, -1},
                           {-g, 0, 1}})
        mesh.positions.push_back(normalize(p));
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (uint32_t level = 0; level < levels; ++level) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> known;
        std::vector<std::array<uint32_t, 3>> finer;
        for (const auto& [a, b, c] : mesh.triangles) {
            const uint32_t ab = middle(mesh, known, a, b), bc = middle(mesh, known, b, c),
                           ca = middle(mesh, known, c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        mesh.triangles = finer;
    }
    for (Vec3f& p : mesh.positions) p = center + p * (radius * float(random.uniform(1 - roughness, 1)));
    return scene;
}

Scene scaled(Scene scene, float factor) {
    for (Mesh& mesh : scene.meshes)
        for (Vec3f& p : mesh.positions) p *= factor;
    for (Sphere& s : scene.spheres) s = {s.center * factor, s.radius * factor, s.material};
    return scene;
}

Scene moved(Scene scene, const Vec3f& offset) {
    for (Mesh& mesh : scene.meshes)
        for (Vec3f& p : mesh.positions) p += offset;
    for (Sphere& s : scene.spheres) s.center += offset;
    return scene;
}

}  // namespace antipode
