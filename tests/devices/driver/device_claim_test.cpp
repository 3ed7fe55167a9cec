#include "devices/driver/device_claim.h"

#include <gtest/gtest.h>

namespace icome::devices {
namespace {

TEST(DeviceClaim, ADeviceIsClaimedOnce) {
  auto first = DeviceClaim::of("claim:1");
  ASSERT_TRUE(first);
  EXPECT_TRUE(DeviceClaim::is_taken("claim:1"));
  EXPECT_TRUE(DeviceClaim::of("claim:2")) << "another one";
  const auto again = DeviceClaim::of("claim:1");
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().message, "claim:1 is in use by this program already; disconnect it there first");
  DeviceClaim kept = std::move(*first);
  first = base::fail("moved from");
  EXPECT_TRUE(DeviceClaim::is_taken("claim:1")) << "it has moved";
  kept = DeviceClaim();
  EXPECT_FALSE(DeviceClaim::is_taken("claim:1"));
}

}  // namespace
}  // namespace icome::devices
