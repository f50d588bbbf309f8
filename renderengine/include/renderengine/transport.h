// The techniques of the weighted sum that can be left out of it, to see what each is for or to save its time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace antipode {

/// In the order of bits of TransportSet. Meeting emitters by chance is in every technique and costs nothing.
enum class Transport { NextEvent, LightTracing, Connections, Merging };
inline constexpr uint32_t transports = 4;

struct TransportInfo {
    Transport transport;
    const char* option;       ///< what --without takes
    const char* description;  ///< a few words
};

/// All of them, in the order of Transport.
const std::vector<TransportInfo>& transportTable();

class TransportSet {
public:
    constexpr TransportSet() = default;
    constexpr explicit TransportSet(uint32_t bits) : bits_(bits) {}

    constexpr bool has(Transport transport) const { return (bits_ >> uint32_t(transport) & 1) != 0; }
    constexpr void add(Transport transport) { bits_ |= 1u << uint32_t(transport); }
    constexpr bool empty() const { return bits_ == 0; }
    constexpr uint32_t bits() const { return bits_; }
    constexpr bool operator==(const TransportSet&) const = default;

private:
    uint32_t bits_ = 0;
};

/// The names that --without takes, joined by commas; "none" where there are none.
std::string name(TransportSet set);

}  // namespace antipode
