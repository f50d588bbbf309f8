#include "tests/scene/model_files.h"

#include <png.h>

#include <cstring>
#include <fstream>

namespace antipode::testing {
namespace {

void append(std::vector<uint8_t>& bytes, const void* data, size_t size) {
    const auto* begin = static_cast<const uint8_t*>(data);
    bytes.insert(bytes.end(), begin, begin + size);
}

void append(std::vector<uint8_t>& bytes, uint32_t value) { append(bytes, &value, 4); }

}  // namespace

void ModelFiles::SetUp() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    directory_ = std::filesystem::path(::testing::TempDir()) /
                 (std::string("antipode_") + test->test_suite_name() + "_" + test->name());
    std::filesystem::create_directories(directory_);
}

void ModelFiles::TearDown() { std::filesystem::remove_all(directory_); }

std::string ModelFiles::write(const std::string& name, const std::string& content) const {
    return write(name, std::vector<uint8_t>(content.begin(), content.end()));
}

std::string ModelFiles::write(const std::string& name, const std::vector<uint8_t>& content) const {
    const std::string path = (directory_ / name).string();
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(content.data()), std::streamsize(content.size()));
    EXPECT_TRUE(file.good());
    return path;
}

std::vector<uint8_t> makeGlb(const nlohmann::json& json, const std::vector<uint8_t>& binary) {
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::vector<uint8_t> padded = binary;
    padded.resize((binary.size() + 3) / 4 * 4);
    std::vector<uint8_t> glb;
    append(glb, 0x46546c67u);
    append(glb, 2u);
    append(glb, uint32_t(12 + 8 + text.size() + 8 + padded.size()));
    append(glb, uint32_t(text.size()));
    append(glb, 0x4e4f534au);
    append(glb, text.data(), text.size());
    append(glb, uint32_t(padded.size()));
    append(glb, 0x004e4942u);
    append(glb, padded.data(), padded.size());
    return glb;
}

TriangleGltf::TriangleGltf() {
    const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const uint16_t indices[4] = {0, 1, 2, 0};
    append(binary, positions, sizeof positions);
    append(binary, indices, sizeof indices);
    json = nlohmann::json::parse(R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "holder"}],
        "meshes": [{"name": "triangle", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"name": "paint"}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0,0,0], "max": [1,1,0]},
                      {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 8}],
        "buffers": [{"byteLength": 44}]})");
}

void TriangleGltf::setPosition(size_t vertex, size_t axis, float value) {
    std::memcpy(binary.data() + (vertex * 3 + axis) * 4, &value, 4);
}

void TriangleGltf::setIndex(size_t corner, uint16_t value) { std::memcpy(binary.data() + 36 + corner * 2, &value, 2); }

std::vector<uint8_t> makePng() {
    const uint8_t rgba[8] = {255, 0, 0, 255, 0, 128, 0, 64};
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = 2;
    image.height = 1;
    image.format = PNG_FORMAT_RGBA;
    png_alloc_size_t size = 0;
    png_image_write_to_memory(&image, nullptr, &size, 0, rgba, 0, nullptr);
    std::vector<uint8_t> bytes(size);
    EXPECT_TRUE(png_image_write_to_memory(&image, bytes.data(), &size, 0, rgba, 0, nullptr));
    bytes.resize(size);
    return bytes;
}

}  // namespace antipode::testing
