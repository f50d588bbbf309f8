// Names of textures or materials in a schema scene → their indices.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace antipode {

class NameTable {
public:
    /// `kind` of what is named, for messages: "material".
    explicit NameTable(const char* kind) : kind_(kind) {}

    /// Equal names are allowed until one of them is asked for.
    void add(const std::string& name);
    /// `reference` is a name or "#N". Throws Error(Input), which begins with `where`.
    uint32_t find(const std::string& reference, const std::string& where) const;

private:
    const char* kind_;
    uint32_t count_ = 0;
    std::map<std::string, std::optional<uint32_t>> indices_;
};

}  // namespace antipode
