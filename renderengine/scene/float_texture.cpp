#include "scene/float_texture.h"

#include <algorithm>
#include <cmath>

#include "film/tone_curve.h"
#include "scene/image_size.h"

namespace antipode {

Texture toTexture(const Image& image, const std::string& name, bool srgb, std::vector<std::string>& notices) {
    Texture texture;
    texture.name = name;
    texture.width = image.width;
    texture.height = image.height;
    texture.rgba.reserve(image.pixels.size() * 4);
    float largest = 0, smallest = 0;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const Vec3f& pixel = image.pixels[i];
        if (!isFinite(pixel))
            failToDecode(name, "its texel at column " + std::to_string(i % image.width) + ", row " +
                                   std::to_string(i / image.width) + " is not finite");
        largest = std::max(largest, maxComponent(pixel));
        smallest = std::min({smallest, pixel.x, pixel.y, pixel.z});
        for (int channel = 0; channel < 3; ++channel) {
            const float value = std::clamp(pixel[channel], 0.0f, 1.0f);
            texture.rgba.push_back(srgb ? encodeSrgb8(value) : uint8_t(std::lround(255 * value)));
        }
        texture.rgba.push_back(255);
    }
    if (largest > 1 || smallest < 0)
        notices.push_back("Texture '" + name + "' has values outside [0,1], which were cut off: textures have 8 bits.");
    return texture;
}

}  // namespace antipode
