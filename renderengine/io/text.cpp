#include "renderengine/io/text.h"

#include <charconv>
#include <cstdint>

#include "renderengine/error.h"

namespace antipode {
namespace {

/// The length of the UTF-8 sequence at the start of `text` (RFC 3629); 0 where there is none.
size_t sequenceLength(std::string_view text) {
    const auto byte = [&](size_t i) { return i < text.size() ? uint8_t(text[i]) : uint8_t(0); };
    const uint8_t first = byte(0), second = byte(1);
    if (first < 0x80) return 1;
    const size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    for (size_t i = 1; i < length; ++i)
        if (byte(i) >> 6 != 2) return 0;
    const bool overlong = first < 0xc2 || (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
    const bool surrogate = first == 0xed && second > 0x9f;
    const bool beyond = first > 0xf4 || (first == 0xf4 && second > 0x8f);
    return overlong || surrogate || beyond ? 0 : length;
}

std::string fromLatin1(std::string_view text) {
    std::string utf8;
    for (const char c : text) {
        const auto code = uint8_t(c);
        if (code < 0x80)
            utf8.push_back(c);
        else
            utf8.append({char(0xc0 | code >> 6), char(0x80 | (code & 0x3f))});
    }
    return utf8;
}

}  // namespace

std::string hexadecimal(std::string_view bytes) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    text.reserve(2 * bytes.size());
    for (const unsigned char byte : bytes) {
        text.push_back(digits[byte >> 4]);
        text.push_back(digits[byte & 15]);
    }
    return text;
}

std::string fromHexadecimal(std::string_view digits) {
    std::string bytes;
    bytes.reserve(digits.size() / 2);
    for (size_t i = 0; i < digits.size(); i += 2) {
        const std::string_view pair = digits.substr(i, 2);
        uint8_t value = 0;
        const auto parsed = std::from_chars(pair.data(), pair.data() + pair.size(), value, 16);
        if (pair.size() != 2 || parsed.ec != std::errc() || parsed.ptr != pair.data() + 2)
            throw Error(ErrorCode::Input, "'" + readableText(digits) + "' is not pairs of hexadecimal digits");
        bytes.push_back(char(value));
    }
    return bytes;
}

bool isUtf8(std::string_view text) {
    while (!text.empty()) {
        const size_t length = sequenceLength(text);
        if (length == 0) return false;
        text.remove_prefix(length);
    }
    return true;
}

std::string readableText(std::string_view text, size_t longest) {
    std::string utf8 = isUtf8(text) ? std::string(text) : fromLatin1(text);
    for (char& c : utf8)
        if (isControl(c)) c = '?';
    if (utf8.size() <= longest) return utf8;
    size_t end = longest;
    while (end > 0 && uint8_t(utf8[end]) >> 6 == 2) --end;  // not in the middle of a sequence
    return utf8.substr(0, end) + "…";
}

}  // namespace antipode
