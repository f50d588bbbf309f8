// The lobes of the classic model (Wavefront MTL, Collada, FBX), whichever reader asks for them.
#pragma once

#include <string>
#include <vector>

#include "renderengine/scene.h"

namespace antipode {

/// Reflectance of what has no colour of its own: it stands out from white and from black.
constexpr float kDefaultGrey = 0.6f;

/// Clear glass of this index; of 1.5, with a notice, where it is not above 1.
void makeDielectric(Material& material, float ior, std::vector<std::string>& notices);

/// A diffuse base and a Phong lobe; where they reflect more light than they receive both are scaled, with a notice.
void makePhong(Material& material, const Vec3f& specular, float exponent, std::vector<std::string>& notices);

}  // namespace antipode
