// The client on a closed cave whose triangles are all lights: a furnace, whose radiance after n edges is
// Le(1 - ρⁿ)/(1 - ρ) whatever the walls' shape.
#pragma once

#include <gtest/gtest.h>

#include "renderengine/film.h"
#include "tests/film/temporary_folder.h"
#include "tests/large_scene/cave.h"

namespace antipode::test {

class CaveFurnace : public testing::Test {
protected:
    static constexpr double expected = 1.875;  ///< ρ = 1/2, n = 4, Le = 1 in the red channel

    /// A cave of 12·cells² triangles.
    explicit CaveFurnace(uint32_t cells) : cells_(cells) {}
    void SetUp() override;

    /// One iteration of 64², paths of at most four edges. Fails the test where the device counted an event.
    void render(const std::string& options);
    /// Of the last image.
    double largestRelativeError() const;

    std::string device;
    Image image;

private:
    uint32_t cells_;
    TemporaryFolder folder_;
};

}  // namespace antipode::test
