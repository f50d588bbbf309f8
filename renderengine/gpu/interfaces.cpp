#include "gpu/interfaces.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <tuple>

#include "gpu/body_contact.h"
#include "gpu/pack_materials.h"
#include "renderengine/error.h"
#include "scene/bounds.h"
#include "scene/mesh_fronts.h"

namespace antipode {
namespace {

using namespace shared;

struct Body {
    BodySurface surface;
    size_t index;  ///< of its mesh or sphere
    const Material* material;
    Bounds3d bounds;
    bool closed;
    uint32_t depth = 0;    ///< how many other bodies' bounds hold its own
    bool isolated = true;  ///< its bounds meet no other's
};

/// What a unit of length absorbs, per channel: Beer's law leaves attenuationColor after attenuationDistance.
Vec3f absorptionOf(const Material& m) {
    if (!m.attenuationDistance) return Vec3f(0.0f);
    const auto channel = [&](float left) {
        return -std::log(std::max(left, std::numeric_limits<float>::min())) / *m.attenuationDistance;
    };
    return {channel(m.attenuationColor.x), channel(m.attenuationColor.y), channel(m.attenuationColor.z)};
}

/// What a body is filled with.
struct Filling {
    float ior, spread;
    Vec3f extinction, scattering;  ///< per length
    float anisotropy;

