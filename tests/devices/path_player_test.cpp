#include "devices/path_player.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "realtime/guard/guard.h"

namespace icome::devices {
namespace {

std::string error_of(std::string_view text) {
  const auto player = PathPlayer::parse(text, "path.csv");
  return player ? "" : player.error().message;
}

TEST(PathPlayer, GivesOneRowAReadWithBackwardDifference) {
  auto player = PathPlayer::parse("t,x,y,z\n0,1,2,3\n0.5,2,2,2\n", "path.csv").value();
  PointerState state;
  ASSERT_EQ(player.read(state), DeviceStatus::Ok);
  EXPECT_EQ(state.position, Vector3(1, 2, 3));
  EXPECT_EQ(state.velocity, Vector3::Zero());
  EXPECT_DOUBLE_EQ(player.time(), 0.0);
  EXPECT_FALSE(player.finished());
  ASSERT_EQ(player.read(state), DeviceStatus::Ok);
  EXPECT_EQ(state.position, Vector3(2, 2, 2));
  EXPECT_EQ(state.velocity, Vector3(2, 0, -2));  // (1, 0, -1) m in 0.5 s
  EXPECT_DOUBLE_EQ(player.time(), 0.5);
  EXPECT_TRUE(player.finished());
}

TEST(PathPlayer, StallsAfterTheLastRowAndKeepsTheState) {
  auto player = PathPlayer::parse("t,x,y,z\n0,1,2,3\n", "path.csv").value();
  PointerState state;
  player.read(state);
  state.buttons = 7;
  EXPECT_EQ(player.read(state), DeviceStatus::Stalled);
  EXPECT_EQ(state.position, Vector3(1, 2, 3));
  EXPECT_EQ(state.buttons, 7u);
}

TEST(PathPlayer, IgnoresForces) {
  auto player = PathPlayer::parse("t,x,y,z\n0,1,2,3\n1,1,2,3\n", "path.csv").value();
  PointerState state;
  player.read(state);
  EXPECT_EQ(player.write(Vector3(100, 0, 0)), DeviceStatus::Ok);
  player.read(state);
  EXPECT_EQ(state.position, Vector3(1, 2, 3));
}

TEST(PathPlayer, ReadTakesNoMemoryAndNoLock) {
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "the sanitizer needs malloc for itself";
  auto player = PathPlayer::parse("t,x,y,z\n0,1,2,3\n1,1,2,3\n", "path.csv").value();
  PointerState state;
  realtime::RealtimeGuard guard;
  while (!player.finished()) player.read(state);
  player.read(state);
  player.write(Vector3::Zero());
  guard.stop();
  EXPECT_EQ(guard.allocations() + guard.frees() + guard.locks(), 0u);
}

TEST(PathPlayer, AcceptsWindowsLinesBlanksAndExponents) {
  const auto player = PathPlayer::parse("t,x,y,z\r\n-1e-3, +1e-2 ,0,-2.5E1\r\n\r\n", "path.csv");
  ASSERT_TRUE(player.has_value()) << player.error().message;
  EXPECT_DOUBLE_EQ(player->times()[0], -1e-3);
  EXPECT_EQ(player->positions()[0], Vector3(0.01, 0, -25));
}

TEST(PathPlayer, AcceptsAByteOrderMarkAndBlanksInTheHeader) {
  const auto player = PathPlayer::parse("\xef\xbb\xbft, x, y, z\n0, 1, 2, 3\n", "path.csv");
  ASSERT_TRUE(player.has_value()) << player.error().message;
  EXPECT_EQ(player->positions()[0], Vector3(1, 2, 3));
}

TEST(PathPlayer, AFifthColumnIsTheButton) {
  auto player = PathPlayer::parse("t,x,y,z,b\n0,0,0,0,0\n1,0,0,0,1\n2,0,0,0,0\n", "path.csv").value();
  EXPECT_TRUE(player.has_button());
  PointerState state;
  for (const std::uint32_t buttons : {0U, 1U, 0U}) {
    ASSERT_EQ(player.read(state), DeviceStatus::Ok);
    EXPECT_EQ(state.buttons, buttons);
  }
  EXPECT_FALSE(PathPlayer::parse("t,x,y,z\n0,0,0,0\n", "path.csv").value().has_button());
  EXPECT_EQ(error_of("t,x,y,z,b\n0,0,0,0,0.5\n"), "path.csv:2: b, the button, is 0 (up) or 1 (down)");
}

TEST(PathPlayer, FillsInTheStraightWay) {
  auto player = PathPlayer::parse("t,x,y,z,b\n1,0,0,0,1\n1.01,1,0,2,0\n1.011,1,0,3,0\n", "path.csv").value();
  ASSERT_TRUE(player.fill_in(0.001));
  ASSERT_EQ(player.times().size(), 12U);
  for (std::size_t i = 0; i + 1 < 12; ++i) {
    EXPECT_NEAR(player.times()[i], 1.0 + 0.001 * double(i), 1e-12);
    EXPECT_TRUE(player.positions()[i].isApprox(0.1 * double(i) * Vector3(1, 0, 2))) << i;
  }
  EXPECT_EQ(player.positions().back(), Vector3(1, 0, 3));
  PointerState state;
  for (std::size_t i = 0; i < 12; ++i) {
    ASSERT_EQ(player.read(state), DeviceStatus::Ok);
    EXPECT_EQ(state.buttons, i < 10 ? 1U : 0U) << i;
  }
  auto longer = PathPlayer::parse("t,x,y,z\n0,0,0,0\n1e9,0,0,0\n", "path.csv").value();
  EXPECT_FALSE(longer.fill_in(0.001));
}

TEST(PathPlayer, ErrorsNameFileAndLine) {
  EXPECT_EQ(error_of(""), "path.csv:1: the first line must be \"t,x,y,z\", not \"\"");
  EXPECT_EQ(error_of("x,y,z\n1,2,3\n"), "path.csv:1: the first line must be \"t,x,y,z\", not \"x,y,z\"");
  EXPECT_EQ(error_of("t,x,y,z\n"), "path.csv:1: there are no rows after the header");
  EXPECT_EQ(error_of("t,x,y,z\n0,0,0,0\n1,2,3\n"),
            "path.csv:3: a row has 4 numbers (t,x,y,z), this one has 3");
  EXPECT_EQ(error_of("t,x,y,z\n0,0,0,0,0\n"), "path.csv:2: a row has 4 numbers (t,x,y,z), this one has 5");
  EXPECT_EQ(error_of("t,x,y,z\n0,0,1.2.3,0\n"), "path.csv:2: y is not a number: '1.2.3'");
  EXPECT_EQ(error_of("t,x,y,z\n0,0,,0\n"), "path.csv:2: y is not a number: ''");
  EXPECT_EQ(error_of("t,x,y,z\n0,0,0,nan\n"), "path.csv:2: z is not finite: 'nan'");
  EXPECT_EQ(error_of("t,x,y,z\n0,inf,0,0\n"), "path.csv:2: x is not finite: 'inf'");
  EXPECT_EQ(error_of("t,x,y,z\n0,0,0,0\n0,0,0,0\n"), "path.csv:3: t must increase, but 0 follows 0");
  EXPECT_EQ(error_of("t,x,y,z\n0,0,0,0\n\n1,0,0,0\n"),
            "path.csv:3: a row has 4 numbers (t,x,y,z), this one has 0");
}

TEST(PathPlayer, MissingFileIsAnError) {
  const auto player = PathPlayer::create("no/such/path.csv");
  ASSERT_FALSE(player.has_value());
  EXPECT_EQ(player.error().message, "no/such/path.csv: cannot be opened (No such file or directory)");
}

TEST(PathPlayer, ADirectoryIsAnError) {
  const auto player = PathPlayer::create(testing::TempDir());
  ASSERT_FALSE(player.has_value());
  EXPECT_NE(player.error().message.find("cannot be read"), std::string::npos);
}

TEST(PathPlayer, ReadsAMillionRowsFromAFile) {
  const std::string path = testing::TempDir() + "/icome_million.csv";
  {
    std::string text = "t,x,y,z\n";
    char row[80];
    for (int i = 0; i < 1'000'000; ++i) {
      std::snprintf(row, sizeof row, "%.6f,%.9f,%.9f,%.9f\n", i * 1e-3, std::sin(i * 1e-3), 0.5, -i * 1e-6);
      text += row;
    }
    std::ofstream(path) << text;
  }
  const auto player = PathPlayer::create(path, DeviceInfo{.name = "", .max_force = 8.5});
  std::remove(path.c_str());
  ASSERT_TRUE(player.has_value()) << player.error().message;
  ASSERT_EQ(player->times().size(), 1'000'000u);
  EXPECT_DOUBLE_EQ(player->times().back(), 999.999);
  EXPECT_DOUBLE_EQ(player->positions().back().z(), -0.999999);
  EXPECT_DOUBLE_EQ(player->info().max_force, 8.5);
  EXPECT_EQ(player->info().name, path);
}

}  // namespace
}  // namespace icome::devices
