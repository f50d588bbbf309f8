#include "proto/wire/secret_strength.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace antipode::wire {
namespace {

/// Shannon's, of `size` bytes that `at` gives, by their own frequencies.
template <class At>
double entropy(size_t size, const At& at) {
    std::array<size_t, 256> counts{};
    for (size_t i = 0; i < size; ++i) ++counts[at(i)];
    double bits = 0;
    for (const size_t count : counts)
        if (count > 0) bits += double(count) * std::log2(double(size) / double(count));
    return bits;
}

/// The shortest beginning of which the text is a repetition.
std::string_view period(std::string_view text) {
    for (size_t length = 1; length < text.size(); ++length)
        if (text.substr(length) == text.substr(0, text.size() - length)) return text.substr(0, length);
    return text;
}

}  // namespace

double estimatedBits(std::string_view secret) {
    const std::string_view own = period(secret);
    if (own.empty()) return 0;
    const auto byte = [&](size_t i) { return static_cast<unsigned char>(own[i]); };
    const auto step = [&](size_t i) { return static_cast<unsigned char>(byte(i + 1) - byte(i)); };
    return std::min(entropy(own.size(), byte), 8 + entropy(own.size() - 1, step));
}

}  // namespace antipode::wire
