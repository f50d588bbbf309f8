#include "tests/kernels/light_bench.h"

namespace antipode {
namespace {

PackedScene pack(const Scene& scene) { return packScene(scene); }

}  // namespace

LightBench::LightBench(Device& device, const Scene& scene)
    : packed_(pack(scene)), harness_(device, packed_, describeJob(scene, RenderSettings{}, packed_).parameters) {}

std::vector<DrawnEmission> LightBench::emission(size_t count, Random& random) {
    const ProbeData out =
        harness_.run(kernel_probes::light_probe(), {uniformTexels(count, random), uniformTexels(count, random), {}}, 0);
    std::vector<DrawnEmission> drawn;
    for (size_t i = 0; i < count; ++i) {
        const auto flags = uint32_t(out.a[i].w);
        drawn.push_back({Vec3d(xyz(out.a[i])), Vec3d(xyz(out.b[i])), Vec3d(xyz(out.c[i])), double(out.b[i].w),
                         double(out.c[i].w), (flags & 1) != 0, (flags & 2) != 0});
    }
    return drawn;
}

std::vector<DrawnDirect> LightBench::direct(const Vec3f& position, size_t count, Random& random) {
    const ProbeData inputs{std::vector<Texel>(count, texel(position)), uniformTexels(count, random),
                           uniformTexels(count, random)};
    const ProbeData out = harness_.run(kernel_probes::light_probe(), inputs, 1);
    std::vector<DrawnDirect> drawn;
    for (size_t i = 0; i < count; ++i) {
        const auto flags = uint32_t(out.a[i].w);
        drawn.push_back({Vec3d(xyz(out.a[i])), Vec3d(xyz(out.b[i])), Vec3d(xyz(out.c[i])), double(out.b[i].w),
                         double(out.c[i].w), (flags & 1) != 0, (flags & 2) != 0});
    }
    return drawn;
}

std::vector<std::pair<uint32_t, double>> LightBench::picks(size_t count, Random& random) {
    const ProbeData out = harness_.run(kernel_probes::light_probe(), {uniformTexels(count, random), {}, {}}, 2);
    std::vector<std::pair<uint32_t, double>> result;
    for (const Texel& t : out.a) result.emplace_back(bitsOf(t.x), double(t.y));
    return result;
}

std::vector<DrawnEnvironment> LightBench::environmentOf(const ProbeData& inputs, uint32_t variant) {
    const ProbeData out = harness_.run(kernel_probes::light_probe(), inputs, variant);
    std::vector<DrawnEnvironment> result;
    for (size_t i = 0; i < out.a.size(); ++i)
        result.push_back({Vec3d(xyz(out.a[i])), Vec3d(xyz(out.b[i])), double(out.b[i].w)});
    return result;
}

std::vector<DrawnEnvironment> LightBench::environment(size_t count, Random& random) {
    return environmentOf({uniformTexels(count, random), {}, {}}, 3);
}

std::vector<DrawnEnvironment> LightBench::evalEnvironment(const std::vector<Vec3d>& directions) {
    ProbeData inputs;
    for (const Vec3d& d : directions) inputs.a.push_back(texel(Vec3f(d)));
    return environmentOf(inputs, 4);
}

Scene darkScene() {
    Scene scene;
    scene.materials.emplace_back().baseColor = Vec3f(0.0f);
    Mesh& mesh = scene.meshes.emplace_back();
    mesh.positions = {{-4, -3, -2}, {4, -3, -2}, {0, 5, -2}};
    mesh.triangles = {{0, 1, 2}};
    return scene;
}

}  // namespace antipode