    auto key() const {
        return std::tuple(ior, spread, extinction.x, extinction.y, extinction.z, scattering.x, scattering.y,
                          scattering.z, anisotropy);
    }
};

Filling fillingOf(const Material& m) {
    Vec3f scattering(0.0f);
    if (m.scattersInside()) scattering = m.scatteringColor * (1.0f / *m.scatteringDistance);
    return {m.ior, indexSpread(m), absorptionOf(m) + scattering, scattering,
            m.scattersInside() ? m.scatteringAnisotropy : 0.0f};
}

uvec4 texel(const Vec3f& v, float w) {
    return {std::bit_cast<uint>(v.x), std::bit_cast<uint>(v.y), std::bit_cast<uint>(v.z), std::bit_cast<uint>(w)};
}

std::vector<Body> bodiesOf(const Scene& scene) {
    std::vector<Body> bodies;
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        const Material& m = scene.materials[mesh.material];
        if (isTransparent(m) && !isHole(m) && !mesh.triangles.empty())
            bodies.push_back({&mesh, i, &m, boundsOf(mesh), isClosed(mesh)});
    }
    for (size_t i = 0; i < scene.spheres.size(); ++i) {
        const Material& m = scene.materials[scene.spheres[i].material];
        if (isTransparent(m) && !isHole(m))
            bodies.push_back({&scene.spheres[i], i, &m, boundsOf(scene.spheres[i]), true});
    }
    return bodies;
}

bool holds(const Bounds3d& outer, const Bounds3d& inner) {
    for (int axis = 0; axis < 3; ++axis)
        if (inner.lower[axis] < outer.lower[axis] || inner.upper[axis] > outer.upper[axis]) return false;
    return outer.lower != inner.lower || outer.upper != inner.upper;
}

/// Whether two closed bodies meet; finds depths and what is isolated on the way.
bool relate(std::vector<Body>& bodies) {
    std::vector<size_t> byX(bodies.size());
    std::iota(byX.begin(), byX.end(), size_t(0));
    std::ranges::sort(byX, {}, [&](size_t i) { return bodies[i].bounds.lower.x; });
    bool found = false;
    for (size_t i = 0; i < byX.size(); ++i) {
        Body& a = bodies[byX[i]];
        for (size_t j = i + 1; j < byX.size(); ++j) {
            Body& b = bodies[byX[j]];
            const double slack = contactSlack(a.bounds, b.bounds);
            if (b.bounds.lower.x > a.bounds.upper.x + 0x1p-15 * a.bounds.radius() &&
                slack <= 0x1p-15 * a.bounds.radius())
                break;
            if (!boxesMeet(a.bounds, b.bounds, slack)) continue;
            a.isolated = b.isolated = false;
            if (holds(a.bounds, b.bounds)) ++b.depth;
            if (holds(b.bounds, a.bounds)) ++a.depth;
            found = found || (a.closed && b.closed && bodiesMeet(a.surface, b.surface));
        }
    }
    return found;
}

bool touchesOpaque(const Scene& scene, const std::vector<Body>& bodies) {
    for (const Body& body : bodies) {
        const auto* mesh = std::get_if<const Mesh*>(&body.surface);
        if (mesh == nullptr || !body.closed) continue;
        for (const Mesh& other : scene.meshes)
            if (!isTransparent(scene.materials[other.material]) && sharesPlane(**mesh, other)) return true;
    }
    return false;
}

/// Twice what the kernels' test of a point's side may err by (lib/traversal.glsl), for the largest face: nothing where
/// all faces are parallel to the axes, since it is exact there.
float roomOf(const std::vector<Body>& bodies) {
    constexpr float unitRoundoff = 0x1p-24f;
    float room = 0;
    for (const Body& body : bodies) {
        const auto* mesh = std::get_if<const Mesh*>(&body.surface);
        if (mesh == nullptr) continue;
        for (const auto& t : (*mesh)->triangles) {
            Bounds3f box;
            float magnitude = 0;
            for (uint32_t i : t) {
                const Vec3f& p = (*mesh)->positions[i];
                box.add(p);
                magnitude = std::max({magnitude, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
            }
            const Vec3f size = box.size();
            if (std::min({size.x, size.y, size.z}) > 0.0f)
                room = std::max(room, unitRoundoff * (16.0f * std::max({size.x, size.y, size.z}) + 8.0f * magnitude));
        }
    }
    return room;
}

/// Indices of the media, by index of refraction and its spread.
class Media {
public:
    struct Index {
        float ior, spread;
        auto operator<=>(const Index&) const = default;
    };

    uint32_t indexOf(const Index& medium) {
        const auto [at, added] = index_.try_emplace(medium, uint32_t(media_.size()));
        if (added) media_.push_back(medium);
        if (media_.size() > GREATEST_MEDIUM)
            throw Error(ErrorCode::Input, "transparent bodies touch, and the scene has more than " +
                                              std::to_string(GREATEST_MEDIUM) +
                                              " indices of refraction; let some of them be equal");
        return at->second;
    }
    const std::vector<Index>& media() const { return media_; }

private:
    std::map<Index, uint32_t> index_{{{1.0f, 0.0f}, 0}};
    std::vector<Index> media_{{1.0f, 0.0f}};
};

}  // namespace

bool isTransparent(const Material& m) { return m.transmits() && !m.thin; }

Interfaces findInterfaces(const Scene& scene) {
    std::vector<Body> bodies = bodiesOf(scene);
    const bool meet = relate(bodies);
    const bool absorbs =
        std::ranges::any_of(bodies, [](const Body& b) { return maxComponent(absorptionOf(*b.material)) > 0; });
    const bool scatters = std::ranges::any_of(bodies, [](const Body& b) { return b.material->scattersInside(); });
    if (!meet && !absorbs && !scatters && !touchesOpaque(scene, bodies)) return {};

    std::vector<size_t> order(bodies.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::ranges::stable_sort(order, {}, [&](size_t i) {
        return std::tuple(!bodies[i].isolated, bodies[i].material->priority, bodies[i].depth);
    });

    Interfaces found{.meshRanks = std::vector<uint32_t>(scene.meshes.size()),
                     .sphereRanks = std::vector<uint32_t>(scene.spheres.size()),
                     .bodies = {{std::bit_cast<uint>(1.0f), 0, 0, std::bit_cast<uint>(roomOf(bodies))}}};
    Media media;
    std::vector<Filling> fillings{{1, 0, Vec3f(0.0f), Vec3f(0.0f), 0}};
    std::map<decltype(std::tuple(false, fillings[0].key())), uint32_t> shared;  // ranks of isolated bodies
    for (size_t i : order) {
        const Body& body = bodies[i];
        const Filling filling = fillingOf(*body.material);
        uint32_t rank = uint32_t(found.bodies.size());
        if (body.isolated) rank = shared.try_emplace({body.closed, filling.key()}, rank).first->second;
        if (rank == found.bodies.size()) {
            found.bodies.push_back({std::bit_cast<uint>(filling.ior), media.indexOf({filling.ior, filling.spread}), 0,
                                    body.closed ? 1u : 0u});
            fillings.push_back(filling);
        }
        if (rank > GREATEST_RANK)
            throw Error(ErrorCode::Input,
                        "more than " + std::to_string(GREATEST_RANK) +
                            " transparent bodies may touch; join those of one material into one mesh");
        (std::holds_alternative<const Mesh*>(body.surface) ? found.meshRanks : found.sphereRanks)[body.index] = rank;
    }
    const std::vector<Media::Index>& all = media.media();
    for (size_t i = 0; i < all.size(); ++i) found.bodies[i].z = std::bit_cast<uint>(all[i].ior);
    found.absorbs = absorbs;
    found.scatters = scatters;
    if (absorbs || scatters || std::ranges::any_of(all, [](const Media::Index& m) { return m.spread > 0; }))
        for (size_t i = 0; i < fillings.size(); ++i)
            found.bodies.push_back(texel(fillings[i].extinction, i < all.size() ? all[i].spread : 0));
    if (scatters)
        for (const Filling& f : fillings) found.bodies.push_back(texel(f.scattering, f.anisotropy));
    return found;
}

}  // namespace antipode
