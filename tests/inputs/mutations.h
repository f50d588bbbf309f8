// What happens to files: they are cut off, and bits turn over.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace antipode::test {

using Bytes = std::vector<uint8_t>;

Bytes readBytes(const std::string& path);

/// `source` with 1 … 3 bits turned over; the same seed gives the same bytes.
Bytes withFlippedBits(const Bytes& source, uint64_t seed);

}  // namespace antipode::test
