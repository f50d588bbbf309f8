// Bytes as text: digits, and what others wrote on its way to people and over the wire.
#pragma once

#include <string>
#include <string_view>

namespace antipode {

/// Two lower-case digits a byte.
std::string hexadecimal(std::string_view bytes);
/// The bytes of pairs of digits; Error(Input) for anything else.
std::string fromHexadecimal(std::string_view digits);

/// Of ASCII: what moves the cursor instead of showing something.
constexpr bool isControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

bool isUtf8(std::string_view text);

/// UTF-8 without control characters: text that is no UTF-8 is taken for Latin-1, control characters become '?', and
/// what is longer than `longest` bytes ends in an ellipsis.
std::string readableText(std::string_view text, size_t longest = 500);

}  // namespace antipode
