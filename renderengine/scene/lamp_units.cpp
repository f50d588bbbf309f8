#include "scene/lamp_units.h"

#include <algorithm>

namespace antipode {

float wattsPerLumen(LampUnits units, const std::string& generator, const Scene& lamps) {
    constexpr float brightestSun = 60, brightestLamp = 200, photometric = 1 / 683.0f;
    if (units != LampUnits::ByGenerator) return units == LampUnits::Photometric ? photometric : 1;
    if (generator.find("Blender") == std::string::npos) return 1;
    float sun = 0, lamp = 0;
    for (const DirectionalLight& light : lamps.directionalLights) sun = std::max(sun, maxComponent(light.irradiance));
    for (const PointLight& light : lamps.pointLights) lamp = std::max(lamp, maxComponent(light.intensity));
    for (const SpotLight& light : lamps.spotLights) lamp = std::max(lamp, maxComponent(light.intensity));
    return sun > brightestSun || lamp > brightestLamp ? photometric : 1;
}

}  // namespace antipode
