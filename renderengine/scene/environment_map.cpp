#include "scene/environment_map.h"

#include <filesystem>

#include "renderengine/error.h"
#include "renderengine/io/files.h"
#include "renderengine/film.h"
#include "scene/radiance_hdr.h"

namespace antipode {

Environment readEnvironmentMap(const std::string& path) {
    const std::filesystem::path file(path);
    requireRegularFile(path);
    Image image;
    if (file.extension() == ".exr")
        image = readExr(path);
    else if (file.extension() == ".hdr" || file.extension() == ".pic")
        image = decodeRadianceHdr(readFileBytes(path), file.filename().string());
    else
        throw Error(ErrorCode::Input, "environment map '" + path + "' is neither .exr nor .hdr");
    Environment environment;
    environment.radiance = Vec3f(1.0f);
    environment.width = image.width;
    environment.height = image.height;
    environment.map = std::move(image.pixels);
    return environment;
}

}  // namespace antipode
