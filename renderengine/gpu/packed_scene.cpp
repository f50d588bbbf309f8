#include "gpu/packed_scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>

#include "gpu/interfaces.h"
#include "gpu/layer_tables.h"
#include "gpu/loss_tables.h"
#include "gpu/more_attributes.h"
#include "gpu/pack_lights.h"
#include "gpu/pack_materials.h"
#include "scene/mesh_fronts.h"

namespace antipode {
namespace {

using namespace shared;

uint bits(float value) { return std::bit_cast<uint>(value); }
uvec4 texel(const Vec3f& v, uint w) { return {bits(v.x), bits(v.y), bits(v.z), w}; }

struct TriangleReference {
    uint32_t mesh, triangle;
};

Bounds3f boundsOf(const Sphere& s) { return {s.center - Vec3f(s.radius), s.center + Vec3f(s.radius)}; }

/// Normals and uvs of one triangle: 15 floats in 4 texels.
void packAttributes(const Mesh& mesh, const std::array<uint32_t, 3>& t, PackedScene& packed) {
    std::array<float, 16> a{};
    for (size_t k = 0; k < 3; ++k) {
        if (!mesh.normals.empty()) {
            const Vec3f& n = mesh.normals[t[k]];
            a[3 * k] = n.x, a[3 * k + 1] = n.y, a[3 * k + 2] = n.z;
        }
        if (!mesh.uvs.empty()) a[9 + 2 * k] = mesh.uvs[t[k]][0], a[10 + 2 * k] = mesh.uvs[t[k]][1];
    }
    for (size_t i = 0; i < 16; i += 4)
        packed.attributes.push_back({bits(a[i]), bits(a[i + 1]), bits(a[i + 2]), bits(a[i + 3])});
}

}  // namespace

/// Room for the rounding of the kernels' triangle test, so that a ray which meets a triangle within rounding of its
/// edge also meets its box. The test errs by at most 5 units of the vertices' distance from the ray, which is at most
/// the box's size, and of the coordinates' distance from the ray's origin, which the traversal's widened far distances
/// cover. Along an axis on which the triangle is flat the test errs by nothing: room there would only push away the
/// rays that leave a floor, by more than the size of small things on it. Rounded outwards: a flat box always gets some
/// thickness, and axis-parallel rays meet its upper border as they do its lower one.
Bounds3f padded(const Bounds3f& b) {
    constexpr float unitRoundoff = 0x1p-24f, infinity = std::numeric_limits<float>::infinity();
    const Vec3f size = b.size();
    const float room = 8.0f * unitRoundoff * std::max({size.x, size.y, size.z});
    Bounds3f box;
    for (int axis = 0; axis < 3; ++axis) {
        const float pad = size[axis] > 0.0f ? room : 0.0f;
        box.lower[axis] = std::nextafter(b.lower[axis] - pad, -infinity);
        box.upper[axis] = std::nextafter(b.upper[axis] + pad, infinity);
    }
    return box;
}

Bounds3f tracedBounds(const Scene& scene) {
    Bounds3f bounds;
    for (const Mesh& mesh : scene.meshes)
        for (const auto& t : mesh.triangles)
            for (uint32_t i : t) bounds.add(mesh.positions[i]);
    for (const Sphere& s : scene.spheres) bounds.add(boundsOf(s));
    return bounds;
}

PackedScene packScene(const Scene& scene, const SetUpStep& step) {
    step("packing materials and textures");
    PackedScene packed;
    packed.bounds = tracedBounds(scene);
    packMaterials(scene, packed);
    constexpr uint layers = LOBE_CLEARCOAT | LOBE_SHEEN;
    if (packed.lobes & (LOBE_MULTIPLE_SCATTERING | LOBE_ROUGH_DIELECTRIC | layers))
        packed.losses = packLosses((packed.lobes & LOBE_ROUGH_DIELECTRIC) != 0);
    if (packed.lobes & layers) std::ranges::copy(packLayerAlbedos(), std::back_inserter(packed.losses));

    step("finding transparent bodies that touch");
    Interfaces interfaces = findInterfaces(scene);
    if (interfaces.present()) packed.features |= FEATURE_INTERFACES, packed.lobes |= LOBE_DIELECTRIC;
    if (interfaces.absorbs) packed.features |= FEATURE_ABSORPTION;
    if (interfaces.scatters) packed.features |= FEATURE_SCATTERING;
    packed.bodies = std::move(interfaces.bodies);
    const auto kindAndRank = [&](uint kind, const std::vector<uint32_t>& ranks, size_t i) {
        return packed.bodies.empty() ? kind : kind | (ranks[i] << PRIMITIVE_RANK_SHIFT);
    };

    step("building the hierarchy of bounds");
    std::vector<TriangleReference> triangles;
    std::vector<uint32_t> spheres;
    std::vector<Bounds3f> triangleBoxes, sphereBoxes;
    const MoreAttributes more(scene);
    bool attributes = (packed.features & FEATURE_ATTRIBUTES) != 0 || more.texels() > 0;
    for (uint32_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        if (isHole(scene.materials[mesh.material])) continue;
        attributes = attributes || !mesh.normals.empty();
        for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            Bounds3f bounds;
            for (uint32_t i : mesh.triangles[t]) bounds.add(mesh.positions[i]);
            triangles.push_back({m, t});
            triangleBoxes.push_back(padded(bounds));
        }
    }
    for (uint32_t i = 0; i < scene.spheres.size(); ++i) {
        if (isHole(scene.materials[scene.spheres[i].material])) continue;
        spheres.push_back(i);
        sphereBoxes.push_back(boundsOf(scene.spheres[i]));
    }
    if (scene.camera.lensRadius > 0.0f) packed.features |= FEATURE_LENS;
    if (scene.camera.orthographicHeight > 0.0f) packed.features |= FEATURE_ORTHOGRAPHIC;
    packed.features |= more.features();
    packed.moreAttributeTexels = more.texels();
    if (!triangles.empty()) packed.features |= FEATURE_TRIANGLES;
    if (!spheres.empty()) packed.features |= FEATURE_SPHERES;
    if (attributes) packed.features |= FEATURE_ATTRIBUTES;

