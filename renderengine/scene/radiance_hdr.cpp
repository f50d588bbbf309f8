#include "scene/radiance_hdr.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "renderengine/error.h"
#include "scene/image_size.h"

namespace antipode {
namespace {

using Rgbe = std::array<uint8_t, 4>;

/// Reads forward through the data and refuses to step past their end.
class Reader {
public:
    Reader(std::span<const uint8_t> data, const std::string& name) : data_(data), name_(name) {}

    [[noreturn]] void fail(const std::string& why) const {
        throw Error(ErrorCode::Input, "Radiance picture '" + name_ + "' cannot be read: " + why);
    }
    size_t remaining() const { return data_.size() - at_; }
    uint8_t byte() {
        if (at_ == data_.size()) fail("it is cut short");
        return data_[at_++];
    }
    Rgbe pixel() {
        Rgbe p;
        for (uint8_t& c : p) c = byte();
        return p;
    }
    /// The next four bytes without taking them; zeros past the end.
    Rgbe peek() const {
        Rgbe p{};
        for (size_t i = 0; i < 4 && at_ + i < data_.size(); ++i) p[i] = data_[at_ + i];
        return p;
    }
    std::string line() {
        std::string text;
        for (uint8_t c = byte(); c != '\n'; c = byte()) text.push_back(char(c));
        if (text.ends_with('\r')) text.pop_back();  // written under Windows
        return text;
    }

private:
    std::span<const uint8_t> data_;
    std::string name_;
    size_t at_ = 0;
};

/// Each component apart: a count above 128 repeats one value, any other is followed by as many values.
void readComponentRuns(Reader& reader, std::vector<Rgbe>& row) {
    for (size_t component = 0; component < 4; ++component) {
        for (size_t x = 0; x < row.size();) {
            const uint8_t code = reader.byte();
            const bool repeats = code > 128;
            const size_t count = repeats ? code - 128u : code;
            if (count == 0 || x + count > row.size()) reader.fail("a run leaves its row");
            const uint8_t value = repeats ? reader.byte() : 0;
            for (size_t i = 0; i < count; ++i) row[x++][component] = repeats ? value : reader.byte();
        }
    }
}

/// Whole pixels; (1,1,1,n) repeats the last one n times, and further such pixels count in higher bytes.
void readPixelRuns(Reader& reader, std::vector<Rgbe>& row) {
    unsigned shift = 0;
    for (size_t x = 0; x < row.size();) {
        const Rgbe p = reader.pixel();
        if (p[0] == 1 && p[1] == 1 && p[2] == 1) {
            const size_t count = shift < 32 ? size_t(p[3]) << shift : row.size() + 1;
            if (x == 0 || x + count > row.size()) reader.fail("a run leaves its row");
            for (size_t i = 0; i < count; ++i, ++x) row[x] = row[x - 1];
            shift += 8;
        } else {
            row[x++] = p;
            shift = 0;
        }
    }
}

void readRow(Reader& reader, std::vector<Rgbe>& row) {
    const Rgbe head = reader.peek();
    const bool byComponent = row.size() >= 8 && row.size() < 32768 && head[0] == 2 && head[1] == 2 && head[2] < 128;
    if (!byComponent) return readPixelRuns(reader, row);
    reader.pixel();
    if (size_t(head[2]) * 256 + head[3] != row.size()) reader.fail("a row has the wrong length");
    readComponentRuns(reader, row);
}

Vec3f toLinear(const Rgbe& p) {
    if (p[3] == 0) return {};
    const float scale = std::ldexp(1.0f, int(p[3]) - (128 + 8));
    return Vec3f(float(p[0]), float(p[1]), float(p[2])) * scale;
}

}  // namespace

Image decodeRadianceHdr(std::span<const uint8_t> data, const std::string& name) {
    Reader reader(data, name);
    if (!reader.line().starts_with("#?")) reader.fail("its header does not start with #?");
    double exposure = 1;
    for (std::string line = reader.line(); !line.empty(); line = reader.line()) {
        // Each such line multiplies; pixels are radiance × exposure (Ward, "Radiance picture file format").
        if (line.starts_with("EXPOSURE=")) exposure *= std::strtod(line.c_str() + 9, nullptr);
        if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe") reader.fail("its pixels are not RGBE");
    }
    const float factor = float(1 / exposure);
    if (!(factor > 0) || !std::isfinite(factor)) reader.fail("its EXPOSURE is not a positive number");
    Image image;
    if (std::sscanf(reader.line().c_str(), "-Y %u +X %u", &image.height, &image.width) != 2)
        reader.fail("only pictures stored as -Y height +X width are supported");
    // Every row takes four bytes at least; a header that promises more rows than that is broken.
    if (image.width == 0 || image.height == 0 || image.height > reader.remaining() / 4 ||
        !isPlausibleSize(image.width, image.height, data.size()))
        reader.fail("its size does not fit its data");
    image.pixels.reserve(size_t(image.width) * image.height);
    std::vector<Rgbe> row(image.width);
    for (uint32_t y = 0; y < image.height; ++y) {
        readRow(reader, row);
        for (const Rgbe& p : row) image.pixels.push_back(toLinear(p) * factor);
    }
    return image;
}

}  // namespace antipode
