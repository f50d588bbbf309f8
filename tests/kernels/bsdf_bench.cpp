#include "tests/kernels/bsdf_bench.h"

#include <cmath>

#include "support/random.h"

namespace antipode {
namespace {

const std::array<Vec3f, 3> corners{Vec3f{0.3f, -1.1f, 0.2f}, {0.7f, 0.4f, -0.9f}, {-0.5f, 0.6f, 0.8f}};

reference::Frame cornerFrame() {
    const Vec3d a(corners[0]), b(corners[1]), c(corners[2]);
    return reference::Frame(normalize(cross(b - a, c - a)));
}

Scene oneTriangleEach(const std::vector<BsdfCase>& cases) {
    Scene scene;
    for (const BsdfCase& c : cases) {
        Mesh mesh;
        mesh.positions.assign(corners.begin(), corners.end());
        mesh.triangles = {{0, 1, 2}};
        mesh.material = uint32_t(scene.materials.size());
        scene.materials.push_back(c.material);
        scene.meshes.push_back(mesh);
    }
    return scene;
}

Material kind(MaterialKind k) {
    Material m;
    m.kind = k;
    return m;
}

std::string number(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", x);
    return text;
}

void addPhong(std::vector<BsdfCase>& cases, float exponent, const Vec3f& diffuse, const Vec3f& specular) {
    Material m = kind(MaterialKind::Phong);
    m.baseColor = diffuse;
    m.specular = specular;
    m.phongExponent = exponent;
    cases.push_back({"Phong " + number(exponent) + (maxComponent(diffuse) > 0 ? " and diffuse" : ""), m,
                     1 / std::sqrt(1.0 + exponent)});
}

void addRoughDielectric(std::vector<BsdfCase>& cases, double alpha, float ior) {
    Material m = kind(MaterialKind::RoughDielectric);
    m.roughness = float(std::sqrt(alpha));
    m.ior = ior;
    cases.push_back({"rough dielectric " + number(alpha) + ", ior " + number(double(ior)), m, alpha, true,
                     std::min(1.0, double(ior) - 1)});
}

void addMetallicRoughness(std::vector<BsdfCase>& cases, float roughness, float metallic, float factor) {
    Material m = kind(MaterialKind::MetallicRoughness);
    m.baseColor = {0.9f, 0.5f, 0.1f};
    m.roughness = roughness;
    m.metallic = metallic;
    m.specularFactor = factor;
    cases.push_back({"roughness " + number(double(roughness)) + ", metallic " + number(double(metallic)) +
                         ", specular " + number(double(factor)),
                     m, std::max(double(roughness) * double(roughness), 2.5e-4)});
}

/// Rough glass of a colour, as a body or a pane.
void addTransmission(std::vector<BsdfCase>& cases, float roughness, float transmission, float metallic, bool thin) {
    Material m = kind(MaterialKind::MetallicRoughness);
    m.baseColor = {0.9f, 0.5f, 0.1f};
    m.roughness = roughness;
    m.metallic = metallic;
    m.transmission = transmission;
    m.thin = thin;
    const double alpha = double(roughness) * double(roughness);
    cases.push_back({std::string(thin ? "pane" : "body") + ", share of glass " + number(double(transmission)) +
                         ", roughness " + number(double(roughness)) + ", metallic " + number(double(metallic)),
                     m, std::max(alpha, 2.5e-4), alpha >= 1e-4, thin ? 1 : std::min(1.0, double(m.ior) - 1)});
}

/// A clear coat and sheen, over paint or metal.
void addLayers(std::vector<BsdfCase>& cases, float coat, float coatRoughness, float sheen, float sheenRoughness,
               float metallic, float transmission = 0) {
    Material m = kind(MaterialKind::MetallicRoughness);
    m.baseColor = {0.9f, 0.5f, 0.1f};
    m.roughness = 0.6f;
    m.metallic = metallic;
    m.clearcoat = coat;
    m.clearcoatRoughness = coatRoughness;
    m.sheenColor = Vec3f{1.0f, 0.6f, 0.3f} * sheen;
    m.sheenRoughness = sheenRoughness;
    m.transmission = transmission;
    const double alpha = coat > 0 ? std::max(double(coatRoughness) * double(coatRoughness), 2.5e-4) : 1;
    cases.push_back({"coat " + number(double(coat)) + " of roughness " + number(double(coatRoughness)) + ", sheen " +
                         number(double(sheen)) + " of roughness " + number(double(sheenRoughness)) + ", metallic " +
                         number(double(metallic)) + (transmission > 0 ? ", part glass" : ""),
                     m, std::min(alpha, 0.36), transmission > 0, std::min(1.0, double(m.ior) - 1)});
}

std::vector<BsdfCase> makeCases() {
    std::vector<BsdfCase> cases;
    Material lambert = kind(MaterialKind::Lambert);
    lambert.baseColor = {0.2f, 0.5f, 0.8f};
    cases.push_back({"Lambert", lambert});
    lambert.twoSided = false;
    cases.push_back({"Lambert, one-sided", lambert});
    addPhong(cases, 0, {0.2f, 0.3f, 0.1f}, {0.5f, 0.4f, 0.3f});
    addPhong(cases, 1, {0, 0, 0}, {0.5f, 0.5f, 0.5f});
    addPhong(cases, 90, {0.5f, 0.2f, 0.1f}, {0.3f, 0.3f, 0.5f});
    addPhong(cases, 1e6f, {0.2f, 0.3f, 0.1f}, {0.6f, 0.6f, 0.6f});
    for (double alpha : {1e-3, 1e-2, 0.1, 0.5, 1.0}) {
        Material m = kind(MaterialKind::RoughConductor);
        m.roughness = float(std::sqrt(alpha));
        cases.push_back({"rough conductor " + number(alpha), m, alpha});
    }
    for (double alpha : {1e-3, 1e-2, 0.1, 0.5, 1.0}) addRoughDielectric(cases, alpha, 1.5f);
    addRoughDielectric(cases, 0.2, 2.4f);
    addRoughDielectric(cases, 0.3, 1.0001f);
    for (float roughness : {0.0f, 0.3f, 1.0f})
        for (float metallic : {0.0f, 0.4f, 1.0f}) addMetallicRoughness(cases, roughness, metallic, 1);
    addMetallicRoughness(cases, 0.5f, 0.3f, 0.4f);
    for (float coatRoughness : {0.0f, 0.3f, 1.0f}) addLayers(cases, 1, coatRoughness, 0, 0, 0.4f);
    for (float sheenRoughness : {0.0f, 0.5f, 1.0f}) addLayers(cases, 0, 0, 1, sheenRoughness, 0);
    addLayers(cases, 0.6f, 0.5f, 0.7f, 0.4f, 0.5f);
    addLayers(cases, 0.6f, 0.5f, 0.7f, 0.4f, 0.2f, 0.5f);
    Material pane = kind(MaterialKind::RoughDielectric);
    pane.roughness = 0.5f;
    pane.thin = true;
    cases.push_back({"rough pane", pane, 0.25, true});
    for (bool thin : {false, true}) {
        addTransmission(cases, 0.5f, 1, 0, thin);
        addTransmission(cases, 0.5f, 0.4f, 0, thin);
        addTransmission(cases, 0.6f, 0.7f, 0.3f, thin);
        addTransmission(cases, 0, 0.4f, 0.2f, thin);
    }
    return cases;
}

std::vector<BsdfCase> makeSpecularCases() {
    std::vector<BsdfCase> cases;
    Material mirror = kind(MaterialKind::Mirror);
    mirror.specular = {0.9f, 0.6f, 0.3f};
    cases.push_back({"mirror", mirror});
    for (float ior : {1.0f, 1.0001f, 1.5f, 2.4f}) {
        Material glass = kind(MaterialKind::Dielectric);
        glass.ior = ior;
        cases.push_back({"dielectric " + number(double(ior)), glass, 1, true});
    }
    for (bool thin : {false, true}) {
        Material tinted = kind(MaterialKind::MetallicRoughness);
        tinted.roughness = 0;
        tinted.transmission = 1;
        tinted.baseColor = {0.64f, 0.25f, 0.04f};
        tinted.thin = thin;
        cases.push_back({thin ? "tinted pane" : "tinted glass", tinted, 1, true});
    }
    Material metal = kind(MaterialKind::RoughConductor);
    metal.roughness = 0;
    cases.push_back({"smooth conductor", metal});
    return cases;
}

}  // namespace

const std::vector<BsdfCase>& bsdfCases() {
    static const std::vector<BsdfCase> cases = makeCases();
    return cases;
}

const std::vector<BsdfCase>& specularCases() {
    static const std::vector<BsdfCase> cases = makeSpecularCases();
    return cases;
}

Vec3d atCosine(double c) {
    const double s = std::sqrt(1 - c * c);
    return {s * std::cos(0.7), s * std::sin(0.7), c};
}

BsdfBench::BsdfBench(Device& device, const std::vector<BsdfCase>& cases)
    : frame_(cornerFrame()),
      packed_(packScene(oneTriangleEach(cases))),
      primitive_(cases.size()),
      harness_(device, packed_, {}) {
    for (uint32_t i = 0; i < primitive_.size(); ++i) primitive_[packed_.bvh.primitiveOrder[i]] = i;
}

std::vector<BsdfValue> BsdfBench::eval(size_t index, const std::vector<Vec3d>& known, const std::vector<Vec3d>& next,
                                       bool adjoint) {
    ProbeData inputs;
    for (size_t i = 0; i < known.size(); ++i) {
        inputs.a.push_back(world(known[i], std::bit_cast<float>(primitive_[index])));
        inputs.b.push_back(world(next[i], adjoint ? 1.0f : 0.0f));
    }
    const ProbeData outputs = harness_.run(kernel_probes::bsdf_probe(), inputs, 0);
    std::vector<BsdfValue> values;
    for (size_t i = 0; i < known.size(); ++i)
        values.push_back({Vec3d(xyz(outputs.a[i])), double(outputs.a[i].w), double(outputs.b[i].x)});
    return values;
}

std::vector<DrawnBsdf> BsdfBench::sample(size_t index, const Vec3d& known, const std::vector<Texel>& u, bool adjoint) {
    ProbeData inputs;
    inputs.a.assign(u.size(), world(known, std::bit_cast<float>(primitive_[index])));
    inputs.b = u;
    inputs.c.assign(u.size(), Texel{adjoint ? 1.0f : 0.0f, 0, 0, 0});
    const ProbeData outputs = harness_.run(kernel_probes::bsdf_probe(), inputs, 1);
    std::vector<DrawnBsdf> drawn;
    for (size_t i = 0; i < u.size(); ++i) {
        const auto flags = uint32_t(outputs.a[i].w);
        drawn.push_back({frame_.toLocal(Vec3d(xyz(outputs.a[i]))), Vec3d(xyz(outputs.b[i])), double(outputs.b[i].w),
                         double(outputs.c[i].x), (flags & 1) != 0, (flags & 2) != 0, (flags & 4) != 0});
    }
    return drawn;
}

}  // namespace antipode
