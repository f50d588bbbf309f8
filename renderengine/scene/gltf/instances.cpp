#include "scene/gltf/instances.h"

#include <optional>

#include "scene/gltf/accessors.h"
#include "scene/gltf/nodes.h"

namespace antipode::gltf {

std::vector<Affine> instancesOf(const Document& document, const json& node) {
    if (!object(node, "extensions").contains("EXT_mesh_gpu_instancing")) return {Affine{}};
    const json& attributes = object(extension(node, "EXT_mesh_gpu_instancing"), "attributes");
    std::optional<size_t> count;
    const auto read = [&](const char* semantic, int components) {
        Values values;
        if (const auto accessor = reference(attributes, semantic)) {
            values = readFloats(document, *accessor, components);
            if (count && *count != values.count) fail("a node's instances have attributes of different numbers");
            count = values.count;
        }
        return values;
    };
    const Values translations = read("TRANSLATION", 3), rotations = read("ROTATION", 4), scales = read("SCALE", 3);
    std::vector<Affine> instances;
    for (size_t i = 0; i < count.value_or(0); ++i) {
        const auto at = [&](const Values& values, size_t k, double otherwise) {
            return values.count > 0 ? double(values.numbers[i * size_t(values.components) + k]) : otherwise;
        };
        instances.push_back(
            fromParts({at(translations, 0, 0), at(translations, 1, 0), at(translations, 2, 0)},
                      {at(rotations, 0, 0), at(rotations, 1, 0), at(rotations, 2, 0), at(rotations, 3, 1)},
                      {at(scales, 0, 1), at(scales, 1, 1), at(scales, 2, 1)}));
    }
    return instances;
}

}  // namespace antipode::gltf
