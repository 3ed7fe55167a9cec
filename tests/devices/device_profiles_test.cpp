#include "devices/device_profiles.h"

#include <gtest/gtest.h>

#include <set>

namespace icome::devices {
namespace {

TEST(DeviceProfiles, FindsThePremiumOfTable41) {
  const auto found = find_device_profile("phantom premium 1.5");
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->name, "PHANToM Premium 1.5");
  // Thesis table 4.1; the stiffness is the one used (800), not the catalogue's 3500.
  EXPECT_DOUBLE_EQ(found->max_force, 8.5);
  EXPECT_DOUBLE_EQ(found->continuous_force, 1.4);
  EXPECT_DOUBLE_EQ(found->effective_mass, 0.075);
  EXPECT_DOUBLE_EQ(found->nominal_stiffness, 800.0);
  EXPECT_DOUBLE_EQ(found->workspace_radius, 0.12);
}

TEST(DeviceProfiles, CaseDoesNotMatter) {
  EXPECT_EQ(find_device_profile("LAMBDA.7").value().nominal_stiffness, 8000.0);
  EXPECT_EQ(find_device_profile("haply inverse3").value().max_force, 5.0);
}

TEST(DeviceProfiles, UnknownNameListsAllNames) {
  const auto found = find_device_profile("Touc");
  ASSERT_FALSE(found.has_value());
  EXPECT_NE(found.error().message.find("\"Touc\""), std::string::npos);
  for (const DeviceInfo& device : device_profiles()) {
    EXPECT_NE(found.error().message.find(device.name), std::string::npos) << device.name;
  }
}

TEST(DeviceProfiles, EveryRowIsUsable) {
  std::set<std::string> names;
  for (const DeviceInfo& device : device_profiles()) {
    EXPECT_TRUE(names.insert(device.name).second) << device.name;
    EXPECT_GT(device.workspace_radius, 0.0);
    EXPECT_GT(device.continuous_force, 0.0);
    EXPECT_LE(device.continuous_force, device.max_force);
    EXPECT_GT(device.nominal_stiffness, 0.0);
    EXPECT_GT(device.effective_mass, 0.0);
  }
  EXPECT_EQ(names.size(), 12u);
}

}  // namespace
}  // namespace icome::devices
