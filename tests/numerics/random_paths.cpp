#include "random_paths.h"

#include <cmath>
#include <optional>

namespace antipode {
namespace {

using namespace reference;

Vec3d randomDirection(Random& random) {
    const double z = random.uniform(-1, 1), r = std::sqrt(1 - z * z), phi = 2 * kPi * random.uniform();
    return {r * std::cos(phi), r * std::sin(phi), z};
}

Material randomMaterial(bool specular, Random& random) {
    Material m;
    const auto colour = [&] { return Vec3f(float(random.uniform(0.05, 0.95))); };
    m.baseColor = colour();
    m.specular = colour();
    m.phongExponent = float(std::pow(10, random.uniform(0, 2)));
    m.roughness = float(random.uniform(0.3, 1));
    m.ior = float(random.uniform(1.05, 2));
    m.twoSided = random.uniform() < 0.5;
    static constexpr MaterialKind kRough[] = {MaterialKind::Lambert, MaterialKind::Phong, MaterialKind::RoughConductor,
                                              MaterialKind::RoughDielectric};
    if (specular) {
        m.kind = random.uniform() < 0.4 ? MaterialKind::Mirror : MaterialKind::Dielectric;
        m.twoSided = true;
    } else {
        m.kind = kRough[random.index(4)];
    }
    return m;
}

/// The normal with which a smooth interface of index `ior` refracts between `outside` and `inside`; empty where none
/// does.
std::optional<Vec3d> refractingNormal(const Vec3d& outside, const Vec3d& inside, double ior) {
    const Vec3d n = -normalize(outside + inside * ior);
    if (dot(n, outside) <= 0.01 || dot(n, inside) >= -0.01) return {};
    return n;
}

Vec3d specularNormal(const Material& material, const Vec3d& a, const Vec3d& b, Random& random) {
    if (material.kind == MaterialKind::Dielectric && random.uniform() < 0.7) {
        if (const auto n =
                random.uniform() < 0.5 ? refractingNormal(a, b, material.ior) : refractingNormal(b, a, material.ior))
            return *n;
    }
    return normalize(a + b) * (random.uniform() < 0.5 ? 1.0 : -1.0);
}

/// Does light scatter between both directions, both ways, without a pdf too small to be a test of anything?
bool scatters(const Material& material, const Vec3d& normal, const Vec3d& a, const Vec3d& b) {
    const Frame frame(normal);
    const Vec3d al = frame.toLocal(a), bl = frame.toLocal(b);
    if (std::abs(al.z) < 1e-3 || std::abs(bl.z) < 1e-3) return false;
    return pdfBsdf(material, al, bl) > 1e-6 && pdfBsdf(material, bl, al) > 1e-6;
}

SurfaceVertex randomVertex(const Vec3d& position, const Vec3d& towardsLight, const Vec3d& towardsCamera,
                           double specularProbability, Random& random) {
    SurfaceVertex vertex{position, {}, {}};
    if (random.uniform() < specularProbability) {
        vertex.material = randomMaterial(true, random);
        vertex.normal = specularNormal(vertex.material, towardsLight, towardsCamera, random);
        return vertex;
    }
    do {
        vertex.material = randomMaterial(false, random);
        vertex.normal = randomDirection(random);
    } while (!scatters(vertex.material, vertex.normal, towardsLight, towardsCamera));
    return vertex;
}

/// Media that thin out light by a few times, some in one channel more than in others.
std::vector<Vec3d> randomExtinction(const FullPath& path, const std::vector<Vec3d>& positions, Random& random) {
    std::vector<Vec3d> extinction;
    for (size_t edge = 0; edge < path.edges(); ++edge) {
        const bool needed = (edge > 0 && path.surface[edge - 1].inMedium()) ||
                            (edge < path.surface.size() && path.surface[edge].inMedium());
        const double scale = needed || random.uniform() < 0.3 ? 3 / length(positions[edge + 1] - positions[edge]) : 0;
        extinction.push_back(Vec3d(random.uniform(), random.uniform(), random.uniform()) * scale);
    }
    if (path.light.isInfinite()) extinction[0] = Vec3d(0.0);
    return extinction;
}

/// A light of a random kind that starts the path at `position` in `direction`.
void placeLight(FullPath& path, const Vec3d& position, const Vec3d& direction, bool direct, Random& random) {
    Light& light = path.light;
    do {
        light.kind = LightKind(random.index(6));
    } while (direct && light.isDelta());  // a delta light cannot be seen directly
    light.emission = Vec3d(1.0);
    light.twoSided = random.uniform() < 0.5;
    light.position = position;
    light.direction = direction;
    light.cosOuter = 0.5;
    light.sceneRadius = std::pow(10, random.uniform(-1, 2));
    path.pickProbability = random.uniform(0.01, 1);
    path.lightPoint = {position, {}, direction};

    Vec3d normal;
    do {
        normal = randomDirection(random);
    } while (std::abs(dot(normal, direction)) < 1e-3);
    if (!light.twoSided && dot(normal, direction) < 0) normal = -normal;
    path.lightPoint.normal = normal;
    const double size = std::pow(10, random.uniform(-3, 0));
    const Frame frame(normal);
    light.triangle = {position, position + frame.tangent * size, position + frame.bitangent * size, 0};
    light.sphere = {position - normal * size, size, 0};
}

}  // namespace

FullPath randomPath(const RandomPathOptions& options, Random& random) {
    // From the camera, which stands in the origin, because a scene's camera position is in single precision.
    std::vector<Vec3d> positions(options.edges + 1);
    const double scale = std::pow(10, random.uniform(-options.logScaleRange, options.logScaleRange));
    for (uint32_t i = options.edges; i-- > 0;)
        positions[i] = positions[i + 1] + randomDirection(random) * (scale * std::pow(10, random.uniform(-1, 1)));
    const Vec3d view = normalize(positions[options.edges - 1]);
    Camera camera;
    camera.forward = Vec3f(normalize(view + randomDirection(random) * 0.3));
    camera.up = Vec3f(normalize(cross(Vec3d(camera.forward), randomDirection(random))));

    FullPath path{.light = {}, .lightPoint = {}, .surface = {}, .camera = PinholeCamera(camera, 640, 480)};
    placeLight(path, positions[0], normalize(positions[1] - positions[0]), options.edges == 1, random);
    for (uint32_t i = 1; i < options.edges; ++i) {
        if (options.mediumProbability > 0 && random.uniform() < options.mediumProbability &&
            (i > 1 || !path.light.isInfinite()))
            path.surface.push_back({positions[i], {0, 0, 1}, {}, random.uniform(-0.9, 0.9)});
        else
            path.surface.push_back(randomVertex(positions[i], normalize(positions[i - 1] - positions[i]),
                                                normalize(positions[i + 1] - positions[i]), options.specularProbability,
                                                random));
    }
    if (options.mediumProbability > 0) path.extinction = randomExtinction(path, positions, random);
    return path;
}

}  // namespace antipode
