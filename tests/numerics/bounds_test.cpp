#include "numerics/bounds.h"

#include <gtest/gtest.h>

using namespace antipode;

TEST(Bounds, OfNothingAreEmptyAndAddNothing) {
    Bounds3d bounds;
    EXPECT_TRUE(bounds.isEmpty());
    bounds.add({1, 2, 3});
    bounds.add(Bounds3d());
    EXPECT_FALSE(bounds.isEmpty());
    EXPECT_EQ(bounds.lower, Vec3d(1, 2, 3));
    EXPECT_EQ(bounds.upper, Vec3d(1, 2, 3));
    EXPECT_EQ(bounds.radius(), 0);
}

TEST(Bounds, HoldEachPointAndEachBoxAdded) {
    Bounds3f bounds;
    bounds.add({1, -2, 3});
    bounds.add({-1, 2, 5});
    bounds.add(Bounds3f{{0, 0, -4}, {7, 1, 0}});
    EXPECT_EQ(bounds.lower, Vec3f(-1, -2, -4));
    EXPECT_EQ(bounds.upper, Vec3f(7, 2, 5));
    EXPECT_EQ(bounds.center(), Vec3f(3, 0, 0.5f));
    EXPECT_EQ(bounds.size(), Vec3f(8, 4, 9));
}

TEST(Bounds, TakeTheRadiusOfTheSphereAroundThemInDouble) {
    const Bounds3f bounds{{-3e30f, 0, 0}, {3e30f, 0, 0}};  // squares are beyond single precision
    EXPECT_EQ(bounds.radius(), double(3e30f));
    EXPECT_EQ((Bounds3d{{0, 0, 0}, {2, 4, 4}}.radius()), 3);
}

TEST(Bounds, HaveACentreWhereTheSumOfTheCornersWouldOverflow) {
    EXPECT_EQ((Bounds3f{Vec3f(2e38f), Vec3f(3e38f)}.center()), Vec3f(2.5e38f));
}
