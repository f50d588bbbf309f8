// OpenEXR: linear RGB in float32, Rec. 709 primaries, metadata as string attributes.
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <unistd.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "film/image_checks.h"
#include "renderengine/error.h"
#include "renderengine/film.h"
#include "renderengine/io/files.h"

namespace antipode {
namespace {

constexpr const char* channelNames[3] = {"R", "G", "B"};

/// Collects the file in memory. OpenEXR's own file stream reports no error of its last write (the destructor swallows
/// it), which on a full disk would leave a broken file that looks written.
class MemoryStream : public Imf::OStream {
public:
    explicit MemoryStream(const std::string& path) : Imf::OStream(path.c_str()) {}

    void write(const char bytes[], int count) override {
        bytes_.resize(std::max(bytes_.size(), position_ + size_t(count)));
        std::memcpy(bytes_.data() + position_, bytes, size_t(count));
        position_ += size_t(count);
    }
    uint64_t tellp() override { return position_; }
    void seekp(uint64_t position) override { position_ = size_t(position); }
    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
    size_t position_ = 0;
};

/// Slices that address Vec3f pixels whose first lies at data window coordinate (minX, minY).
Imf::FrameBuffer frameBuffer(std::vector<Vec3f>& pixels, uint32_t width, int64_t minX, int64_t minY) {
    const ptrdiff_t columnBytes = sizeof(Vec3f), rowBytes = columnBytes * ptrdiff_t(width);
    Imf::FrameBuffer buffer;
    for (int c = 0; c < 3; ++c) {
        char* origin = reinterpret_cast<char*>(pixels.data()) + sizeof(float) * size_t(c);
        buffer.insert(channelNames[c], Imf::Slice(Imf::FLOAT, origin - minX * columnBytes - minY * rowBytes,
                                                  size_t(columnBytes), size_t(rowBytes)));
    }
    return buffer;
}

/// Declares the layer's channels ("N.X", or "Z" where it has no name) and where they lie.
void addLayer(LayerImage& layer, const Image& image, Imf::Header& header, Imf::FrameBuffer& buffer) {
    const Imath::V2i first = header.dataWindow().min;
    const size_t columnBytes = sizeof(float) * layer.channels.size();
    if (layer.values.size() != layer.channels.size() * image.pixels.size())
        throw std::invalid_argument("layer '" + layer.name + "' has another size than the image");
    for (size_t c = 0; c < layer.channels.size(); ++c) {
        const std::string name = (layer.name.empty() ? "" : layer.name + ".") + layer.channels[c];
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, layer.values.data() + c, first, int64_t(image.width),
                                             int64_t(image.height), columnBytes));
    }
}

[[noreturn]] void failToRead(const std::string& path, std::string why) {
    if (!why.empty() && why.back() == '.') why.pop_back();  // OpenEXR's messages are sentences
    throw Error(ErrorCode::Input, "Cannot read '" + path + "' as an OpenEXR image: " + why + ".");
}

void requireRgb(const std::string& path, const Imf::ChannelList& channels) {
    for (const char* name : channelNames) {
        if (channels.findChannel(name)) continue;
        std::string present;
        for (auto channel = channels.begin(); channel != channels.end(); ++channel)
            present += (present.empty() ? "" : ", ") + std::string(channel.name());
        failToRead(path, "it has no channel " + std::string(name) + " (it has: " + present + ")");
    }
}

ImageMetadata stringAttributes(const Imf::Header& header) {
    ImageMetadata metadata;
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute)
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute()))
            metadata[attribute.name()] = text->value();
    return metadata;
}

Image readOpenFile(const std::string& path, Imf::InputFile& file) {
    // Bounds what a broken header can make us allocate: 2^28 pixels are 3 GiB.
    constexpr uint64_t maxPixels = uint64_t(1) << 28;
    const Imath::Box2i window = file.header().dataWindow();
    const int64_t width = int64_t(window.max.x) - window.min.x + 1, height = int64_t(window.max.y) - window.min.y + 1;
    if (width < 1 || height < 1 || uint64_t(width) > maxPixels / uint64_t(height))
        failToRead(path, "its size of " + std::to_string(width) + "x" + std::to_string(height) + " is out of range");
    requireRgb(path, file.header().channels());
    if (!file.isComplete()) failToRead(path, "it is incomplete");

    Image image{uint32_t(width), uint32_t(height), std::vector<Vec3f>(size_t(width) * size_t(height))};
    file.setFrameBuffer(frameBuffer(image.pixels, image.width, window.min.x, window.min.y));
    file.readPixels(window.min.y, window.max.y);
    return image;
}

}  // namespace

void writeExr(const std::string& path, const Image& image, const ImageMetadata& metadata,
              const std::vector<LayerImage>& layers, const std::optional<FramePlacement>& placement) {
    requireConsistent(image, path);
    MemoryStream stream(path);
    try {
        Imf::Header header(int(image.width), int(image.height));
        if (placement) {
            const auto& [frameWidth, frameHeight, window] = *placement;
            header.displayWindow() = {{0, 0}, {int(frameWidth) - 1, int(frameHeight) - 1}};
            header.dataWindow() = {{int(window.x0), int(window.y0)}, {int(window.x1) - 1, int(window.y1) - 1}};
        }
        const Imath::V2i first = header.dataWindow().min;
        header.compression() = Imf::ZIP_COMPRESSION;
        Imf::addChromaticities(header, Imf::Chromaticities());  // OpenEXR's defaults are Rec. 709 with white D65
        for (const char* name : channelNames) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        for (const auto& [name, value] : metadata) header.insert(name, Imf::StringAttribute(value));

        std::vector<Vec3f> pixels = image.pixels;  // the slices take mutable memory
        Imf::FrameBuffer buffer = frameBuffer(pixels, image.width, first.x, first.y);
        std::vector<LayerImage> further = layers;
        for (LayerImage& layer : further) addLayer(layer, image, header, buffer);
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(buffer);
        file.writePixels(int(image.height));
    } catch (const std::exception& error) {
        throw Error(ErrorCode::Output, "Cannot write '" + path + "': " + error.what());
    }
    writeFileAtomically(path, stream.bytes());
}

Image readExr(const std::string& path, ImageMetadata* metadata) {
    if (::access(path.c_str(), R_OK) != 0)
        throw Error(ErrorCode::Input, "Cannot read '" + path + "': " + std::strerror(errno) + ".");
    try {
        Imf::InputFile file(path.c_str());
        Image image = readOpenFile(path, file);
        if (metadata) *metadata = stringAttributes(file.header());
        return image;
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        failToRead(path, error.what());
    }
}

}  // namespace antipode
