#include "tests/techniques/scenes.h"

#include <map>
#include <numbers>
#include <utility>

namespace antipode::test {

uint32_t addMaterial(Scene& scene, MaterialKind kind, Vec3f baseColor, float roughness) {
    Material m;
    m.kind = kind;
    m.baseColor = baseColor;
    m.roughness = roughness;
    scene.materials.push_back(m);
    return uint32_t(scene.materials.size() - 1);
}

uint32_t addLambert(Scene& scene, Vec3f reflectance) {
    return addMaterial(scene, MaterialKind::Lambert, reflectance, 1);
}

uint32_t addLamp(Scene& scene, Vec3f radiance, bool twoSided) {
    const uint32_t index = addLambert(scene, Vec3f(0.0f));
    scene.materials[index].emission = radiance;
    scene.materials[index].twoSided = twoSided;
    scene.materials[index].emitsBothSides = twoSided;
    return index;
}

uint32_t addMirror(Scene& scene, float reflectance, float emission) {
    const uint32_t index = addMaterial(scene, MaterialKind::Mirror, Vec3f(0.0f), 0);
    scene.materials[index].specular = Vec3f(reflectance);
    scene.materials[index].emission = Vec3f(emission);
    return index;
}

uint32_t addGlass(Scene& scene, float ior) {
    const uint32_t index = addMaterial(scene, MaterialKind::Dielectric, Vec3f(1.0f), 0);
    scene.materials[index].ior = ior;
    return index;
}

void addQuad(Scene& scene, Vec3f center, Vec3f u, Vec3f v, uint32_t material) {
    Mesh mesh;
    mesh.positions = {center - u - v, center + u - v, center + u + v, center - u + v};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.material = material;
    scene.meshes.push_back(mesh);
}

void addHorizontalSquare(Scene& scene, Vec3f center, float halfWidth, uint32_t material, bool facesUp) {
    const Vec3f x{halfWidth, 0, 0}, y{0, halfWidth, 0};
    facesUp ? addQuad(scene, center, x, y, material) : addQuad(scene, center, y, x, material);
}

void addDiskFacingDown(Scene& scene, Vec3f center, float radius, uint32_t material) {
    constexpr uint32_t corners = 256;
    constexpr double step = 2 * std::numbers::pi / corners;
    const double outer = double(radius) * std::sqrt(step / std::sin(step));
    Mesh mesh;
    mesh.positions.push_back(center);
    for (uint32_t i = 0; i < corners; ++i) {
        mesh.positions.push_back(center + Vec3f(Vec3d(outer * std::cos(i * step), outer * std::sin(i * step), 0)));
        mesh.triangles.push_back({0, 1 + (i + 1) % corners, 1 + i});
    }
    mesh.material = material;
    scene.meshes.push_back(mesh);
}

void addGeodesicSphere(Scene& scene, Vec3f center, float radius, uint32_t levels, bool smooth, bool inward,
                       uint32_t material) {
    constexpr float g = std::numbers::phi_v<float>;
    std::vector<Vec3f> corners{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                               {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (Vec3f& c : corners) c = normalize(c);
    std::vector<std::array<uint32_t, 3>> faces{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                               {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                               {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                               {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (uint32_t level = 0; level < levels; ++level) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
        const auto middle = [&](uint32_t a, uint32_t b) {
            const auto [at, isNew] = middles.try_emplace(std::minmax(a, b), uint32_t(corners.size()));
            if (isNew) corners.push_back(normalize(corners[a] + corners[b]));
            return at->second;
        };
        std::vector<std::array<uint32_t, 3>> finer;
        for (const auto& [a, b, c] : faces) {
            const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        faces = std::move(finer);
    }
    Mesh mesh;
    for (const Vec3f& c : corners) {
        mesh.positions.push_back(center + c * radius);
        if (smooth) mesh.normals.push_back(inward ? -c : c);
    }
    for (const auto& [a, b, c] : faces) mesh.triangles.push_back(inward ? std::array{a, c, b} : std::array{a, b, c});
    mesh.material = material;
    scene.meshes.push_back(mesh);
}

void addPointLight(Scene& scene, Vec3f position, Vec3f intensity) {
    scene.pointLights.push_back({position, intensity});
}

void setConstantSky(Scene& scene, Vec3f radiance) {
    scene.environment.emplace();
    scene.environment->radiance = radiance;
}

Camera lookAt(Vec3f position, Vec3f target, Vec3f up, double fov) {
    Camera camera;
    camera.position = position;
    camera.forward = normalize(target - position);
    camera.up = up;
    camera.verticalFov = float(fov);
    return camera;
}

Camera lookDownOn(double x, double y, double height, double halfWidth) {
    return lookAt(Vec3f(Vec3d(x, y, height)), Vec3f(Vec3d(x, y, 0)), {0, 1, 0}, 2 * std::atan(halfWidth / height));
}

}  // namespace antipode::test
