#include "devices/mapping_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace icome::devices {
namespace {

TEST(MappingFile, WhatIsWrittenIsRead) {
  DeviceMapping mapping;
  mapping.centre = {0.01, -0.02, 0.0035};
  mapping.ours_from_device = Quaternion((base::Matrix3() << 0, 1, 0, 0, 0, 1, 1, 0, 0).finished());
  mapping.scale = 1.5;
  mapping.workspace_radius = 0.07;
  mapping.max_force = 2.0;
  mapping.clutch_button = 2;
  const auto read = parse_mapping(mapping_text(mapping, "test"), "device.toml");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(read->centre.isApprox(mapping.centre));
  EXPECT_NEAR(read->ours_from_device.angularDistance(mapping.ours_from_device), 0.0, 1e-9);
  EXPECT_EQ(read->scale, 1.5);
  EXPECT_EQ(read->workspace_radius, 0.07);
  EXPECT_EQ(read->max_force, 2.0);
  EXPECT_EQ(read->clutch_button, 2);
  EXPECT_FALSE(read->scale_follows_view);
}

TEST(MappingFile, AScaleThatFollowsTheViewIsNotKept) {
  DeviceMapping mapping;
  mapping.scale = 6.19957;
  mapping.scale_follows_view = true;
  const auto read = parse_mapping(mapping_text(mapping, "test"), "device.toml");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(read->scale_follows_view);
  EXPECT_FALSE(read->scale) << "it is that of the last view";
}

TEST(MappingFile, WhatIsLeftOutChangesNothing) {
  const auto read = parse_mapping("", "device.toml");
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->centre.isZero());
  EXPECT_EQ(read->scale, std::nullopt);
  EXPECT_EQ(read->clutch_button, -1);
}

TEST(MappingFile, ErrorsNameTheLine) {
  const auto fails = [](const std::string& text) {
    const auto read = parse_mapping(text, "device.toml");
    return read ? std::string() : read.error().message;
  };
  EXPECT_EQ(fails("scale = 1\nscael = 2\n"),
            "device.toml:2:1: a device has no key \"scael\"; did you mean 'scale'?");
  EXPECT_NE(fails("scale = 0").find("device.toml:1:9: scale must be a number from 0.01 to 100"),
            std::string::npos);
  EXPECT_NE(fails("scale_follows_view = 1").find("true or false"), std::string::npos);
  EXPECT_NE(fails("scale = nan").find("scale must be"), std::string::npos);
  EXPECT_NE(fails("centre_m = [1, 2]").find("three numbers"), std::string::npos);
  EXPECT_NE(fails("axes = \"x,y,-z\"").find("mirror"), std::string::npos);
  EXPECT_NE(fails("axes = \"x,x,z\"").find("three axes"), std::string::npos);
  EXPECT_NE(fails("axes = [\"x\", \"y\"]").find("three axes"), std::string::npos);
  EXPECT_NE(fails("clutch_button = 1.5").find("whole number"), std::string::npos);
  EXPECT_NE(fails("centre_m = [").find("device.toml:1"), std::string::npos);
}

TEST(MappingFile, LiesInTheUsersSettings) {
  ::setenv("XDG_CONFIG_HOME", "/somewhere", 1);
  EXPECT_EQ(mapping_path("vrpn:Phantom0@lab/../x:3883"),
            "/somewhere/icome/devices/vrpn_Phantom0_lab_.._x_3883.toml");
  ::unsetenv("XDG_CONFIG_HOME");
}

TEST(MappingFile, IsWrittenAndReadByAddress) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "icome-mapping-test";
  std::filesystem::remove_all(folder);
  ::setenv("XDG_CONFIG_HOME", folder.c_str(), 1);
  const auto none = read_mapping("hd");
  EXPECT_TRUE(none && !none->scale);
  ASSERT_TRUE(write_mapping("hd", {.scale = 2.0}, "test"));
  const auto read = read_mapping("hd");
  EXPECT_TRUE(read && read->scale == 2.0);
  std::ofstream(mapping_path("hd")) << "scale = \"large\"\n";
  const auto bad = read_mapping("hd:");
  ASSERT_FALSE(bad);
  EXPECT_NE(bad.error().message.find("hd.toml:1:"), std::string::npos);
  ::unsetenv("XDG_CONFIG_HOME");
  std::filesystem::remove_all(folder);
}

TEST(MappingFile, IsFoundHoweverTheDeviceIsSpelled) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "icome-spelling-test";
  std::filesystem::remove_all(folder);
  ::setenv("XDG_CONFIG_HOME", folder.c_str(), 1);
  const auto limit = [](const char* address) {
    const auto mapping = read_mapping(address);
    return mapping ? mapping->max_force : -1.0;
  };
  ASSERT_TRUE(write_mapping("haply:049D", {.max_force = 1.0}, "test"));
  for (const char* address : {"haply:049D", "haply:049d", "haply", "haply:"})
    EXPECT_EQ(limit(address), 1.0) << address;
  EXPECT_EQ(limit("haply:0001"), 0.0) << "another device";
  ASSERT_TRUE(write_mapping("haply", {.max_force = 2.0}, "test"));
  EXPECT_EQ(limit("haply"), 2.0);
  EXPECT_EQ(limit("haply:0001"), 2.0) << "the back-end's counts for all that have none";
  EXPECT_EQ(limit("haply:049D"), 1.0);
  ASSERT_TRUE(write_mapping("dhd:0", {.max_force = 1.0}, "test"));
  ASSERT_TRUE(write_mapping("dhd:1", {.max_force = 2.0}, "test"));
  EXPECT_EQ(limit("dhd"), -1.0) << "it might be either";
  EXPECT_EQ(limit("hd"), 0.0);
  std::filesystem::create_symlink(folder / "nowhere", mapping_path("hd"));
  EXPECT_EQ(limit("hd"), -1.0) << "a file that cannot be read may hold a limit";
  ::unsetenv("XDG_CONFIG_HOME");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace icome::devices
