#include "server/blob_file.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>

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

void writeAt(const std::filesystem::path& path, uint64_t offset, std::string_view bytes) {
    std::error_code ignored;
    std::filesystem::create_directory(path.parent_path(), ignored);  // opening says what is wrong, if something is
    const Descriptor file = openFile(path, O_WRONLY | O_CREAT | O_NOFOLLOW);
    const int failure = file ? writeFullyAt(file, offset, bytes) : errno;
    if (failure == 0) return;
    if (offset == 0 || !file || ::ftruncate(file.get(), off_t(offset)) != 0) std::filesystem::remove(path, ignored);
    throw Error(ErrorCode::Output, "Cannot write '" + path.string() + "': " + std::strerror(failure) + ".");
}

}  // namespace antipode
