// The textures that an imported file uses: found, each decoded once, and replaced by something that is seen where that
// fails.
#pragma once

#include <compare>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "renderengine/error.h"
#include "renderengine/scene.h"

namespace antipode {

/// What the values of a texture stand for, which decides how they are stored.
enum class TextureUse { Color, Data };

/// How an image is read where it is used; one image used in two ways is two textures.
struct TextureSampling {
    TextureUse use = TextureUse::Color;
    WrapMode wrapU = WrapMode::Repeat, wrapV = WrapMode::Repeat;
    bool nearest = false;
    uint32_t uvSet = 0;

    auto operator<=>(const TextureSampling&) const = default;
};

/// Finds, decodes and remembers textures. The scene may not go away while it lives.
///
/// An image that is missing or broken is one notice that names it and, where it is a colour, a magenta checker; data
/// (normals, roughness) are left out, since nothing stands for them. With `strict` it is an Error(Input).
class TextureTable {
public:
    /// `directory`: where relative file names start. `scene` receives textures and notices.
    TextureTable(std::string directory, bool strict, Scene& scene)
        : directory_(std::move(directory)), strict_(strict), scene_(scene) {}

    /// The texture of an image that stands in a file of its own, by the name that the model gives it.
    TextureIndex findFile(const std::string& name, const TextureSampling& sampling);

    /// The texture of an image that comes from elsewhere. `key` tells it from all others and stands in messages;
    /// `decode` is called the first time and throws Error(Input) where there is no image.
    TextureIndex find(const std::string& key, const TextureSampling& sampling, const std::function<Texture()>& decode);

    /// The image in a file of its own as 8-bit RGBA, for who makes another texture of it. Throws Error(Input).
    Texture read(const std::string& name, TextureUse use);

    /// The same, but nothing, with the notice, where there is no image. Throws with `strict`.
    std::optional<Texture> tryToRead(const std::string& name, TextureUse use);

private:
    void complain(const std::string& key, const Error& why, const char* consequence);
    TextureIndex add(Texture texture, const TextureSampling& sampling);

    std::string directory_;
    bool strict_;
    Scene& scene_;
    std::map<std::pair<std::string, TextureSampling>, TextureIndex> known_;
    std::set<std::string> complainedOf_;
};

/// Where the image that a model calls `name` lies: the path as it is written (backslashes separate folders, too), else
/// the same without regard to case, else its bare name in `directory` or in a folder "textures" there. Nothing where
/// there is no such file.
std::string findImageFile(const std::string& directory, const std::string& name);

}  // namespace antipode
