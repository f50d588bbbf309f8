#include "scene/mtl_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace antipode {
namespace {

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

constexpr std::string_view kSpaces = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
    const size_t begin = text.find_first_not_of(kSpaces);
    return begin == text.npos ? std::string_view() : text.substr(begin, text.find_last_not_of(kSpaces) - begin + 1);
}

/// Takes the first word off the text.
std::string_view takeWord(std::string_view& text) {
    text = trimmed(text);
    const std::string_view word = text.substr(0, text.find_first_of(kSpaces));
    text = trimmed(text.substr(word.size()));
    return word;
}

std::optional<float> toNumber(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    float value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return {};
    return value;
}

/// As many numbers as stand at the beginning of the text, which loses them.
std::vector<float> takeNumbers(std::string_view& text, size_t most) {
    std::vector<float> numbers;
    while (numbers.size() < most) {
        std::string_view rest = text;
        const std::optional<float> number = toNumber(takeWord(rest));
        if (!number) break;
        numbers.push_back(*number);
        text = rest;
    }
    return numbers;
}

/// One number stands for three. "xyz" and "spectral" colours are not RGB.
std::optional<Vec3f> readColor(std::string_view text) {
    const std::vector<float> numbers = takeNumbers(text, 3);
    if (numbers.size() == 1) return Vec3f(numbers[0]);
    if (numbers.size() == 3) return Vec3f(numbers[0], numbers[1], numbers[2]);
    return {};
}

void readPair(std::string_view& text, std::array<float, 2>& pair) {
    const std::vector<float> numbers = takeNumbers(text, 3);
    for (size_t i = 0; i < std::min<size_t>(numbers.size(), 2); ++i) pair[i] = numbers[i];
}

/// Options, then the file's name, which may hold spaces.
MtlMap readMap(std::string_view text, const std::string& statement, MtlMaterial& material) {
    MtlMap map;
    const auto notRead = [&](const std::string& option) { material.notRead[statement + " " + option] = true; };
    while (text.starts_with('-')) {
        std::string_view rest = text;
        const std::string option = lowerCase(std::string(takeWord(rest)));
        if (option == "-s") {
            readPair(rest, map.scale);
        } else if (option == "-o") {
            readPair(rest, map.offset);
        } else if (option == "-clamp") {
            map.clamp = takeWord(rest) == "on";
        } else if (option == "-bm") {
            if (const auto numbers = takeNumbers(rest, 1); !numbers.empty()) map.bumpMultiplier = numbers[0];
        } else if (option == "-imfchan") {
            if (const std::string_view word = takeWord(rest); !word.empty())
                map.channel = char(std::tolower(static_cast<unsigned char>(word[0])));
        } else if (option == "-mm") {
            if (takeNumbers(rest, 2) != std::vector<float>{0, 1}) notRead(option);
        } else if (option == "-t") {
            const std::vector<float> numbers = takeNumbers(rest, 3);
            if (std::any_of(numbers.begin(), numbers.end(), [](float v) { return v != 0; })) notRead(option);
        } else if (option == "-boost" || option == "-texres") {
            takeNumbers(rest, 1);
        } else if (option == "-blendu" || option == "-blendv" || option == "-type" || option == "-colorspace") {
            takeWord(rest);
        } else if (option == "-cc") {
            if (takeWord(rest) == "on") notRead(option);
        } else {
            break;  // a name that begins so
        }
        text = rest;
    }
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
    map.file = text;
    return map;
}

/// By its lower-case name, where that is another than the usual one.
std::string usualName(const std::string& statement) {
    if (statement == "map_bump") return "bump";
    if (statement == "map_tr") return "map_d";
    if (statement == "map_kn" || statement == "map_norm") return "norm";
    return statement;
}

void readStatement(const std::string& written, std::string_view rest, MtlMaterial& material) {
    const std::string statement = usualName(lowerCase(written));
    if (statement == "kd" || statement == "ks" || statement == "ke" || statement == "tf") {
        if (const auto color = readColor(rest))
            material.colors[statement] = *color;
        else
            material.notRead[written + " " + std::string(rest.substr(0, 20))] = true;
    } else if (statement == "d" || statement == "tr") {
        if (rest.starts_with("-halo")) material.notRead["d -halo"] = true;
        if (const auto value = toNumber(takeWord(rest)))
            // Exporters that write both disagree about Tr; d is the specification's.
            if (statement == "d" || !material.numbers.contains("d"))
                material.numbers["d"] = statement == "d" ? *value : 1 - *value;
    } else if (statement == "ns" || statement == "ni" || statement == "illum" || statement == "pr" ||
               statement == "pm" || statement == "ps" || statement == "pc" || statement == "pcr" ||
               statement == "aniso" || statement == "anisor") {
        if (const auto value = toNumber(takeWord(rest))) material.numbers[statement] = *value;
    } else if (statement.starts_with("map_") || statement == "bump" || statement == "norm" || statement == "disp" ||
               statement == "decal" || statement == "refl") {
        // Ambient light is nothing that light transport knows, nor whether a renderer should smooth its edges.
        if (statement == "map_ka" || statement == "map_aat") return;
        material.maps[statement] = readMap(rest, written, material);
    } else if (statement != "ka" && statement != "sharpness") {
        material.notRead[written] = true;
    }
}

}  // namespace

std::optional<Vec3f> MtlMaterial::color(const std::string& statement) const {
    const auto found = colors.find(statement);
    return found == colors.end() ? std::nullopt : std::optional(found->second);
}

std::optional<float> MtlMaterial::number(const std::string& statement) const {
    const auto found = numbers.find(statement);
    return found == numbers.end() ? std::nullopt : std::optional(found->second);
}

const MtlMap& MtlMaterial::map(const std::string& statement) const {
    static const MtlMap none;
    const auto found = maps.find(statement);
    return found == maps.end() ? none : found->second;
}

std::map<std::string, MtlMaterial> parseMtl(std::string_view text) {
    std::map<std::string, MtlMaterial> materials;
    MtlMaterial* current = nullptr;
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    while (!text.empty()) {
        const size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        text.remove_prefix(end == text.npos ? text.size() : end + 1);
        line = trimmed(line);
        if (line.empty() || line[0] == '#') continue;
        const std::string word(takeWord(line));
        if (lowerCase(word) == "newmtl")
            current = &materials[std::string(line)];
        else if (current)
            readStatement(word, line, *current);
    }
    return materials;
}

}  // namespace antipode
