#include "scene/mtl_textures.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace antipode {
namespace {

constexpr uint8_t kOpaque = 255;

Texture whiteTexel(const std::string& name) { return {name, 1, 1, {kOpaque, kOpaque, kOpaque, kOpaque}}; }

const uint8_t* texelAt(const Texture& image, uint32_t x, uint32_t y) {
    return &image.rgba[(size_t(y) * image.width + x) * 4];
}

/// The texel of `image` that covers (x, y) of a picture of another size.
const uint8_t* texelBelow(const Texture& image, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
    return texelAt(image, uint32_t(uint64_t(x) * image.width / width), uint32_t(uint64_t(y) * image.height / height));
}

/// Which of a texel's four bytes a scalar map means: -imfchan's, or alpha where the picture has any, else red (of grey
/// ones all three are equal).
size_t scalarChannel(const MtlMap& map, const Texture& image) {
    switch (map.channel) {
        case 'r': return 0;
        case 'g': return 1;
        case 'b': return 2;
        case 'm': return 3;
        default: break;
    }
    for (size_t i = 3; i < image.rgba.size(); i += 4)
        if (image.rgba[i] != kOpaque) return 3;
    return 0;
}

double linearOf(uint8_t srgb) {
    const double v = srgb / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// Whether it shows heights and not normals.
bool isGrey(const Texture& image) {
    constexpr int tolerance = 6;  // what JPEG does to grey
    for (size_t i = 0; i < image.rgba.size(); i += 4)
        if (std::abs(image.rgba[i] - image.rgba[i + 1]) > tolerance ||
            std::abs(image.rgba[i] - image.rgba[i + 2]) > tolerance)
            return false;
    return true;
}

/// Central differences; heights in texels, so that a slope does not depend on the picture's size alone.
Texture normalsOfHeights(const Texture& image, float heightOfWhite) {
    Texture normals = image;
    const uint32_t w = image.width, h = image.height;
    const auto height = [&](uint32_t x, uint32_t y) { return texelAt(image, x % w, y % h)[0] / 255.0 * heightOfWhite; };
    for (uint32_t y = 0; y < h; ++y) {
        for (uint32_t x = 0; x < w; ++x) {
            // Rows go down, the green of a normal goes up.
            const double slopeX = (height(x + 1, y) - height(x + w - 1, y)) / 2;
            const double slopeY = (height(x, y + h - 1) - height(x, y + 1)) / 2;
            const Vec3d n = normalize(Vec3d(-slopeX, -slopeY, 1));
            uint8_t* texel = &normals.rgba[(size_t(y) * w + x) * 4];
            for (int axis = 0; axis < 3; ++axis) texel[axis] = uint8_t(std::lround((n[axis] + 1) / 2 * 255));
        }
    }
    return normals;
}

}  // namespace

TextureSampling samplingOf(const MtlMap& map, TextureUse use) {
    const WrapMode wrap = map.clamp ? WrapMode::Clamp : WrapMode::Repeat;
    return {use, wrap, wrap};
}

TextureIndex colorMap(const MtlMap& color, const MtlMap& dissolve, TextureTable& textures) {
    const TextureSampling sampling = samplingOf(color ? color : dissolve, TextureUse::Color);
    if (!dissolve) return color ? textures.findFile(color.file, sampling) : TextureIndex();
    const std::string key = color ? color.file + "' with the alpha of '" + dissolve.file : dissolve.file;
    return textures.find(key, sampling, [&] {
        const Texture alpha = textures.read(dissolve.file, TextureUse::Data);
        const Texture rgb = color ? textures.read(color.file, TextureUse::Color) : whiteTexel(dissolve.file);
        const size_t channel = scalarChannel(dissolve, alpha);
        Texture result = rgb.width * uint64_t(rgb.height) >= alpha.width * uint64_t(alpha.height) ? rgb : alpha;
        for (uint32_t y = 0; y < result.height; ++y) {
            for (uint32_t x = 0; x < result.width; ++x) {
                const uint8_t* from = texelBelow(rgb, x, y, result.width, result.height);
                const uint8_t a = texelBelow(alpha, x, y, result.width, result.height)[channel];
                std::copy_n(from, 3, &result.rgba[(size_t(y) * result.width + x) * 4]);
                result.rgba[(size_t(y) * result.width + x) * 4 + 3] = a;
            }
        }
        result.name = rgb.name;
        return result;
    });
}

TextureIndex metallicRoughnessMap(const MtlMap& roughness, const MtlMap& metallic, TextureTable& textures) {
    const TextureSampling sampling = samplingOf(roughness ? roughness : metallic, TextureUse::Data);
    const std::string key = roughness.file + (roughness && metallic ? "' and '" : "") + metallic.file;
    return textures.find(key + (roughness ? " (roughness)" : " (metalness)"), sampling, [&] {
        const Texture r = roughness ? textures.read(roughness.file, TextureUse::Data) : whiteTexel(metallic.file);
        const Texture m = metallic ? textures.read(metallic.file, TextureUse::Data) : whiteTexel(roughness.file);
        const size_t channelR = scalarChannel(roughness, r), channelM = scalarChannel(metallic, m);
        Texture result = r.width * uint64_t(r.height) >= m.width * uint64_t(m.height) ? r : m;
        const Texture sizes = result;
        for (uint32_t y = 0; y < sizes.height; ++y) {
            for (uint32_t x = 0; x < sizes.width; ++x) {
                uint8_t* texel = &result.rgba[(size_t(y) * sizes.width + x) * 4];
                texel[1] = texelBelow(r, x, y, sizes.width, sizes.height)[channelR];
                texel[2] = texelBelow(m, x, y, sizes.width, sizes.height)[channelM];
                texel[3] = kOpaque;
            }
        }
        return result;
    });
}

TextureIndex bumpMap(const MtlMap& map, TextureTable& textures) {
    return textures.find(map.file, samplingOf(map, TextureUse::Data), [&] {
        const Texture image = textures.read(map.file, TextureUse::Data);
        return isGrey(image) ? normalsOfHeights(image, map.bumpMultiplier) : image;
    });
}

MeanColor meanColor(const MtlMap& map, TextureTable& textures) {
    MeanColor mean;
    const std::optional<Texture> image = textures.tryToRead(map.file, TextureUse::Color);
    if (!image) return mean;
    Vec3d sum;
    const size_t count = image->rgba.size() / 4;
    for (size_t i = 0; i < count; ++i) {
        const uint8_t* texel = &image->rgba[i * 4];
        sum = sum + Vec3d(linearOf(texel[0]), linearOf(texel[1]), linearOf(texel[2]));
        mean.varies |= !std::equal(texel, texel + 3, image->rgba.begin());
    }
    mean.color = Vec3f(sum / double(count));
    return mean;
}

}  // namespace antipode
