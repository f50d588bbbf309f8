#include "scene/lamp_units.h"

#include <algorithm>

#include "scene/scene_fields.h"

namespace antipode {

float wattsPerLumen(LampUnits units, const std::string& generator, const Scene& lamps) {
    constexpr float brightestSun = 60, brightestLamp = 200, photometric = 1 / 683.0f;
    if (units != LampUnits::ByGenerator) return units == LampUnits::Photometric ? photometric : 1;
    if (generator.find("Blender") == std::string::npos) return 1;
    float sun = 0, lamp = 0;
    forEach<Role::Irradiance>(lamps, [&](const Vec3f& irradiance) { sun = std::max(sun, maxComponent(irradiance)); });
    forEach<Role::Intensity>(lamps, [&](const Vec3f& intensity) { lamp = std::max(lamp, maxComponent(intensity)); });
    return sun > brightestSun || lamp > brightestLamp ? photometric : 1;
}

}  // namespace antipode
