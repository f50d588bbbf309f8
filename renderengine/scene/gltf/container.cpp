#include "scene/gltf/container.h"

#include <array>
#include <cstdlib>

#include "renderengine/io/files.h"

namespace antipode::gltf {
namespace {

constexpr uint32_t kGlbMagic = 0x46546c67, kJsonChunk = 0x4e4f534a;
constexpr size_t kHeaderSize = 12, kChunkHeaderSize = 8;

uint32_t readU32(const std::vector<uint8_t>& bytes, size_t at) {
    return bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 | uint32_t(bytes[at + 3]) << 24;
}

/// Where JSON and BIN chunk lie in a file.
struct Layout {
    size_t jsonBegin = 0, jsonEnd = 0;
    size_t binaryBegin = 0, binarySize = 0;
};

Layout layoutOf(const std::vector<uint8_t>& bytes) {
    if (bytes.size() < 4 || readU32(bytes, 0) != kGlbMagic) return {0, bytes.size(), 0, 0};
    if (bytes.size() < kHeaderSize + kChunkHeaderSize) fail("it is cut short");
    if (readU32(bytes, 4) == 1) throw FirstVersion();
    if (readU32(bytes, 4) != 2) fail("its container version is not 2");
    if (readU32(bytes, 8) > bytes.size()) fail("it is cut short");
    const size_t begin = kHeaderSize + kChunkHeaderSize, size = readU32(bytes, kHeaderSize);
    if (readU32(bytes, kHeaderSize + 4) != kJsonChunk) fail("its first chunk is not JSON");
    if (size > bytes.size() - begin) fail("its JSON is cut short");
    Layout layout{begin, begin + size, 0, 0};
    if (bytes.size() - layout.jsonEnd >= kChunkHeaderSize) {
        layout.binarySize = readU32(bytes, layout.jsonEnd);
        layout.binaryBegin = layout.jsonEnd + kChunkHeaderSize;
        if (layout.binarySize > bytes.size() - layout.binaryBegin) fail("its buffer is cut short");
    }
    return layout;
}

/// Copying and destroying JSON is recursive. Looked at in the text, since the parser's own callback takes quadratic
/// time.
void refuseDeepNesting(std::string_view text) {
    constexpr int kDeepest = 100;
    int depth = 0;
    bool inString = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString && c == '\\')
            ++i;
        else if (c == '"')
            inString = !inString;
        else if (!inString && (c == '[' || c == '{') && ++depth > kDeepest)
            fail("its JSON is nested too deeply");
        else if (!inString && (c == ']' || c == '}'))
            --depth;
    }
}

std::array<int, 256> base64Digits() {
    std::array<int, 256> digits;
    digits.fill(-1);
    int value = 0;
    for (char c : std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"))
        digits[uint8_t(c)] = value++;
    return digits;
}

/// Some writers of glTF 1.0 give a number.
std::string versionOf(const json& document) {
    if (!document.is_object()) return "";
    const json& asset = object(document, "asset");
    const auto found = asset.find("version");
    if (found == asset.end()) return "";
    return found->is_string() ? found->get<std::string>() : found->dump();
}

}  // namespace

Container readContainer(const std::string& path) {
    std::vector<uint8_t> bytes = readFileBytes(path);
    const Layout layout = layoutOf(bytes);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()) + layout.jsonBegin,
                                layout.jsonEnd - layout.jsonBegin);
    refuseDeepNesting(text);
    Container container;
    container.document = json::parse(text);
    const std::string version = versionOf(container.document);
    if (version.starts_with("1")) throw FirstVersion();
    if (!version.starts_with("2")) fail("only version 2.0 is supported");
    const auto begin = bytes.begin() + std::ptrdiff_t(layout.binaryBegin);
    container.chunk.assign(begin, begin + std::ptrdiff_t(layout.binarySize));
    return container;
}

std::string decodeUri(const std::string& uri) {
    std::string text;
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size()) {
            text.push_back(char(std::strtol(uri.substr(i + 1, 2).c_str(), nullptr, 16)));
            i += 2;
        } else {
            text.push_back(uri[i]);
        }
    }
    return text;
}

std::vector<uint8_t> decodeDataUri(std::string_view uri) {
    static const std::array<int, 256> digits = base64Digits();
    const std::string_view text = uri.substr(uri.find(',') + 1);
    std::vector<uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3);
    uint32_t bits = 0;
    int count = 0;
    for (char c : text) {
        if (c == '=') break;  // padding
        const int digit = digits[uint8_t(c)];
        if (digit < 0) fail("a data URI is not base64");
        bits = bits << 6 | uint32_t(digit);
        count += 6;
        if (count >= 8) bytes.push_back(uint8_t(bits >> (count -= 8)));
    }
    return bytes;
}

}  // namespace antipode::gltf
