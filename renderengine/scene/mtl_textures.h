// Textures made of what MTL keeps in several images.
#pragma once

#include "scene/mtl_file.h"
#include "scene/texture_table.h"

namespace antipode {

TextureSampling samplingOf(const MtlMap& map, TextureUse use);

/// The image of `color` (white without one) with the alpha that `dissolve` tells; nothing where neither has a file.
TextureIndex colorMap(const MtlMap& color, const MtlMap& dissolve, TextureTable& textures);

/// glTF's layout: roughness in green, metalness in blue; 1 where a map is not there.
TextureIndex metallicRoughnessMap(const MtlMap& roughness, const MtlMap& metallic, TextureTable& textures);

/// A picture of normals as it is. Grey ones are heights, of -bm texels at white, and become normals.
TextureIndex bumpMap(const MtlMap& map, TextureTable& textures);

struct MeanColor {
    Vec3f color{1.0f};  ///< linear
    bool varies = false;
};
/// Over all texels. White where the image is missing.
MeanColor meanColor(const MtlMap& map, TextureTable& textures);

}  // namespace antipode
