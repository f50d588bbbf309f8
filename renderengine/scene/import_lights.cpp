#include "scene/import_lights.h"

#include <algorithm>
#include <numbers>

#include "scene/import_nodes.h"

namespace antipode {
namespace {

SpotLight toSpot(const Vec3f& position, const Vec3f& direction, const Vec3f& intensity, double inner, double outer) {
    SpotLight spot{position, direction, intensity, float(inner), float(outer)};
    spot.outerHalfAngle = std::min(spot.outerHalfAngle, std::numbers::pi_v<float>);
    // A hard edge is a fall-off over no angle at all, which the smooth formula cannot express.
    if (!(spot.innerHalfAngle < spot.outerHalfAngle)) spot.innerHalfAngle = spot.outerHalfAngle * 0.999f;
    return spot;
}

}  // namespace

void importLights(const aiScene& file, ModelFormat format, const ColladaDocument* collada, Scene& scene) {
    const bool inWatts = format == ModelFormat::Fbx || format == ModelFormat::Collada;
    const float perSteradian = inWatts ? float(1 / (4 * std::numbers::pi)) : 1.0f;
    const double halfAngles = format == ModelFormat::Fbx ? 0.5 : 1.0;
    for (unsigned i = 0; i < file.mNumLights; ++i) {
        const aiLight& light = *file.mLights[i];
        const std::string name = light.mName.C_Str();
        const Affine toWorld = nodeToWorld(file, name);
        const Vec3f position(toWorld.point(toVec3d(light.mPosition)));
        const Vec3f color(light.mColorDiffuse.r, light.mColorDiffuse.g, light.mColorDiffuse.b);
        const Vec3f intensity = color * perSteradian;
        const auto direction = [&] { return Vec3f(normalize(toWorld.vector(toVec3d(light.mDirection)))); };
        switch (light.mType) {
            case aiLightSource_DIRECTIONAL: scene.directionalLights.push_back({direction(), color}); break;
            case aiLightSource_POINT: scene.pointLights.push_back({position, intensity}); break;
            case aiLightSource_SPOT: {
                double inner = light.mAngleInnerCone * halfAngles, outer = light.mAngleOuterCone * halfAngles;
                if (const auto cone = collada ? collada->spot(name) : std::nullopt)
                    inner = cone->innerHalfAngle, outer = cone->outerHalfAngle;
                scene.spotLights.push_back(toSpot(position, direction(), intensity, inner, outer));
                break;
            }
            case aiLightSource_AREA:
            case aiLightSource_UNDEFINED:  // FBX's area lights
                scene.pointLights.push_back({position, intensity});
                scene.notices.push_back("Area light '" + name +
                                        "' became a point light; use emitting triangles instead.");
                break;
            default: scene.notices.push_back("Light '" + name + "' is of an unsupported kind and was dropped."); break;
        }
    }
}

}  // namespace antipode
