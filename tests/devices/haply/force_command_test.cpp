#include "devices/haply/force_command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "realtime/guard/guard.h"

namespace icome::devices {
namespace {

using base::Vector3;

TEST(ForceCommand, IsWhatTheServiceDocuments) {
  ForceCommand command("049D", "vector");
  EXPECT_EQ(command.write({1.5, -0.25, 0.0}, false),
            R"({"inverse3":[{"device_id":"049D","commands":{"set_cursor_force":{"vector":{"x":1.500000,)"
            R"("y":-0.250000,"z":0.000000}}}}]})");
  const auto full = nlohmann::json::parse(ForceCommand("049D", "values").write({1, 2, 3}, true));
  EXPECT_TRUE(full["session"].contains("force_render_full_state"));
  EXPECT_EQ(full["inverse3"][0]["commands"]["set_cursor_force"]["values"]["z"], 3.0);
}

TEST(ForceCommand, NoCoordinateIsBeyondTheLimit) {
  const double none = std::nan("");
  const double endless = std::numeric_limits<double>::infinity();
  ForceCommand command("049D", "vector");
  for (const Vector3& force :
       {Vector3(9, -9, 1e300), Vector3(none, endless, -endless), Vector3(-1e-300, 0, 5)}) {
    const auto message = nlohmann::json::parse(command.write(force, false));
    for (const auto& [axis, number] :
         message["inverse3"][0]["commands"]["set_cursor_force"]["vector"].items()) {
      EXPECT_TRUE(number.is_number());
      EXPECT_LE(std::abs(number.get<double>()), ForceCommand::kMostForce) << axis;
    }
  }
  EXPECT_EQ(command.write({none, endless, -endless}, false), command.write({0, 0, 0}, false));
}

TEST(ForceCommand, TakesNoMemory) {
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "a sanitizer needs the memory functions";
  ForceCommand command(std::string(40, 'A'), "vector");
  realtime::RealtimeGuard guard;
  for (int i = 0; i < 1000; ++i) command.write({-4.999999 + 0.01 * i, 0.1 * i, -5}, i % 2 == 0);
  guard.stop();
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_EQ(guard.locks(), 0u);
}

TEST(ForceCommand, TheGreetingNamesUs) {
  const auto message = nlohmann::json::parse(greeting_message());
  EXPECT_EQ(message["session"]["configure"]["profile"]["name"], "ICOME");
  EXPECT_FALSE(message.contains("inverse3"));
}

}  // namespace
}  // namespace icome::devices
