// The JSON of a glTF: what may be absent, and references that must lead somewhere.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace antipode::gltf {

using nlohmann::json;

/// Throws Error(Input): "not a usable glTF file: why". Whoever imports a file puts its name before the message.
[[noreturn]] void fail(const std::string& why);

/// The object or list of this name; an empty one where there is none.
const json& object(const json& parent, const char* key);
const json& list(const json& parent, const char* key);
const json& extension(const json& parent, const char* name);

/// A count, offset or index: a whole number that is not negative. Throws Error(Input).
uint64_t natural(const json& value);
uint64_t natural(const json& parent, const char* key, uint64_t otherwise);
/// The index that stands in a member; nothing where there is no such member.
std::optional<size_t> reference(const json& parent, const char* key);
/// Entry `index` of one of the file's lists ("nodes", "accessors", …). Throws Error(Input) where there is none.
const json& entry(const json& file, const char* list, size_t index);

/// What people call an entry: its name, or "mesh 3".
std::string nameOf(const json& entry, const char* kind, size_t index);

}  // namespace antipode::gltf
