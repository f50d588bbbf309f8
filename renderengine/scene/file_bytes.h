// Whole files in memory.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace antipode {

/// Follows links; false for folders, pipes, devices and names that cannot be looked up.
bool isRegularFile(const std::string& path);

/// Throws Error(Input) naming the path where it is no regular file. Pipes and devices may never end.
void requireRegularFile(const std::string& path);

/// Throws Error(Input) naming the path where it is not a regular file that can be read to its end.
std::vector<uint8_t> readFileBytes(const std::string& path);

}  // namespace antipode
