#include "scene/light_pilot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "scene/defaults.h"

namespace antipode {
namespace {

constexpr size_t kPoints = 512, kEmitters = 256;

struct SurfacePoint {
    Vec3d position, normal;
    Vec3d emission;      ///< radiance
    double reflectance;  ///< of the base colour, the greatest channel
    bool emitsBothSides = false;
};

double decodeSrgb(uint8_t encoded) {
    const double v = encoded / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// The texel at `uv`, repeated; nothing where there is none. Nearest texels do for an estimate.
const uint8_t* texelAt(const Texture& texture, const std::array<double, 2>& uv) {
    if (!std::isfinite(uv[0]) || !std::isfinite(uv[1]) || texture.rgba.empty()) return nullptr;
    const auto index = [](double at, uint32_t size) {
        return std::min(uint32_t((at - std::floor(at)) * size), size - 1);
    };
    return &texture.rgba[4 * (size_t(index(uv[1], texture.height)) * texture.width + index(uv[0], texture.width))];
}

/// Triangles of one kind, drawn by area: evenly spaced in the sum of areas, so that no random number is needed.
class AreaSamples {
public:
    explicit AreaSamples(const Scene& scene) : scene_(scene) {}

    void add(const Mesh& mesh) {
        const Material& material = scene_.materials[mesh.material];
        for (const auto& t : mesh.triangles) {
            const Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
            const Vec3d n = cross(b - a, c - a);
            const double area = length(n) / 2;
            if (!(area > 0) || !std::isfinite(area)) continue;
            add(area, {a, b - a, c - a, normalize(n), &material, &mesh, &t});
        }
    }
    void add(const Sphere& sphere) {
        // The six ends of its axes stand for it.
        const Material& material = scene_.materials[sphere.material];
        const double area = 4 * std::numbers::pi * double(sphere.radius) * double(sphere.radius) / 6;
        for (int i = 0; i < 6; ++i) {
            Vec3d n;
            n[i / 2] = i % 2 ? 1 : -1;
            add(area, {Vec3d(sphere.center) + n * double(sphere.radius), {}, {}, n, &material, nullptr, nullptr});
        }
    }
    double area() const { return total_; }

    /// Fewer than `count` where some fall into holes.
    std::vector<SurfacePoint> draw(size_t count) const {
        std::vector<SurfacePoint> points;
        for (size_t i = 0; i < count && total_ > 0; ++i) {
            const double at = total_ * (double(i) + 0.5) / double(count);
            const auto found = std::upper_bound(sums_.begin(), sums_.end(), at);
            const Piece& piece = pieces_[std::min(size_t(found - sums_.begin()), pieces_.size() - 1)];
            // The R2 sequence (Roberts 2018), folded into the triangle.
            double u = std::fmod(0.5 + 0.7548776662466927 * double(i), 1.0);
            double v = std::fmod(0.5 + 0.5698402909980532 * double(i), 1.0);
            if (u + v > 1) u = 1 - u, v = 1 - v;
            if (isHole(piece, u, v)) continue;
            points.push_back({piece.corner + piece.edge1 * u + piece.edge2 * v, piece.normal, emission(piece, u, v),
                              reflectance(piece, u, v), piece.material->emitsBothSides});
        }
        return points;
    }

private:
    struct Piece {
        Vec3d corner, edge1, edge2, normal;
        const Material* material;
        const Mesh* mesh;                         ///< null for spheres
        const std::array<uint32_t, 3>* triangle;  ///< of the mesh
    };

    void add(double area, const Piece& piece) {
        total_ += area;
        sums_.push_back(total_);
        pieces_.push_back(piece);
    }

    /// Nothing where the piece has no such texture.
    const uint8_t* texel(const Piece& piece, const TextureIndex& index, double u, double v) const {
        if (!index || !piece.mesh) return nullptr;
        const Texture& texture = scene_.textures[*index];
        const Mesh& mesh = *piece.mesh;
        const size_t count = mesh.positions.size();
        const bool more = texture.uvSet > 0 && texture.uvSet * count <= mesh.moreUvs.size();
        const auto& uvs = more ? mesh.moreUvs : mesh.uvs;
        if (uvs.empty()) return nullptr;
        const size_t begin = more ? (texture.uvSet - 1) * count : 0;
        std::array<double, 2> at{};
        const double weights[3] = {1 - u - v, u, v};
        for (size_t corner = 0; corner < 3; ++corner)
            for (size_t axis = 0; axis < 2; ++axis)
                at[axis] += weights[corner] * double(uvs[begin + (*piece.triangle)[corner]][axis]);
        return texelAt(texture, at);
    }

    bool isHole(const Piece& piece, double u, double v) const {
        if (piece.material->coverage == 0.0f) return true;
        if (!piece.material->alphaCutoff) return false;
        const uint8_t* found = texel(piece, piece.material->baseColorTexture, u, v);
        return (found ? found[3] / 255.0f : 1.0f) < *piece.material->alphaCutoff;
    }

    Vec3d color(const Vec3f& factor, const Piece& piece, const TextureIndex& texture, double u, double v) const {
        const uint8_t* found = texel(piece, texture, u, v);
        if (!found) return Vec3d(factor);
        return Vec3d(factor.x * decodeSrgb(found[0]), factor.y * decodeSrgb(found[1]), factor.z * decodeSrgb(found[2]));
    }

    Vec3d emission(const Piece& piece, double u, double v) const {
        return color(piece.material->emission, piece, piece.material->emissionTexture, u, v);
    }

    double reflectance(const Piece& piece, double u, double v) const {
        return maxComponent(color(piece.material->baseColor, piece, piece.material->baseColorTexture, u, v));
    }

    const Scene& scene_;
    std::vector<Piece> pieces_;
    std::vector<double> sums_;
    double total_ = 0;
};

bool isInView(const Camera& camera, double aspect, const Vec3d& point) {
    const Vec3d forward(camera.forward), right = normalize(cross(forward, Vec3d(camera.up))),
                                         up = cross(right, forward);
    const Vec3d d = point - Vec3d(camera.position);
    const double z = dot(d, forward), tangent = std::tan(camera.verticalFov / 2.0);
    return z > 0 && std::abs(dot(d, up)) <= z * tangent && std::abs(dot(d, right)) <= z * tangent * aspect;
}

}  // namespace

bool lightsTheView(const Scene& scene) {
    if (hasLamps(scene)) return true;  // what they light a camera's exposure can show
    AreaSamples surfaces(scene), emitters(scene);
    const auto add = [&](const auto& shape) {
        surfaces.add(shape);
        if (scene.materials[shape.material].emits()) emitters.add(shape);
    };
    for (const Mesh& mesh : scene.meshes) add(mesh);
    for (const Sphere& sphere : scene.spheres) add(sphere);
    if (!(emitters.area() > 0)) return false;

    const std::vector<SurfacePoint> lamps = emitters.draw(kEmitters);
    double brightest = 0;
    for (const SurfacePoint& lamp : lamps) brightest = std::max(brightest, maxComponent(lamp.emission));
    if (!(brightest > 0)) return false;
    const double worthMention = std::min(0.01, brightest / 100);
    const double aspect = double(scene.imageWidth) / scene.imageHeight;
    size_t seen = 0, showing = 0, lit = 0;
    for (const SurfacePoint& point : surfaces.draw(kPoints)) {
        if (!isInView(scene.camera, aspect, point.position)) continue;
        ++seen;
        const double shone = maxComponent(point.emission);
        if (shone >= worthMention && shone >= point.reflectance) {
            ++showing;
            continue;
        }
        double radiance = 0;  // of white, irradiance/π
        for (const SurfacePoint& lamp : lamps) {
            const Vec3d d = point.position - lamp.position;
            const double squared = dot(d, d);
            if (!(squared > 0)) continue;
            const double out = dot(lamp.normal, d), in = std::abs(dot(point.normal, d));
            const double cosines = (lamp.emitsBothSides ? std::abs(out) : std::max(out, 0.0)) * in / squared;
            radiance += maxComponent(lamp.emission) * cosines / squared * emitters.area() /
                        (std::numbers::pi * double(kEmitters));
        }
        lit += radiance >= worthMention;
    }
    return seen == showing || 4 * lit >= seen - showing;
}

}  // namespace antipode