    packed.bvh = buildBvh(triangleBoxes, sphereBoxes);
    packed.primitives.reserve(packed.bvh.primitiveOrder.size() * 3);
    std::vector<EmitterPrimitive> emitters;
    for (uint32_t i = 0; i < packed.bvh.primitiveOrder.size(); ++i) {
        const uint32_t id = packed.bvh.primitiveOrder[i];
        if (id < triangles.size()) {
            const Mesh& mesh = scene.meshes[triangles[id].mesh];
            const auto t = frontByNormals(mesh, mesh.triangles[triangles[id].triangle]);
            const Vec3f &p0 = mesh.positions[t[0]], &p1 = mesh.positions[t[1]], &p2 = mesh.positions[t[2]];
            packed.primitives.push_back(texel(p0, mesh.material));
            packed.primitives.push_back(texel(p1, NO_INDEX));
            packed.primitives.push_back(
                texel(p2, kindAndRank(PRIMITIVE_TRIANGLE, interfaces.meshRanks, triangles[id].mesh)));
            if (attributes) packAttributes(mesh, t, packed);
            more.pack(mesh, t, packed.moreAttributes);
            const double area = 0.5 * length(cross(Vec3d(p1) - Vec3d(p0), Vec3d(p2) - Vec3d(p0)));
            if (scene.materials[mesh.material].emits() && area > 0.0)
                emitters.push_back({i, mesh.material, area, false, &mesh, t});
        } else {
            const uint32_t sphere = spheres[id - triangles.size()];
            const Sphere& s = scene.spheres[sphere];
            packed.primitives.push_back(texel(s.center, s.material));
            packed.primitives.push_back(texel(Vec3f(s.radius, 0, 0), NO_INDEX));
            packed.primitives.push_back(texel(Vec3f(), kindAndRank(PRIMITIVE_SPHERE, interfaces.sphereRanks, sphere)));
            if (attributes) packed.attributes.resize(packed.attributes.size() + 4);
            more.packSphere(packed.moreAttributes);
            const double area = 4.0 * 3.14159265358979323846 * double(s.radius) * double(s.radius);
            if (scene.materials[s.material].emits()) emitters.push_back({i, s.material, area, true});
        }
    }
    packLights(scene, emitters, step, packed);
    return packed;
}

}  // namespace antipode
