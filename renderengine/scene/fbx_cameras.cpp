#include "scene/fbx_cameras.h"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "renderengine/io/files.h"

namespace antipode {
namespace {

constexpr std::string_view kProperty = "CameraProjectionType";

/// The property's value in a text file: after four more strings, in quotes.
bool isParallelText(std::string_view line) {
    const size_t value = line.find_last_of(", \t");
    return value != line.npos && line.substr(value + 1) == "1";
}

/// In a binary file: 'S', length and bytes of "enum", of what follows it and of the flags, then 'I' and the number.
bool isParallelBinary(std::string_view rest) {
    size_t at = 0;
    for (int strings = 0; strings < 3; ++strings) {
        if (rest.size() < at + 5 || rest[at] != 'S') return false;
        at += 5 + uint8_t(rest[at + 1]);  // all are short
    }
    return rest.size() >= at + 5 && rest.substr(at, 5) == std::string_view("I\1\0\0\0", 5);
}

}  // namespace

size_t countParallelFbxCameras(const std::string& path) {
    const std::vector<uint8_t> bytes = readFileBytes(path);
    const std::string_view file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const bool isBinary = file.starts_with("Kaydara FBX Binary");
    size_t count = 0;
    for (size_t at = file.find(kProperty); at != file.npos; at = file.find(kProperty, at)) {
        at += kProperty.size();
        const std::string_view rest = file.substr(at);
        count += isBinary ? isParallelBinary(rest) : isParallelText(rest.substr(0, rest.find_first_of("\r\n")));
    }
    return count;
}

}  // namespace antipode
