// Sets of what an enumeration names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>

namespace antipode {

/// Of the enumeration's first `size` values, bit i of bits() standing for value i.
template <class E, uint32_t setSize>
class EnumSet {
public:
    static constexpr uint32_t size = setSize;

    constexpr EnumSet() = default;
    constexpr explicit EnumSet(uint32_t bits) : bits_(bits) {}
    constexpr EnumSet(std::initializer_list<E> values) {
        for (const E value : values) add(value);
    }

    constexpr bool has(E value) const { return (bits_ >> uint32_t(value) & 1) != 0; }
    constexpr void add(E value) { bits_ |= 1u << uint32_t(value); }
    constexpr void add(EnumSet values) { bits_ |= values.bits_; }
    constexpr void remove(E value) { bits_ &= ~(1u << uint32_t(value)); }
    constexpr bool empty() const { return bits_ == 0; }
    constexpr uint32_t bits() const { return bits_; }
    constexpr bool operator==(const EnumSet&) const = default;

private:
    uint32_t bits_ = 0;
};

/// The options of the rows whose values are in the set, joined by commas; "none" where there are none. Row i of the
/// table is of value i.
template <class E, uint32_t size, class Table>
std::string namesOf(EnumSet<E, size> set, const Table& table) {
    std::string text;
    for (size_t i = 0; i < table.size(); ++i)
        if (set.has(E(i))) text.append(text.empty() ? "" : ",").append(table[i].option);
    return text.empty() ? "none" : text;
}

}  // namespace antipode
