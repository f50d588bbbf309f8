// Numbers as people read them.
#pragma once

#include <cstdint>
#include <string>

namespace antipode {

/// Three significant digits and a decimal prefix: 1234567 → "1.23 M". For numbers ≥ 0.
std::string shortCount(double number);
/// "4.2 s" below a minute, then "3:07", then "1:02:03".
std::string duration(double seconds);
/// Bytes with a binary prefix: 1536 → "1.5 KiB".
std::string byteSize(uint64_t bytes);

}  // namespace antipode
