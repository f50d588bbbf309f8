#include "terminal/text.h"

#include <cmath>
#include <cstdio>

namespace antipode {
namespace {

template <class... Values>
std::string formatted(const char* format, Values... values) {
    char text[64];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

}  // namespace

std::string shortCount(double number) {
    static const char* const prefixes[] = {"", " k", " M", " G", " T", " P", " E"};
    size_t prefix = 0;
    // 999.5 is where three digits round up to 1000.
    while (number >= 999.5 && prefix + 1 < std::size(prefixes)) {
        number /= 1000;
        ++prefix;
    }
    const bool whole = number >= 99.95 || number == std::floor(number);
    const char* format = whole ? "%.0f%s" : number >= 9.995 ? "%.1f%s" : "%.2f%s";
    return formatted(format, number, prefixes[prefix]);
}

std::string duration(double seconds) {
    if (seconds < 59.95) return formatted("%.1f s", seconds);
    const auto whole = static_cast<unsigned long long>(std::llround(seconds));
    if (whole < 3600) return formatted("%llu:%02llu", whole / 60, whole % 60);
    return formatted("%llu:%02llu:%02llu", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string byteSize(uint64_t bytes) {
    static const char* const units[] = {"B", "KiB", "MiB", "GiB", "TiB"};
    size_t unit = 0;
    double size = double(bytes);
    while (size >= 1023.95 && unit + 1 < std::size(units)) {
        size /= 1024;
        ++unit;
    }
    return formatted(unit == 0 ? "%.0f %s" : "%.1f %s", size, units[unit]);
}

}  // namespace antipode
