#include "scene/gltf/accessors.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <string>

namespace antipode::gltf {
namespace {

// The format is little-endian, as are the machines that this runs on.

enum ComponentType { kInt8 = 5120, kUint8 = 5121, kInt16 = 5122, kUint16 = 5123, kUint32 = 5125, kFloat = 5126 };

/// Elements without bytes in the file: a small file may not ask for gigabytes.
constexpr uint64_t kMostZeros = uint64_t(1) << 26;

struct Accessor {
    std::string name;
    uint64_t count = 0;
    int components = 0;
    int type = 0;
    bool normalized = false;
    std::optional<View> data;  ///< from the first element on
    const json* sparse = nullptr;

    uint64_t elementSize() const;
};

uint64_t sizeOf(int componentType, const std::string& name) {
    switch (componentType) {
        case kInt8:
        case kUint8: return 1;
        case kInt16:
        case kUint16: return 2;
        case kUint32:
        case kFloat: return 4;
        default: fail(name + " has an unknown component type");
    }
}

uint64_t Accessor::elementSize() const { return uint64_t(components) * sizeOf(type, name); }

int componentsOf(const std::string& type, const std::string& name) {
    constexpr std::pair<const char*, int> counts[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                      {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
    for (const auto& [word, count] : counts)
        if (type == word) return count;
    fail(name + " has an unknown type");
}

/// `count` elements from `offset` on.
View within(const View& view, uint64_t offset, uint64_t count, uint64_t size, const std::string& name) {
    const uint64_t stride = view.stride == 0 ? size : view.stride, length = view.bytes.size();
    if (count == 0 || offset > length || size > length - offset || count - 1 > (length - offset - size) / stride)
        fail(name + " reaches beyond its bufferView");
    return {view.bytes.subspan(offset), stride};
}

Accessor accessorAt(const Document& document, size_t index) {
    const json& from = entry(document.json, "accessors", index);
    Accessor a;
    a.name = "accessor " + std::to_string(index);
    a.count = natural(from.at("count"));
    a.components = componentsOf(from.at("type").get<std::string>(), a.name);
    a.type = int(natural(from.at("componentType")));
    a.normalized = from.value("normalized", false);
    const uint64_t size = a.elementSize();
    if (const auto view = reference(from, "bufferView")) {
        if (const auto stride = natural(list(document.json, "bufferViews").at(*view), "byteStride", size); stride == 0)
            fail(a.name + " has a stride of zero");
        a.data = within(document.buffers.view(*view), natural(from, "byteOffset", 0), a.count, size, a.name);
    } else if (a.count > kMostZeros) {
        fail(a.name + " asks for " + std::to_string(a.count) + " elements without data");
    }
    if (from.contains("sparse")) a.sparse = &object(from, "sparse");
    return a;
}

template <class T, class Out>
void copy(const View& from, uint64_t count, int components, bool fractions, Out* out) {
    constexpr float greatest = float(std::numeric_limits<T>::max());
    for (uint64_t i = 0; i < count; ++i) {
        const uint8_t* element = from.bytes.data() + i * from.stride;
        for (int c = 0; c < components; ++c, ++out) {
            T value;
            std::memcpy(&value, element + size_t(c) * sizeof value, sizeof value);
            *out = Out(value);
            if constexpr (std::is_same_v<Out, float> && std::is_integral_v<T>)
                if (fractions) *out = std::max(*out / greatest, -1.0f);
        }
    }
}

template <class Out>
void copy(const Accessor& a, const View& from, uint64_t count, bool fractions, Out* out) {
    switch (a.type) {
        case kUint8: return copy<uint8_t>(from, count, a.components, fractions, out);
        case kUint16: return copy<uint16_t>(from, count, a.components, fractions, out);
        case kUint32: return copy<uint32_t>(from, count, a.components, fractions, out);
        default: break;
    }
    if constexpr (std::is_same_v<Out, float>) {
        switch (a.type) {
            case kInt8: return copy<int8_t>(from, count, a.components, fractions, out);
            case kInt16: return copy<int16_t>(from, count, a.components, fractions, out);
            default: return copy<float>(from, count, a.components, fractions, out);
        }
    }
    fail(a.name + " does not hold unsigned integers, which are needed");
}

/// Replaces single elements.
template <class Out>
void applySparse(const Document& document, const Accessor& a, bool fractions, std::vector<Out>& out) {
    const json &indices = a.sparse->at("indices"), &values = a.sparse->at("values");
    const uint64_t count = natural(a.sparse->at("count"));
    if (count == 0) return;
    Accessor at = a;
    at.components = 1;
    at.type = int(natural(indices.at("componentType")));
    const auto part = [&](const json& from, uint64_t size) {
        View view = document.buffers.view(natural(from.at("bufferView")));
        view.stride = 0;
        return within(view, natural(from, "byteOffset", 0), count, size, a.name);
    };
    const View places = part(indices, at.elementSize()), replacements = part(values, a.elementSize());
    std::vector<uint32_t> where(count);
    copy(at, places, count, false, where.data());
    std::vector<Out> what(count * size_t(a.components));
    copy(a, replacements, count, fractions, what.data());
    for (uint64_t i = 0; i < count; ++i) {
        if (where[i] >= a.count) fail(a.name + " replaces an element that does not exist");
        std::copy_n(what.begin() + std::ptrdiff_t(i) * a.components, a.components,
                    out.begin() + std::ptrdiff_t(where[i]) * a.components);
    }
}

template <class Out>
std::vector<Out> read(const Document& document, const Accessor& a, bool fractions) {
    std::vector<Out> out(a.count * size_t(a.components));
    if (a.data) copy(a, *a.data, a.count, fractions, out.data());
    if (a.sparse) applySparse(document, a, fractions, out);
    return out;
}

}  // namespace

void checkAccessors(const Document& document) {
    for (size_t i = 0; i < list(document.json, "accessors").size(); ++i) accessorAt(document, i);
}

Values readFloats(const Document& document, size_t accessor, Integers integers) {
    const Accessor a = accessorAt(document, accessor);
    const bool fractions = a.normalized || integers == Integers::Fractions;
    return {size_t(a.count), a.components, read<float>(document, a, fractions)};
}

Values readFloats(const Document& document, size_t accessor, int components) {
    Values values = readFloats(document, accessor);
    if (values.components != components)
        fail("accessor " + std::to_string(accessor) + " has " + std::to_string(values.components) +
             " numbers an element where " + std::to_string(components) + " are needed");
    return values;
}

float greatestOf(uint64_t componentType) {
    switch (componentType) {
        case kInt8: return 127;
        case kUint8: return 255;
        case kInt16: return 32767;
        case kUint16: return 65535;
        default: fail("an accessor normalises what is no integer");
    }
}

std::vector<uint32_t> readIntegers(const Document& document, size_t accessor) {
    return read<uint32_t>(document, accessorAt(document, accessor), false);
}

}  // namespace antipode::gltf
