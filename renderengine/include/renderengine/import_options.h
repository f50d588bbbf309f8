// What decides how a model file becomes a scene, beside what the file says.
#pragma once

#include <optional>
#include <string>

#include "renderengine/scene.h"

namespace antipode {

/// Which axis of a model points up; the scene's is +Y.
enum class UpAxis { AsInFile, Y, Z };

/// What lights a model that brings no light.
enum class Studio {
    None,  ///< a uniform sky of radiance 1
    Soft,  ///< a large key light, a fill and a rim before grey, and a ground below the model
    Sun,   ///< a sun in a blue sky, and the ground
};

/// What the numbers of lamps in glTF are.
enum class LampUnits {
    ByGenerator,  ///< photometric where Blender wrote them so, which its exporter does unless told otherwise
    Radiometric,  ///< W/sr and W/m²
    Photometric,  ///< cd and lux, of 683 lm/W
};

struct ImportOptions {
    std::optional<double> animationTime;  ///< seconds at which animated files are shown; without one, at rest
    bool strict = false;  ///< an image that is missing or cannot be decoded is an error instead of a substitute
    UpAxis up = UpAxis::AsInFile;  ///< of models that are not glTF; STL, which does not say, has Z
    Studio studio = Studio::None;
    LampUnits lampUnits = LampUnits::ByGenerator;
    std::optional<std::string>
        camera;  ///< the file's camera of this name, or in a node of this name; the first without
};

/// importModel() as these options say.
Scene importModel(const std::string& path, const ImportOptions& options);

}  // namespace antipode
