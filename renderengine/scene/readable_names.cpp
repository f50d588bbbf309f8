#include "scene/readable_names.h"

#include "renderengine/io/text.h"

namespace antipode {

void makeNamesReadable(Scene& scene) {
    constexpr size_t longestName = 200;
    scene.name = readableText(scene.name, longestName);
    for (Texture& texture : scene.textures) texture.name = readableText(texture.name, longestName);
    for (Material& material : scene.materials) material.name = readableText(material.name, longestName);
    for (Mesh& mesh : scene.meshes) mesh.name = readableText(mesh.name, longestName);
    for (std::string& notice : scene.notices) notice = readableText(notice);
}

}  // namespace antipode
