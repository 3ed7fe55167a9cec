#include "devices/driver/model_profile.h"

#include <gtest/gtest.h>

#include <array>

namespace icome::devices {
namespace {

constexpr std::array<ModelProfile, 2> kModels = {{{"arm 2", "Arm II"}, {"arm", "Arm"}}};

TEST(ModelProfiles, FirstThatFitsCountsInAnyCase) {
  EXPECT_EQ(find_model_profile(kModels, "Big ARM 2 (fake)")->profile, "Arm II");
  EXPECT_EQ(find_model_profile(kModels, "Arm 1")->profile, "Arm");
  EXPECT_EQ(find_model_profile(kModels, "leg"), nullptr);
  EXPECT_EQ(find_model_profile(kModels, ""), nullptr);
}

}  // namespace
}  // namespace icome::devices
