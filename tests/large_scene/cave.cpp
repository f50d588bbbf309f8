#include "tests/large_scene/cave.h"

#include <bit>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

#include "renderengine/io/files.h"

namespace antipode::test {
namespace {

/// Uniform in [-1, 1], from integer arithmetic alone (Steele, Lea, Flood, "Fast Splittable Pseudorandom Number
/// Generators", OOPSLA 2014).
double latticeValue(int64_t x, int64_t y, int64_t z) {
    uint64_t h =
        uint64_t(x) * 0x9E3779B97F4A7C15u + uint64_t(y) * 0xBF58476D1CE4E5B9u + uint64_t(z) * 0x94D049BB133111EBu;
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9u;
    h = (h ^ (h >> 27)) * 0x94D049BB133111EBu;
    return double((h ^ (h >> 31)) >> 11) * 0x1p-52 - 1.0;
}

double smoothStep(double t) { return t * t * (3.0 - 2.0 * t); }
double blend(double a, double b, double t) { return a + (b - a) * t; }

/// Interpolated lattice values, in [-1, 1].
double valueNoise(const Vec3d& p) {
    const Vec3d cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
    const int64_t x = int64_t(cell.x), y = int64_t(cell.y), z = int64_t(cell.z);
    const Vec3d t{smoothStep(p.x - cell.x), smoothStep(p.y - cell.y), smoothStep(p.z - cell.z)};
    const auto edge = [&](int64_t j, int64_t k) {
        return blend(latticeValue(x, y + j, z + k), latticeValue(x + 1, y + j, z + k), t.x);
    };
    return blend(blend(edge(0, 0), edge(1, 0), t.y), blend(edge(0, 1), edge(1, 1), t.y), t.z);
}

/// Six octaves of falling weight, in [-1, 1].
double fractalNoise(const Vec3d& p) {
    double sum = 0, weight = 0.5, total = 0, frequency = 3;
    for (int octave = 0; octave < 6; ++octave, weight *= 0.5, frequency *= 2) {
        sum += weight * valueNoise(p * frequency);
        total += weight;
    }
    return sum / total;
}

/// The vertices on a cube's lattice, each made once however many faces it lies on.
class LatticeVertices {
public:
    LatticeVertices(uint32_t cells, double amplitude, std::vector<Vec3f>& positions)
        : cells_(cells), amplitude_(amplitude), positions_(positions) {}

    uint32_t at(const std::array<uint32_t, 3>& lattice) {
        const uint64_t side = cells_ + 1, key = (lattice[2] * side + lattice[1]) * side + lattice[0];
        const auto [found, isNew] = indices_.try_emplace(key, uint32_t(positions_.size()));
        if (isNew) positions_.push_back(position(lattice));
        return found->second;
    }

private:
    Vec3f position(const std::array<uint32_t, 3>& lattice) const {
        const auto coordinate = [&](int axis) { return 2.0 * lattice[size_t(axis)] / cells_ - 1.0; };
        const Vec3d direction = normalize(Vec3d(coordinate(0), coordinate(1), coordinate(2)));
        return Vec3f(direction * (1.0 + amplitude_ * fractalNoise(direction)));
    }

    uint32_t cells_;
    double amplitude_;
    std::vector<Vec3f>& positions_;
    std::unordered_map<uint64_t, uint32_t> indices_;
};

template <class T>
void append(std::string& bytes, T value) {
    static_assert(std::endian::native == std::endian::little);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

Mesh caveMesh(uint32_t cells, double amplitude) {
    Mesh mesh;
    mesh.name = "cave";
    LatticeVertices vertices(cells, amplitude, mesh.positions);
    for (size_t axis = 0; axis < 3; ++axis)
        for (const bool upper : {false, true})
            for (uint32_t v = 0; v < cells; ++v)
                for (uint32_t u = 0; u < cells; ++u) {
                    const auto corner = [&](uint32_t du, uint32_t dv) {
                        std::array<uint32_t, 3> lattice{};
                        lattice[axis] = upper ? cells : 0;
                        lattice[(axis + 1) % 3] = u + du;
                        lattice[(axis + 2) % 3] = v + dv;
                        return vertices.at(lattice);
                    };
                    const uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
                    // u × v points along the axis: outwards on the upper face, where the winding is turned.
                    if (upper)
                        mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {a, d, c}});
                    else
                        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
                }
    return mesh;
}

Scene caveScene(uint32_t cells) {
    Scene scene;
    scene.name = "cave of " + std::to_string(12ull * cells * cells) + " triangles";
    scene.materials.emplace_back();
    scene.meshes.push_back(caveMesh(cells, 0.3));
    scene.pointLights.push_back({.position = {0, 0.2f, 0}, .intensity = Vec3f(1)});
    scene.camera.verticalFov = 1.2f;
    return scene;
}

void writePly(const std::string& path, const Mesh& mesh) {
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
        "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
        std::to_string(mesh.triangles.size()) + "\nproperty list uchar uint vertex_indices\nend_header\n";
    for (const Vec3f& p : mesh.positions) {
        append(bytes, p.x);
        append(bytes, p.y);
        append(bytes, p.z);
    }
    for (const auto& triangle : mesh.triangles) {
        append(bytes, uint8_t(3));
        for (const uint32_t vertex : triangle) append(bytes, vertex);
    }
    writeFileAtomically(path, bytes);
}

}  // namespace antipode::test
