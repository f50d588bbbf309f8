#include "scene/image_size.h"

#include "renderengine/error.h"

namespace antipode {

void failToDecode(const std::string& name, const std::string& why) {
    throw Error(ErrorCode::Input, "image '" + name + "' cannot be decoded: " + why);
}

Texture allocateTexture(const std::string& name, uint64_t width, uint64_t height, size_t fileBytes) {
    if (!isPlausibleSize(width, height, fileBytes))
        failToDecode(name, "its size of " + std::to_string(width) + "×" + std::to_string(height) +
                               " does not fit its " + std::to_string(fileBytes) + " bytes");
    Texture texture;
    texture.name = name;
    texture.width = uint32_t(width);
    texture.height = uint32_t(height);
    texture.rgba.resize(width * height * 4);
    return texture;
}

}  // namespace antipode
