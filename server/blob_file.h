// The files of a scene cache: their names, and what is done with their bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "proto/farm.pb.h"

namespace antipode {

/// Hash and size in one string: "<64 hexadecimal digits>-<size>". A blob that is announced with a wrong size is thereby
/// another one, and never completed. Throws Error(Usage) unless the hash has 32 bytes and the size is not 0.
std::string blobKey(const farm::BlobRef& blob);

struct BlobFile {
    std::string key;
    std::string sha256;  ///< hexadecimal
    uint64_t size = 0;   ///< of the whole blob
    bool part = false;
};

/// Where a blob or its part is kept, relative to the cache's folder: "ab/abcd…-123", "ab/abcd…-123.part".
std::filesystem::path blobPath(const std::string& key, bool part);
/// The reverse for a file's name alone; nothing for a name that blobPath() does not make.
std::optional<BlobFile> parseBlobName(const std::string& name);

/// A file of exactly this size; nothing where it is of another or cannot be read.
std::optional<std::string> readWholeFile(const std::filesystem::path& path, uint64_t size);

/// Writes at an offset into a file, which is made, with its folder, where the offset is 0: both for this user alone. No
/// link is followed. The errno of what failed, or 0; the file then has `offset` bytes or is gone.
int writeAt(const std::filesystem::path& path, uint64_t offset, std::string_view bytes);

}  // namespace antipode
