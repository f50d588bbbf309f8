#include "scene/precision_notices.h"

#include <gtest/gtest.h>

#include "tests/scene/box_scene.h"

using namespace antipode;

TEST(PrecisionNotices, SayNothingWhereFloatsSuffice) {
    EXPECT_TRUE(precisionNotices(boxAt({0, 0, 0}, 1)).empty());
    EXPECT_TRUE(precisionNotices(boxAt({0, 0, 0}, 1e-6f)).empty());
    EXPECT_TRUE(precisionNotices(boxAt({100, 0, 0}, 1)).empty());
}

TEST(PrecisionNotices, TellHowFarOffADistantSceneIs) {
    // At 10^5 floats are 2^-7 apart: positions err by up to 2^-8 = .0039. A pixel of the 512 that show about 2.5 units
    // of height at a distance of 3 is .0049 wide.
    const auto notices = precisionNotices(boxAt({1e5f, 0, 0}, 1));
    ASSERT_EQ(notices.size(), 2u);
    EXPECT_NE(notices[0].find("0.0039 units"), std::string::npos) << notices[0];
    EXPECT_NE(notices[0].find("0.8 pixels"), std::string::npos) << notices[0];
}

TEST(PrecisionNotices, NameTheSmallThingFarFromTheOrigin) {
    Scene scene = boxAt({0, 0, 0}, 1e4f);
    scene.spheres.push_back({{9000, 0, 0}, 0.001f, 0});
    const auto notices = precisionNotices(scene);
    ASSERT_EQ(notices.size(), 2u);  // the box's triangles are huge beside it, too
    EXPECT_NE(notices[0].find("sphere #0"), std::string::npos) << notices[0];
}

TEST(PrecisionNotices, NameTheSmallestObjectBesideHugeTriangles) {
    Scene scene = boxAt({0, 0, 0}, 1000);
    scene.spheres.push_back({{0, 0, 0.5f}, 0.02f, 0});
    EXPECT_EQ(precisionNotices(scene).size(), 0u);
    scene.spheres.push_back({{1, 0, 0.5f}, 0.009f, 0});
    const auto notices = precisionNotices(scene);
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_NE(notices[0].find("sphere #1"), std::string::npos) << notices[0];
    EXPECT_NE(notices[0].find("0.00017 units"), std::string::npos) << notices[0];
}
