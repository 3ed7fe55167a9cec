#include "devices/vrpn/vrpn_address.h"

#include <gtest/gtest.h>

namespace icome::devices {
namespace {

TEST(VrpnAddress, NameHostAndPort) {
  auto address = VrpnAddress::parse("Phantom@lab.example:4000");
  ASSERT_TRUE(address);
  EXPECT_EQ(address->name, "Phantom");
  EXPECT_EQ(address->host, "lab.example");
  EXPECT_EQ(address->port, 4000);
  EXPECT_EQ(address->info.name, "Phantom@lab.example:" + std::to_string(address->port));
  address = VrpnAddress::parse("Tracker1@host");
  ASSERT_TRUE(address);
  EXPECT_EQ(address->port, 3883);
  address = VrpnAddress::parse("");
  ASSERT_TRUE(address);
  EXPECT_EQ(address->name, "Tracker0");
  EXPECT_EQ(address->host, "localhost");
  EXPECT_EQ(VrpnAddress::parse("T@tcp://host:77")->host, "host");
  EXPECT_EQ(VrpnAddress::parse("T@:77")->host, "localhost");
  EXPECT_EQ(VrpnAddress::parse("T@:77")->port, 77);
}

TEST(VrpnAddress, Options) {
  const auto address = VrpnAddress::parse(
      "P@h?profile=touch&axes=x,z,-y&scale=0.001&sensor=2&grip=0&forces=fields&unit=1&radius=0.2");
  ASSERT_TRUE(address) << address.error().message;
  EXPECT_EQ(address->info.max_force, 3.3);
  EXPECT_EQ(address->info.name, "P@h:3883");
  EXPECT_EQ(address->info.workspace_radius, 0.2);
  EXPECT_EQ(address->frame.position({1, 2, 3}), Vector3(0.001, 0.003, -0.002));
  EXPECT_EQ(address->sensor, 2);
  EXPECT_EQ(address->grip, 0);
  EXPECT_EQ(address->forces, VrpnForces::Fields);
  EXPECT_EQ(address->spring_unit, 1.0);
}

TEST(VrpnAddress, WhatMakesNoSenseIsToldInASentence) {
  for (const char* text :
       {"T@h:0", "T@h:99999", "T@h:port", "T@::1:77", "T@[::1", "T@h?axes=x,y", "T@h?axes=x,y,-z",
        "T@h?axes=x,x,y", "T@h?axes=x,y,z,x", "T@h?scale=0", "T@h?scale=-1", "T@h?scale=nan", "T@h?sensor=-1",
        "T@h?forces=all", "T@h?colour=red", "T@h?profile=nothing", "T@h?sensor"}) {
    const auto address = VrpnAddress::parse(text);
    ASSERT_FALSE(address) << text;
    EXPECT_GT(address.error().message.size(), 20U) << text;
  }
}

}  // namespace
}  // namespace icome::devices
