#include "server/blob_file.h"

#include <algorithm>
#include <cerrno>
#include <charconv>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "renderengine/error.h"
#include "renderengine/io/descriptor.h"
#include "renderengine/io/text.h"

namespace antipode {
namespace {

constexpr size_t hashDigits = 64;
constexpr std::string_view partEnding = ".part";

/// A folder of the cache's, in place of a link, if one is there. The errno of what failed, or 0.
int makePrivate(const std::filesystem::path& folder) {
    struct stat status = {};
    const bool link = ::lstat(folder.c_str(), &status) == 0 && S_ISLNK(status.st_mode);
    if (link && ::unlink(folder.c_str()) != 0) return errno;
    return ::mkdir(folder.c_str(), 0700) == 0 || errno == EEXIST ? 0 : errno;
}

}  // namespace

std::string blobKey(const farm::BlobRef& blob) {
    if (blob.sha256().size() * 2 != hashDigits || blob.size() == 0)
        throw Error(ErrorCode::Usage, "A blob needs a hash of 32 bytes and a size of at least 1.");
    return hexadecimal(blob.sha256()) + "-" + std::to_string(blob.size());
}

std::filesystem::path blobPath(const std::string& key, bool part) {
    return std::filesystem::path(key.substr(0, 2)) / (part ? key + std::string(partEnding) : key);
}

std::optional<BlobFile> parseBlobName(const std::string& name) {
    BlobFile file;
    file.part = name.ends_with(partEnding);
    file.key = name.substr(0, name.size() - (file.part ? partEnding.size() : 0));
    if (file.key.size() < hashDigits + 2 || file.key[hashDigits] != '-') return {};
    file.sha256 = file.key.substr(0, hashDigits);
    if (file.sha256.find_first_not_of("0123456789abcdef") != std::string::npos) return {};
    const char* const end = file.key.data() + file.key.size();
    const auto parsed = std::from_chars(file.key.data() + hashDigits + 1, end, file.size);
    if (parsed.ec != std::errc() || parsed.ptr != end || file.size == 0) return {};
    // Leading zeros would make two names for one blob.
    if (file.key[hashDigits + 1] == '0') return {};
    return file;
}

std::optional<std::string> readWholeFile(const std::filesystem::path& path, uint64_t size) {
    const Descriptor file = openFile(path, O_RDONLY | O_NOFOLLOW);
    struct stat status = {};
    if (!file || ::fstat(file.get(), &status) != 0 || uint64_t(status.st_size) != size) return {};
    std::string bytes(size, '\0');
    if (readFully(file, bytes.data(), bytes.size()) != bytes.size()) return {};
    return bytes;
}

int writeAt(const std::filesystem::path& path, uint64_t offset, std::string_view bytes) {
    if (const int failure = makePrivate(path.parent_path())) return failure;
    const Descriptor file = openFile(path, O_WRONLY | O_NOFOLLOW | (offset == 0 ? O_CREAT : 0), 0600);
    const int failure = file ? writeFullyAt(file, offset, bytes) : errno;
    if (failure == 0) return 0;
    std::error_code ignored;
    if (offset == 0 || !file || ::ftruncate(file.get(), off_t(offset)) != 0) std::filesystem::remove(path, ignored);
    return failure;
}

}  // namespace antipode
