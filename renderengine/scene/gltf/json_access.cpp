#include "scene/gltf/json_access.h"

#include <cmath>

#include "renderengine/error.h"

namespace antipode::gltf {

void fail(const std::string& why) { throw Error(ErrorCode::Input, "not a usable glTF file: " + why); }

const json& object(const json& parent, const char* key) {
    static const json none = json::object();
    const auto found = parent.find(key);
    if (found == parent.end()) return none;
    if (!found->is_object()) fail(std::string(key) + " is no object");
    return *found;
}

const json& list(const json& parent, const char* key) {
    static const json none = json::array();
    const auto found = parent.find(key);
    if (found == parent.end()) return none;
    if (!found->is_array()) fail(std::string(key) + " is no list");
    return *found;
}

const json& extension(const json& parent, const char* name) { return object(object(parent, "extensions"), name); }

uint64_t natural(const json& value) {
    if (value.is_number_unsigned()) return value.get<uint64_t>();
    // Some exporters write 3.0.
    constexpr double limit = 9007199254740992.0;  // 2^53
    const double number = value.is_number_float() ? value.get<double>() : -1.0;
    if (!(number >= 0 && number < limit && number == std::floor(number)))
        fail(value.dump() + " stands where a count or index is needed");
    return uint64_t(number);
}

uint64_t natural(const json& parent, const char* key, uint64_t otherwise) {
    const auto found = parent.find(key);
    return found == parent.end() ? otherwise : natural(*found);
}

std::optional<size_t> reference(const json& parent, const char* key) {
    const auto found = parent.find(key);
    if (found == parent.end()) return {};
    return size_t(natural(*found));
}

const json& entry(const json& file, const char* name, size_t index) {
    const json& entries = list(file, name);
    if (index >= entries.size())
        fail("it refers to entry " + std::to_string(index) + " of its " + std::to_string(entries.size()) + " " + name);
    return entries[index];
}

std::string nameOf(const json& entry, const char* kind, size_t index) {
    const std::string name = entry.value("name", "");
    return name.empty() ? std::string(kind) + " " + std::to_string(index) : name;
}

}  // namespace antipode::gltf
