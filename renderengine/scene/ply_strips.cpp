#include "scene/ply_strips.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string_view>
#include <vector>

#include "renderengine/error.h"
#include "renderengine/io/files.h"

namespace antipode {
namespace {

enum class Encoding { Ascii, LittleEndian, BigEndian };

struct Element {
    std::string name;
    uint64_t count = 0;
    uint64_t bytes = 0;  ///< of one in a binary file, lists aside
    bool hasList = false;
    size_t properties = 0;
    std::string listCount, listItem;  ///< types of the last list
};

struct Header {
    Encoding encoding = Encoding::Ascii;
    std::vector<Element> elements;
    size_t size = 0;         ///< bytes, with the line of end_header
    size_t stripsBegin = 0;  ///< where the lines of the strips begin; they end at end_header
};

[[noreturn]] void refuse(const std::string& why) {
    throw Error(ErrorCode::Input, "its triangle strips cannot be read: " + why + "; save it with faces instead");
}

size_t sizeOf(std::string_view type) {
    if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
    if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
    if (type == "int" || type == "uint" || type == "int32" || type == "uint32") return 4;
    if (type == "float" || type == "float32") return 4;
    if (type == "double" || type == "float64") return 8;
    refuse("'" + std::string(type) + "' is no type of a property");
}

/// Nothing where the text has no end_header.
std::optional<Header> parseHeader(std::string_view file) {
    Header header;
    for (size_t at = 0; at < file.size();) {
        const size_t end = file.find('\n', at);
        if (end == std::string_view::npos) return std::nullopt;
        std::istringstream line{std::string(file.substr(at, end - at))};
        std::string word;
        line >> word;
        if (word == "end_header") {
            header.size = end + 1;
            return header;
        }
        if (word == "format") {
            line >> word;
            header.encoding = word == "binary_big_endian"      ? Encoding::BigEndian
                              : word == "binary_little_endian" ? Encoding::LittleEndian
                                                               : Encoding::Ascii;
        } else if (word == "element") {
            Element& element = header.elements.emplace_back();
            line >> element.name >> element.count;
            if (element.name == "tristrips") header.stripsBegin = at;
        } else if (word == "property" && !header.elements.empty()) {
            Element& element = header.elements.back();
            ++element.properties;
            line >> word;
            if (word == "list")
                element.hasList = bool(line >> element.listCount >> element.listItem);
            else
                element.bytes += sizeOf(word);
        }
        at = end + 1;
    }
    return std::nullopt;
}

/// Whole numbers after `at`, in the file's encoding.
class Numbers {
public:
    Numbers(std::string_view file, size_t at, Encoding encoding) : file_(file), at_(at), encoding_(encoding) {}

    int64_t next(size_t size) {
        if (encoding_ == Encoding::Ascii) {
            while (at_ < file_.size() && std::string_view(" \t\r\n").find(file_[at_]) != std::string_view::npos) ++at_;
            int64_t value = 0;
            const auto [end, error] = std::from_chars(file_.data() + at_, file_.data() + file_.size(), value);
            if (error != std::errc()) refuse("a number is missing");
            at_ = size_t(end - file_.data());
            return value;
        }
        if (file_.size() - at_ < size) refuse("the file ends too early");
        std::array<uint8_t, 8> bytes{};
        for (size_t i = 0; i < size; ++i)
            bytes[encoding_ == Encoding::LittleEndian ? i : size - 1 - i] = uint8_t(file_[at_ + i]);
        at_ += size;
        uint64_t value = 0;
        for (size_t i = 0; i < 8; ++i) value |= uint64_t(bytes[i]) << 8 * i;
        const unsigned unused = 64 - 8 * unsigned(size);
        return int64_t(value << unused) >> unused;
    }

private:
    std::string_view file_;
    size_t at_;
    Encoding encoding_;
};

/// Faces of three corners each, as an element's data.
class Faces {
public:
    explicit Faces(Encoding encoding) : encoding_(encoding) {}

    void add(int64_t a, int64_t b, int64_t c) {
        if (a == b || b == c || c == a) return;
        ++count;
        if (encoding_ == Encoding::Ascii) {
            data += "3 " + std::to_string(a) + ' ' + std::to_string(b) + ' ' + std::to_string(c) + '\n';
            return;
        }
        data += '\3';
        for (const int64_t corner : {a, b, c})
            for (int i = 0; i < 4; ++i)
                data += char(uint32_t(corner) >> 8 * (encoding_ == Encoding::LittleEndian ? i : 3 - i));
    }

    uint64_t count = 0;
    std::string data;

private:
    Encoding encoding_;
};

/// Where the data of the strips begin: after so many lines, or bytes.
size_t beginOfStrips(const Header& header, std::string_view file) {
    size_t at = header.size;
    for (const Element& element : header.elements) {
        if (element.name == "tristrips") break;
        if (header.encoding == Encoding::Ascii) {
            for (uint64_t i = 0; i < element.count; ++i) {
                const size_t end = file.find('\n', at);
                if (end == std::string_view::npos) refuse("the file ends too early");
                at = end + 1;
            }
        } else {
            if (element.hasList) refuse("they follow a list");
            if (element.bytes > 0 && element.count > (file.size() - at) / element.bytes)
                refuse("the file ends too early");
            at += element.count * element.bytes;
        }
    }
    return at;
}

}  // namespace

std::optional<std::string> plyWithFaces(const std::string& path) {
    const std::vector<uint8_t> bytes = readFileBytes(path);
    const std::string_view file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (file.substr(0, 1 << 16).find("\nelement tristrips ") == std::string_view::npos) return std::nullopt;
    const std::optional<Header> header = parseHeader(file);
    if (!header || header->stripsBegin == 0) return std::nullopt;
    const Element& strips = header->elements.back();
    if (strips.name != "tristrips") refuse("they are not the last element");
    if (!strips.hasList || strips.properties != 1) refuse("they are not a list of vertices each");

    const size_t begin = beginOfStrips(*header, file), countSize = sizeOf(strips.listCount),
                 itemSize = sizeOf(strips.listItem);
    Numbers numbers(file, begin, header->encoding);
    Faces faces(header->encoding);
    for (uint64_t strip = 0; strip < strips.count; ++strip) {
        std::array<int64_t, 2> last{};
        uint64_t length = 0;  // since the last -1
        for (int64_t left = numbers.next(countSize); left > 0; --left) {
            const int64_t vertex = numbers.next(itemSize);
            if (vertex < 0) {
                length = 0;
                continue;
            }
            if (length >= 2)
                length % 2 == 0 ? faces.add(last[0], last[1], vertex) : faces.add(last[1], last[0], vertex);
            last = {last[1], vertex};
            ++length;
        }
    }
    return std::string(file.substr(0, header->stripsBegin)) + "element face " + std::to_string(faces.count) +
           "\nproperty list uchar int vertex_indices\nend_header\n" +
           std::string(file.substr(header->size, begin - header->size)) + faces.data;
}

}  // namespace antipode
