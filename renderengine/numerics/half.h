// Conversion to IEEE 754 binary16, round to nearest even.
#pragma once

#include <bit>
#include <cstdint>

namespace antipode {

/// Values beyond 65504 become infinity, NaN stays NaN, subnormals are kept.
inline uint16_t toHalf(float value) {
    const uint32_t bits = std::bit_cast<uint32_t>(value);
    const uint16_t sign = uint16_t((bits >> 16) & 0x8000u);
    const uint32_t magnitude = bits & 0x7FFFFFFFu;
    if (magnitude > 0x7F800000u) return uint16_t(sign | 0x7E00u);
    if (magnitude >= 0x477FF000u) return uint16_t(sign | 0x7C00u);
    if (magnitude < 0x38800000u) {
        // A half subnormal counts 2^-24; adding 0.5 rounds the float to that grid.
        const float rounded = std::bit_cast<float>(magnitude) + 0.5f;
        return uint16_t(sign | (std::bit_cast<uint32_t>(rounded) - 0x3F000000u));
    }
    const uint32_t rounding = 0xFFFu + ((magnitude >> 13) & 1u);
    return uint16_t(sign | ((magnitude + rounding - 0x38000000u) >> 13));
}

}  // namespace antipode
