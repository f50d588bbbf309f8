#include "scene/import_lights.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <numbers>

#include "scene/import_nodes.h"

namespace antipode {
namespace {

bool hasFullSpotAngles(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return extension == ".fbx";
}

SpotLight toSpot(const aiLight& light, const Vec3f& position, const Vec3f& direction, const Vec3f& intensity,
                 bool fullAngles) {
    const float scale = fullAngles ? 0.5f : 1.0f;
    SpotLight spot{position, direction, intensity, light.mAngleInnerCone * scale, light.mAngleOuterCone * scale};
    spot.outerHalfAngle = std::min(spot.outerHalfAngle, std::numbers::pi_v<float>);
    // A hard edge is a fall-off over no angle at all, which the smooth formula cannot express.
    if (!(spot.innerHalfAngle < spot.outerHalfAngle)) spot.innerHalfAngle = spot.outerHalfAngle * 0.999f;
    return spot;
}

}  // namespace

void importLights(const aiScene& file, const std::string& path, Scene& scene) {
    for (unsigned i = 0; i < file.mNumLights; ++i) {
        const aiLight& light = *file.mLights[i];
        const std::string name = light.mName.C_Str();
        const Affine toWorld = nodeToWorld(file, name);
        const Vec3f position(toWorld.point(toVec3d(light.mPosition)));
        const Vec3f color(light.mColorDiffuse.r, light.mColorDiffuse.g, light.mColorDiffuse.b);
        const auto direction = [&] { return Vec3f(normalize(toWorld.vector(toVec3d(light.mDirection)))); };
        switch (light.mType) {
            case aiLightSource_DIRECTIONAL: scene.directionalLights.push_back({direction(), color}); break;
            case aiLightSource_POINT: scene.pointLights.push_back({position, color}); break;
            case aiLightSource_SPOT:
                scene.spotLights.push_back(toSpot(light, position, direction(), color, hasFullSpotAngles(path)));
                break;
            case aiLightSource_AREA:
                scene.pointLights.push_back({position, color});
                scene.notices.push_back("Area light '" + name +
                                        "' became a point light; use emitting triangles instead.");
                break;
            default: scene.notices.push_back("Light '" + name + "' is of an unsupported kind and was dropped."); break;
        }
    }
}

}  // namespace antipode
