// Whole files in memory.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace antipode {

/// Throws Error(Input) naming the path where it is not a regular file that can be read to its end.
std::vector<uint8_t> readFileBytes(const std::string& path);

}  // namespace antipode
