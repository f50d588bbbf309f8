// Whole files: read into memory, and written so that they appear complete or not at all.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace antipode {

/// Follows links; false for folders, pipes, devices and names that cannot be looked up.
bool isRegularFile(const std::string& path);

/// Throws Error(Input) naming the path where it is no regular file. Pipes and devices may never end.
void requireRegularFile(const std::string& path);

/// Throws Error(Input) naming the path where it is not a regular file that can be read to its end.
std::vector<uint8_t> readFileBytes(const std::string& path);

/// Throws Error(Output) unless a file can be created or replaced at `path`; leaves nothing behind.
void checkWritable(const std::string& path);
/// Writes the bytes as the file's whole content, complete or not at all: temporary file in the same folder, fsync,
/// rename. Throws Error(Output).
void writeFileAtomically(const std::string& path, std::string_view bytes);
/// The same for content that comes in pieces: `write` is called with a function that appends to the file. What was at
/// `path` before is kept as `path` + `previousSuffix`, in place of what was there. Killed at any instant it leaves the
/// old or the new content whole at `path`; where the file system has no hard links, at one of the two names.
void writeFileAtomically(const std::string& path, const std::string& previousSuffix,
                         const std::function<void(const std::function<void(std::string_view)>& append)>& write);

}  // namespace antipode
