#include "cutout/output/tuio.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>

namespace icome::cutout {
namespace {

std::uint32_t whole_at(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = (number << 8U) | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

// Written by hand from the OSC 1.0 specification: a bundle at once, then messages with their sizes.
TEST(Tuio, EmptyTableIsThreeMessages) {
  TuioBundles bundles(640, 480, "icome");
  const auto made = bundles.of({}, 0);
  ASSERT_EQ(made.size(), 1U);
  using std::string_literals::operator""s;
  const std::string expected =
      "#bundle\0\0\0\0\0\0\0\0\1"s
      "\0\0\0\x20/tuio/2Dobj\0,ss\0source\0\0icome\0\0\0"s
      "\0\0\0\x18/tuio/2Dobj\0,s\0\0alive\0\0\0"s
      "\0\0\0\x1c/tuio/2Dobj\0,si\0fseq\0\0\0\0\0\0\0\1"s;
  EXPECT_EQ(made[0], expected);
}

TEST(Tuio, SpeedsFollowFromTwoFrames) {
  TuioBundles bundles(640, 480, "icome");
  bundles.of({{3, {{64, 240}, 0.5}, 1.0}}, 1.0);
  const auto made = bundles.of({{3, {{128, 240}, 0.5 - std::numbers::pi / 2}, 1.0}}, 1.5);
  const std::string& bundle = made[0];
  const std::size_t set = bundle.find("set") + 4;
  ASSERT_NE(bundle.find("set"), std::string::npos);
  const auto number = [&](std::size_t place) {
    return double(std::bit_cast<float>(whole_at(bundle, set + 4 * place)));
  };
  EXPECT_EQ(whole_at(bundle, set), 1U);      // session
  EXPECT_EQ(whole_at(bundle, set + 4), 3U);  // class
  EXPECT_FLOAT_EQ(float(number(2)), 0.2F);
  EXPECT_FLOAT_EQ(float(number(3)), 0.5F);
  EXPECT_NEAR(number(4), std::numbers::pi / 2 - 0.5, 1e-6);  // clockwise
  EXPECT_NEAR(number(5), 0.2, 1e-6);                         // widths a second
  EXPECT_NEAR(number(6), 0.0, 1e-6);
  EXPECT_NEAR(number(7), 0.5, 1e-6);  // turns a second: a quarter in half a second
  EXPECT_NEAR(number(8), 0.4, 1e-6);
  EXPECT_NEAR(number(9), 1.0, 1e-6);
}

TEST(Tuio, SessionEndsWhenATriangleIsLost) {
  TuioBundles bundles(640, 480, "icome");
  const Sighting sighting = {0, {{10, 10}, 0}, 1.0};
  const auto first = bundles.of({sighting}, 0.0);
  bundles.of({}, 0.1);
  const auto again = bundles.of({sighting}, 0.2);
  const auto session = [](const std::string& bundle) { return whole_at(bundle, bundle.find("set") + 4); };
  EXPECT_EQ(session(first[0]), 1U);
  EXPECT_EQ(session(again[0]), 2U);
}

TEST(Tuio, ManyTrianglesAreSeveralDatagrams) {
  TuioBundles bundles(640, 480, "icome");
  std::vector<Sighting> many;
  for (std::size_t i = 0; i < 60; ++i) many.push_back({i, {{10.0, 10.0}, 0}, 1.0});
  const auto made = bundles.of(many, 0);
  EXPECT_EQ(made.size(), 5U);
  for (const std::string& bundle : made) {
    EXPECT_LT(bundle.size(), 1472U);
    EXPECT_EQ(bundle.size() % 4, 0U);
  }
}

TEST(UdpSender, RefusesHostsThatAreNotThere) {
  EXPECT_FALSE(UdpSender::create({"no-such-host.invalid", 3333}));
  EXPECT_TRUE(UdpSender::create({"127.0.0.1", 3333}));
}

}  // namespace
}  // namespace icome::cutout
