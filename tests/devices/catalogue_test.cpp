#include "devices/catalogue.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "devices/fakes/loaded_fake.h"

namespace icome::devices {
namespace {

TEST(Catalogue, EachBackEndTellsOfADeviceOrWhyThereIsNone) {
  std::set<std::string> told;
  for (const DeviceEntry& entry : list_devices()) {
    told.insert(entry.backend);
    EXPECT_FALSE(entry.name.empty());
    EXPECT_TRUE(entry.family == "pointer" || entry.family == "navigation" || entry.family == "head")
        << entry.family;
    EXPECT_TRUE(entry.present || !entry.why.empty()) << entry.name;
  }
  for (const BackEnd& back_end : back_ends())
    EXPECT_TRUE(told.contains(std::string(back_end.name))) << back_end.name;
}

TEST(Catalogue, WhatCannotBeOpenedIsNotThere) {
  std::string folder = (std::filesystem::temp_directory_path() / "icome-catalogue-XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const fakes::EnvironmentValue config("XDG_CONFIG_HOME", folder);
  const fakes::EnvironmentValue mode("ICOME_HD_MODE", "x");
  const fakes::EnvironmentValue axes("ICOME_DHD_AXES", "x,x,x");
  const fakes::EnvironmentValue pad("ICOME_GAMEPAD", "speed=x");
  std::filesystem::create_directories(folder + "/icome/devices");
  std::ofstream(folder + "/icome/devices/simulated.toml") << "scale = \"x\"\n";
  std::set<std::string> reasons;
  for (const DeviceEntry& entry : list_devices()) {
    for (const char* word : {"ICOME_HD_MODE", "ICOME_DHD_AXES", "ICOME_GAMEPAD", "simulated.toml"})
      if (!entry.present && entry.why.find(word) != std::string::npos) reasons.insert(word);
  }
  EXPECT_EQ(reasons.size(), 4u);
  std::filesystem::remove_all(folder);
}

TEST(Catalogue, PrefixesDiffer) {
  std::set<std::string_view> prefixes;
  for (const BackEnd& back_end : back_ends())
    EXPECT_TRUE(prefixes.insert(back_end.prefix).second) << back_end.prefix;
}

TEST(Catalogue, OpensSimulatedDevicesWithAProfilesAbilities) {
  const auto plain = open_device("simulated");
  ASSERT_TRUE(plain);
  const auto touch = open_device("touch");
  ASSERT_TRUE(touch);
  EXPECT_EQ((*touch)->info().name, "Touch");
  EXPECT_EQ((*touch)->info().max_force, 3.3);
  const auto same = open_device("simulated:Touch");
  ASSERT_TRUE(same);
  EXPECT_EQ((*same)->info().name, "Touch");
  EXPECT_FALSE(is_device_address("Touch"));
  EXPECT_FALSE(is_device_address("simulated"));
}

TEST(Catalogue, SaysWhatThereIsForAnUnknownName) {
  const auto device = open_device("feather");
  ASSERT_FALSE(device);
  EXPECT_NE(device.error().message.find("Novint Falcon"), std::string::npos);
  EXPECT_NE(device.error().message.find("icome devices"), std::string::npos);
  const auto navigation = open_device("spacemouse");
  ASSERT_FALSE(navigation);
  EXPECT_NE(navigation.error().message.find("no pointer"), std::string::npos);
}

}  // namespace
}  // namespace icome::devices
