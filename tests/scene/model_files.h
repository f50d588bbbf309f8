// Small model files for importer tests, written to a folder that goes away with the test.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "renderengine/error.h"
#include "renderengine/scene.h"

namespace antipode::testing {

class ModelFiles : public ::testing::Test {
protected:
    void SetUp() override;
    void TearDown() override;

    /// Writes a file and returns its path.
    std::string write(const std::string& name, const std::string& content) const;
    std::string write(const std::string& name, const std::vector<uint8_t>& content) const;

    std::filesystem::path directory_;
};

/// What Error says when `action` throws one of code Input; a test failure otherwise.
template <class Action>
std::string inputErrorOf(Action action) {
    try {
        action();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::Input) << e.what();
        return e.what();
    }
    ADD_FAILURE() << "no error was thrown";
    return {};
}

/// A .glb with the JSON and one binary chunk.
std::vector<uint8_t> makeGlb(const nlohmann::json& json, const std::vector<uint8_t>& binary);

/// A glTF of one triangle (0,0,0) (1,0,0) (0,1,0) in mesh "triangle", material 0, node "holder"; its buffer is
/// `binary`.
struct TriangleGltf {
    nlohmann::json json;
    std::vector<uint8_t> binary;

    TriangleGltf();
    void setPosition(size_t vertex, size_t axis, float value);
    void setIndex(size_t corner, uint16_t value);
    std::vector<uint8_t> glb() const { return makeGlb(json, binary); }
};

/// A 2×1 PNG: one red texel, one half-transparent green one.
std::vector<uint8_t> makePng();

}  // namespace antipode::testing
