#include "scene/readable_names.h"

#include <map>
#include <set>
#include <string_view>
#include <utility>

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

void foldNotices(std::vector<std::string>& notices) {
    struct First {
        size_t index = 0;
        std::set<std::string> others;  ///< materials, as the notices name them
    };
    std::map<std::string, First> known;  // by what is said of the material
    std::vector<std::string> kept;
    for (std::string& notice : notices) {
        const std::string_view begin = "Material '";
        const size_t end = notice.starts_with(begin) ? notice.find('\'', begin.size()) : std::string::npos;
        const std::string said = end == std::string::npos ? notice : notice.substr(end);
        const auto [first, isNew] = known.try_emplace(said, First{kept.size(), {}});
        if (isNew)
            kept.push_back(std::move(notice));
        else if (notice != kept[first->second.index])
            first->second.others.insert(std::move(notice));
    }
    for (const auto& [said, first] : known)
        if (const size_t count = first.others.size(); count > 0)
            kept[first.index] +=
                " So it is with " + std::to_string(count) + " more material" + (count > 1 ? "s." : ".");
    notices = std::move(kept);
}

}  // namespace antipode
