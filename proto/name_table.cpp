#include "proto/name_table.h"

#include <charconv>

#include "proto/schema_values.h"

namespace antipode {

void NameTable::add(const std::string& name) {
    const auto [entry, isNew] = indices_.emplace(name, count_++);
    if (!isNew) entry->second.reset();
}

uint32_t NameTable::find(const std::string& reference, const std::string& where) const {
    if (const auto found = indices_.find(reference); found != indices_.end()) {
        if (!found->second) failAt(where, "refers to '" + reference + "', which names more than one " + kind_);
        return *found->second;
    }
    uint32_t index = 0;
    const char* end = reference.data() + reference.size();
    if (reference.size() > 1 && reference[0] == '#') {
        const auto [last, error] = std::from_chars(reference.data() + 1, end, index);
        if (last == end && error == std::errc() && index < count_) return index;
    }
    if (reference.empty()) failAt(where, std::string("names no ") + kind_);
    failAt(where, "refers to the " + std::string(kind_) + " '" + reference + "', which does not exist");
}

}  // namespace antipode
