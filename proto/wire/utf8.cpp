#include "proto/wire/utf8.h"

#include <cstdint>
#include <string_view>

namespace antipode::wire {
namespace {

bool isContinuation(uint8_t byte) { return (byte & 0xC0) == 0x80; }

/// Bytes of the character that the text begins with; 0 where it is none. RFC 3629, section 4.
size_t characterBytes(std::string_view text) {
    const auto at = [&](size_t i) { return i < text.size() ? uint8_t(text[i]) : uint8_t(0); };
    const uint8_t first = at(0), second = at(1);
    if (first < 0x80) return 1;
    if (first < 0xC2 || first > 0xF4) return 0;  // continuations, overlong forms, beyond U+10FFFF
    const bool secondFits = isContinuation(second) && (first != 0xE0 || second >= 0xA0) &&
                            (first != 0xED || second < 0xA0) && (first != 0xF0 || second >= 0x90) &&
                            (first != 0xF4 || second < 0x90);
    if (!secondFits) return 0;
    const size_t bytes = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    for (size_t i = 2; i < bytes; ++i)
        if (!isContinuation(at(i))) return 0;
    return bytes;
}

bool isUtf8(std::string_view text) {
    while (!text.empty()) {
        const size_t bytes = characterBytes(text);
        if (bytes == 0) return false;
        text.remove_prefix(bytes);
    }
    return true;
}

}  // namespace

void makeUtf8(std::string& text) {
    if (isUtf8(text)) return;
    for (char& c : text)
        if (uint8_t(c) >= 0x80) c = '?';
}

}  // namespace antipode::wire
