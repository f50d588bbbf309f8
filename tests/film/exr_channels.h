// All channels of an OpenEXR file, as viewers find them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

namespace antipode::test {

/// By name, as floats, row by row.
inline std::map<std::string, std::vector<float>> channelsOf(const std::string& path) {
    Imf::InputFile file(path.c_str());
    const auto& window = file.header().dataWindow();
    const size_t width = size_t(window.max.x - window.min.x + 1), height = size_t(window.max.y - window.min.y + 1);
    std::map<std::string, std::vector<float>> channels;
    Imf::FrameBuffer buffer;
    for (auto c = file.header().channels().begin(); c != file.header().channels().end(); ++c) {
        std::vector<float>& values = channels[c.name()];
        values.resize(width * height);
        buffer.insert(c.name(), Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float),
                                           sizeof(float) * width));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    return channels;
}

}  // namespace antipode::test
