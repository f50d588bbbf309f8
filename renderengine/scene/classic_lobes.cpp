#include "scene/classic_lobes.h"

namespace antipode {

void makeDielectric(Material& m, float ior, std::vector<std::string>& notices) {
    m.kind = MaterialKind::Dielectric;
    m.baseColor = Vec3f(1.0f);
    m.baseColorTexture.reset();
    m.ior = ior;
    if (ior <= 1) {
        m.ior = 1.5f;
        notices.push_back("Material '" + m.name +
                          "' is transparent without an index of refraction above 1; it has 1.5.");
    }
}

void makePhong(Material& m, const Vec3f& specular, float exponent, std::vector<std::string>& notices) {
    m.kind = MaterialKind::Phong;
    m.specular = specular;
    m.phongExponent = exponent;
    const float total = maxComponent(m.baseColor + specular);
    if (total > 1) {
        m.baseColor = m.baseColor / total;
        m.specular = specular / total;
        notices.push_back("Material '" + m.name +
                          "' reflects more light than it receives (Kd + Ks > 1); both were scaled.");
    }
}

}  // namespace antipode
