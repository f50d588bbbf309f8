#include "scene/units.h"

#include <cmath>

#include "renderengine/error.h"
#include "scene/bounds.h"
#include "scene/scene_fields.h"

namespace antipode {

double boundingRadius(const Scene& scene) { return boundsOf(scene).radius(); }

int unitExponent(const Scene& scene) {
    const int exponent = std::ilogb(boundingRadius(scene));
    return std::abs(exponent) <= 16 ? 0 : -exponent;
}

Scene inUnits(Scene scene, int exponent) {
    const auto inRange = [&](bool holds, const char* what) {
        if (!holds)
            throw Error(ErrorCode::Input, "scene '" + scene.name + "': measured by the scene's size, " + what +
                                              " lies outside single precision; write the scene in other units");
    };
    const auto scale = [&](float& length) {
        length = std::ldexp(length, exponent);
        inRange(std::isfinite(length), "the position of a light or of the camera, or its lens,");
    };
    forEach<Role::Length>(scene, scale);
    forEach<Role::Position>(scene, [&](Vec3f& p) { scale(p.x), scale(p.y), scale(p.z); });
    forEach<Role::Intensity>(scene, [&](Vec3f& intensity) {
        for (int axis = 0; axis < 3; ++axis) {
            if (intensity[axis] == 0) continue;
            intensity[axis] = std::ldexp(intensity[axis], 2 * exponent);
            inRange(std::isnormal(intensity[axis]), "the intensity of a light");
        }
    });
    return scene;
}

}  // namespace antipode
