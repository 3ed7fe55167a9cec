// Messages that nobody would send, and forces that nobody would ask for, through all that lies between the
// network and the servo, without a network or a clock.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "devices/device_profiles.h"
#include "devices/driver/driver_link.h"
#include "devices/haply/force_command.h"
#include "devices/haply/haply_frame.h"
#include "devices/haply/padded_message.h"
#include "repeats.h"

namespace icome::devices {
namespace {

constexpr int kHostileParts = 4;
constexpr int kHostileMessages = 1'000'000;

class HostileService {
 public:
  explicit HostileService(unsigned seed) : random_(seed) {}

  std::string next() {
    std::string text = R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":)" + number() +
                       ",\"y\":" + number() + ",\"z\":" + number() + R"(},"cursor_velocity":{"x":)" +
                       number() +
                       R"(}},"status":{"ready":true}}],"wireless_verse_grip":[{"device_id":"8A21","state":{)"
                       R"("buttons":{"a":true},"orientation":{"w":)" +
                       number() + ",\"x\":" + number() + "}}}]}";
    for (int faults = below(4); faults > 0; --faults) spoil(text);
    return text;
  }
  int below(int end) { return std::uniform_int_distribution<int>(0, end - 1)(random_); }

 private:
  std::string number() {
    static const char* const kOdd[] = {"1e308", "-1e308", "1e999", "null",   "NaN",
                                       "-0",    "true",   "\"1\"", "1e-320", "12345678901234567890123",
                                       "[]",    "{}",     ".5",    "0x1"};
    if (below(20) == 0) return kOdd[below(int(std::size(kOdd)))];
    return std::to_string(0.0001 * (below(4001) - 2000));
  }
  void spoil(std::string& text) {
    const auto place = [&] { return std::size_t(below(int(text.size()) + 1)); };
    switch (below(5)) {
      case 0:
        text.resize(place());
        break;
      case 1:
        text.insert(place(), 1, char(below(256)));
        break;
      case 2:
        text.erase(place(), std::size_t(below(8)));
        break;
      case 3:
        text.insert(place(), text.substr(place(), std::size_t(below(64))));
        break;
      default:
        if (!text.empty()) text[std::min(place(), text.size() - 1)] = "{}[]\",:0-e\\"[below(11)];
    }
  }

  std::mt19937 random_;
};

class HostileMessages : public testing::TestWithParam<int> {};

TEST_P(HostileMessages, NeverGiveAForceAboveTheProfile) {
  const DeviceInfo info = *find_device_profile("Haply Inverse3");
  HostileService service(unsigned(GetParam() + 1));
  ServiceState state;
  const HaplySettings settings;
  const HaplyFrame frame(settings);
  ForceCommand command("049D", "vector");
  DriverLink link(info);
  link.connect(info);
  std::int64_t now = 1'000'000'000;
  PointerState felt;
  std::uint64_t accepted = 0;
  const int count = repeats(kHostileMessages) / kHostileParts;
  for (int i = 0; i < count; ++i) {
    now += service.below(1000) == 0 ? 100'000'000 : 1'000'000;
    const PaddedMessage message(service.next());
    if (state.take(message) && !state.arms().empty() && state.arms()[0].has_position()) {
      link.pass(frame.state_of(state.arms()[0], state.grip_of(0, "")), now);
      ++accepted;
    }
    if (link.read(felt) == DeviceStatus::Ok) {
      // A spring as stiff as the device may be held against, and now and then a servo gone mad.
      const Vector3 force = service.below(100) == 0
                                ? Vector3(Vector3::Constant(std::pow(10.0, service.below(309))))
                                : Vector3(-1000.0 * felt.position);
      link.write(force, now);
    }
    ASSERT_TRUE(felt.position.allFinite() && felt.velocity.allFinite());
    ASSERT_NEAR(felt.orientation.norm(), 1.0, 1e-9);
    ASSERT_LE(felt.velocity.norm(), 21.0);
    const Vector3 sent = frame.service_force(link.force(now));
    ASSERT_LE(sent.norm(), info.max_force * (1.0 + 1e-9)) << std::string_view(message);
    if (i % 64 == 0) {
      const auto text = nlohmann::json::parse(command.write(sent, false));
      ASSERT_LE(std::abs(text["inverse3"][0]["commands"]["set_cursor_force"]["vector"]["x"].get<double>()),
                5.0);
    }
  }
  EXPECT_EQ(state.taken() + state.refused(), std::uint64_t(count));
  EXPECT_GT(state.refused(), std::uint64_t(count) / 10);
  EXPECT_GT(accepted, std::uint64_t(count) / 10);
}

INSTANTIATE_TEST_SUITE_P(Parts, HostileMessages, testing::Range(0, kHostileParts));

}  // namespace
}  // namespace icome::devices
