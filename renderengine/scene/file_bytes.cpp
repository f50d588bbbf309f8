#include "scene/file_bytes.h"

#include <filesystem>
#include <fstream>

#include "renderengine/error.h"

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
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) throw Error(ErrorCode::Input, "'" + path + "' cannot be opened");
    std::vector<uint8_t> bytes(size_t(file.tellg()));
    file.seekg(0);
    if (!file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size())))
        throw Error(ErrorCode::Input, "'" + path + "' cannot be read to its end");
    return bytes;
}

}  // namespace antipode
