// What `antipode render` is asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderengine/scene.h"
#include "renderengine/settings.h"

namespace antipode {

struct RenderOptions {
    std::string scenePath;
    std::string exrPath, pngPath;  ///< the PNG has the EXR's stem
    std::optional<std::string> statsPath;
    std::optional<uint32_t> width, height;  ///< pixels; see resolveSize
    std::optional<uint64_t> iterations;     ///< set unless `seconds` is
    std::optional<double> seconds;          ///< no iteration starts after that time of rendering
    std::string device;                     ///< selector for Engine
    bool quiet = false;
    RenderSettings settings;  ///< all but the size, which can depend on the scene
};

/// Parses the arguments after `render` and makes them consistent. Nothing where --help was asked for.
/// Throws Error(Usage).
std::optional<RenderOptions> parseRenderOptions(const std::vector<std::string>& arguments);

/// Sets the size of `settings`: the scene's preferred one, unless given; a side given alone takes the other with it in
/// the scene's aspect ratio.
void resolveSize(const RenderOptions& options, const Scene& scene, RenderSettings& settings);

}  // namespace antipode
