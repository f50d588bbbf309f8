// 8-bit RGB as a PNG file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace antipode {

/// The file's bytes. `rgb`: sRGB, row-major from the top, 3·width·height. Throws Error(Output).
std::string pngBytes(uint32_t width, uint32_t height, const std::vector<uint8_t>& rgb);

}  // namespace antipode
