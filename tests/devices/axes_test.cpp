#include "devices/axes.h"

#include <gtest/gtest.h>

namespace icome::devices {
namespace {

TEST(DeviceAxes, NameTheirAxesForRightUpAndTheUser) {
  const auto rotation = rotation_from_axes("yzx");
  ASSERT_TRUE(rotation);
  // The device's x points to the user, which is our z.
  EXPECT_EQ(*rotation * base::Vector3(1, 2, 3), base::Vector3(2, 3, 1));
  EXPECT_EQ(*rotation_from_axes("xyz"), base::Matrix3(base::Matrix3::Identity()));
  EXPECT_EQ(*rotation_from_axes("+y-x+z") * base::Vector3(1, 2, 3), base::Vector3(2, -1, 3));
  EXPECT_EQ(rotation_from_axes("y-xz")->determinant(), 1.0);
  EXPECT_EQ(*rotation_from_axes("y,-x,z"), *rotation_from_axes("y-xz"));
  EXPECT_EQ(axes_text(*rotation_from_axes("y-xz")), "y,-x,z");
}

TEST(DeviceAxes, ThatMirrorOrAreNoThreeAreRefused) {
  for (const char* text : {"xzy", "-xyz", "yxz"}) {
    const auto rotation = rotation_from_axes(text);
    ASSERT_FALSE(rotation) << text;
    EXPECT_NE(rotation.error().message.find("mirror left and right"), std::string::npos);
  }
  for (const char* text : {"", "xy", "xxz", "xyzx", "abc", "x y z", "-", "x,y", ",x,y,z", "x,,y,z", "x,y,z,",
                           "xyz-", "--xyz", "x+-yz", "xyz,"}) {
    const auto rotation = rotation_from_axes(text);
    ASSERT_FALSE(rotation) << text;
    EXPECT_NE(rotation.error().message.find("three axes"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace icome::devices
