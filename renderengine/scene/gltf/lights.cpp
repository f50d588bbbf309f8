#include "scene/gltf/lights.h"

#include <algorithm>
#include <numbers>

#include "scene/lamp_units.h"
#include "scene/scene_fields.h"

namespace antipode::gltf {
namespace {

Vec3f powerOf(const json& light) {
    Vec3f color(1.0f);
    if (const json& given = list(light, "color"); !given.empty())
        color = {given.at(0).get<float>(), given.at(1).get<float>(), given.at(2).get<float>()};
    return color * light.value("intensity", 1.0f);
}

SpotLight toSpot(const json& light, const Vec3f& position, const Vec3f& direction) {
    const json& cone = object(light, "spot");
    SpotLight spot{position, direction, powerOf(light), cone.value("innerConeAngle", 0.0f),
                   cone.value("outerConeAngle", std::numbers::pi_v<float> / 4)};
    spot.outerHalfAngle = std::min(spot.outerHalfAngle, std::numbers::pi_v<float>);
    // A hard edge is a fall-off over no angle at all, which the smooth formula cannot express.
    if (!(spot.innerHalfAngle < spot.outerHalfAngle)) spot.innerHalfAngle = spot.outerHalfAngle * 0.999f;
    return spot;
}

}  // namespace

void importLights(const Document& document, const Nodes& nodes, LampUnits units, Scene& scene) {
    const json& lights = extension(document.json, "KHR_lights_punctual");
    std::vector<bool> rangeIsNoted(list(lights, "lights").size());
    for (size_t node : nodes.shown) {
        const auto index = reference(extension(document.json["nodes"][node], "KHR_lights_punctual"), "light");
        if (!index) continue;
        const json& light = entry(lights, "lights", *index);
        const Vec3f position(nodes.toWorld[node].offset), direction(normalize(-nodes.toWorld[node].z));
        const std::string type = light.value("type", ""), name = nameOf(light, "light", *index);
        if (type == "directional")
            scene.directionalLights.push_back({direction, powerOf(light)});
        else if (type == "point")
            scene.pointLights.push_back({position, powerOf(light)});
        else if (type == "spot")
            scene.spotLights.push_back(toSpot(light, position, direction));
        else
            scene.notices.push_back("Light '" + name + "' is of the unknown kind '" + type + "' and was dropped.");
        if (light.contains("range") && !rangeIsNoted[*index]) {
            rangeIsNoted[*index] = true;
            scene.notices.push_back("Light '" + name + "': its range is ignored; light goes on for ever.");
        }
    }
    const std::string generator = object(document.json, "asset").value("generator", "");
    if (const float factor = wattsPerLumen(units, generator, scene); factor != 1) {
        forEach<Role::Intensity>(scene, [&](Vec3f& intensity) { intensity = intensity * factor; });
        forEach<Role::Irradiance>(scene, [&](Vec3f& irradiance) { irradiance = irradiance * factor; });
        scene.notices.push_back(
            "Lamps are taken for photometric, at 683 lumens a watt; --lamp-units radiometric takes them as they are.");
    }
}

}  // namespace antipode::gltf
