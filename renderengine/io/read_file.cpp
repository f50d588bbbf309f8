#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>

#include "renderengine/error.h"
#include "renderengine/io/descriptor.h"
#include "renderengine/io/files.h"

namespace antipode {

bool isRegularFile(const std::string& path) {
    std::error_code code;
    return std::filesystem::is_regular_file(path, code);
}

void requireRegularFile(const std::string& path) {
    if (!isRegularFile(path)) throw Error(ErrorCode::Input, "'" + path + "' does not exist or is not a file");
}

std::vector<uint8_t> readFileBytes(const std::string& path) {
    requireRegularFile(path);
    const Descriptor file = openFile(path, O_RDONLY);
    struct stat status {};
    if (!file || ::fstat(file.get(), &status) != 0) throw Error(ErrorCode::Input, "'" + path + "' cannot be opened");
    std::vector<uint8_t> bytes(size_t(status.st_size));
    if (readFully(file, reinterpret_cast<char*>(bytes.data()), bytes.size()) != bytes.size())
        throw Error(ErrorCode::Input, "'" + path + "' cannot be read to its end");
    return bytes;
}

}  // namespace antipode
