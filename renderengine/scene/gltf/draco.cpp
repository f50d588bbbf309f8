#include "scene/gltf/draco.h"

#include <draco/compression/decode.h>

#include <algorithm>
#include <memory>

namespace antipode::gltf {
namespace {

Values valuesOf(const ::draco::PointAttribute& attribute, size_t points) {
    Values values{points, attribute.num_components(), {}};
    if (values.components < 1 || values.components > 4) fail("its Draco attributes have no or too many components");
    values.numbers.resize(points * size_t(values.components));
    for (size_t i = 0; i < points; ++i) {
        const auto at = attribute.mapped_index(::draco::PointIndex(uint32_t(i)));
        if (at.value() >= attribute.size() ||
            !attribute.ConvertValue<float>(at, int8_t(values.components),
                                           values.numbers.data() + i * size_t(values.components)))
            fail("its Draco attributes are damaged");
    }
    return values;
}

/// The accessor of an attribute says what its integers mean; Draco may know it, too, and has divided then.
void normalize(const json& accessor, const ::draco::PointAttribute& attribute, Values& values) {
    if (!accessor.value("normalized", false) || attribute.normalized()) return;
    const float greatest = greatestOf(natural(accessor.at("componentType")));
    for (float& number : values.numbers) number = std::max(number / greatest, -1.0f);
}

}  // namespace

DracoGeometry decodeDraco(const Document& document, const json& primitive) {
    const json& from = extension(primitive, "KHR_draco_mesh_compression");
    const auto bytes = document.buffers.view(natural(from.at("bufferView"))).bytes;
    ::draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    ::draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) fail("its Draco data cannot be decoded: " + decoded.status().error_msg_string());
    const std::unique_ptr<::draco::Mesh> mesh = std::move(decoded).value();

    DracoGeometry geometry;
    geometry.corners.reserve(size_t(mesh->num_faces()) * 3);
    for (uint32_t f = 0; f < mesh->num_faces(); ++f)
        for (const auto& corner : mesh->face(::draco::FaceIndex(f))) geometry.corners.push_back(corner.value());
    for (const auto& [semantic, id] : object(from, "attributes").items()) {
        const ::draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(uint32_t(natural(id)));
        if (!attribute) fail("its Draco data lack the attribute " + semantic);
        Values values = valuesOf(*attribute, mesh->num_points());
        if (const auto accessor = reference(object(primitive, "attributes"), semantic.c_str()))
            normalize(entry(document.json, "accessors", *accessor), *attribute, values);
        geometry.attributes.emplace(semantic, std::move(values));
    }
    return geometry;
}

}  // namespace antipode::gltf
