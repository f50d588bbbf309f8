#include "scene/environment_map.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "renderengine/error.h"
#include "renderengine/io/files.h"
#include "renderengine/film.h"
#include "scene/radiance_hdr.h"

namespace antipode {
namespace {

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

/// Half floats of a sky with a sun overflow easily.
void requireFinite(const Image& image, const std::string& path) {
    const auto broken =
        std::find_if(image.pixels.begin(), image.pixels.end(), [](const Vec3f& pixel) { return !isFinite(pixel); });
    if (broken == image.pixels.end()) return;
    const auto index = size_t(broken - image.pixels.begin());
    throw Error(ErrorCode::Input, "environment map '" + path + "': the texel at column " +
                                      std::to_string(index % image.width) + ", row " +
                                      std::to_string(index / image.width) +
                                      " is not finite; write the map as 32-bit floats or limit its values");
}

}  // namespace

Environment readEnvironmentMap(const std::string& path) {
    const std::filesystem::path file(path);
    requireRegularFile(path);
    Image image;
    const std::string suffix = lowerCase(file.extension().string());
    if (suffix == ".exr")
        image = readExr(path);
    else if (suffix == ".hdr" || suffix == ".pic")
        image = decodeRadianceHdr(readFileBytes(path), file.filename().string());
    else
        throw Error(ErrorCode::Input, "environment map '" + path + "' is neither .exr nor .hdr");
    requireFinite(image, path);
    Environment environment;
    environment.radiance = Vec3f(1.0f);
    environment.width = image.width;
    environment.height = image.height;
    environment.map = std::move(image.pixels);
    return environment;
}

}  // namespace antipode
