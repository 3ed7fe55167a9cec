#include "devices/haply/wire/service_state.h"

#include <gtest/gtest.h>

#include <string>

#include "devices/haply/padded_message.h"
#include "realtime/guard/guard.h"

namespace icome::devices {
namespace {

constexpr const char* kSnapshot =
    R"({"session_id":7,"inverse3":[{"device_id":"049D","config":{"type":"inverse3"},"state":{)"
    R"("cursor_position":{"x":0.01,"y":-0.14,"z":2e-1},"cursor_velocity":{"x":0,"y":0.5,"z":-1},)"
    R"("body_orientation":{"w":1,"x":0,"y":0,"z":0},"current_cursor_force":{"x":0,"y":0,"z":0},)"
    R"("control_mode":"idle"},"status":{"calibrated":true,"in_use":false,"power_supply":false,"ready":true,)"
    R"("started":true}}],"verse_grip":[{"device_id":"61576","state":{"button":true,"hall":3,)"
    R"("orientation":{"w":0.5,"x":0.5,"y":-0.5,"z":0.5}}}],"wireless_verse_grip":[{"device_id":"8A21",)"
    R"("state":{"buttons":{"a":true,"b":false,"c":true},"orientation":{"w":0,"x":1,"y":0,"z":0}}}]})";

TEST(ServiceState, TakesAWholePicture) {
  ServiceState state;
  ASSERT_TRUE(state.take(PaddedMessage(kSnapshot)));
  ASSERT_EQ(state.arms().size(), 1u);
  const ServiceArm& arm = state.arms()[0];
  EXPECT_EQ(arm.id.text(), "049D");
  EXPECT_TRUE(arm.id.is("049d"));
  EXPECT_TRUE(arm.has_position());
  EXPECT_EQ(arm.position, Vector3(0.01, -0.14, 0.2));
  EXPECT_EQ(arm.velocity, Vector3(0, 0.5, -1));
  EXPECT_TRUE(arm.calibrated && arm.ready);
  EXPECT_FALSE(arm.powered);
  const ServiceGrip* const wireless = state.grip_of(0, "");
  ASSERT_TRUE(wireless);
  EXPECT_EQ(wireless->id.text(), "8A21");
  EXPECT_EQ(wireless->buttons, 0b101u);
  EXPECT_EQ(wireless->orientation.x(), 1.0);
  const ServiceGrip* const wired = state.grip_of(0, "61576");
  ASSERT_TRUE(wired);
  EXPECT_EQ(wired->buttons, 0b11u);
  EXPECT_EQ(wired->orientation.y(), -0.5);
  EXPECT_EQ(state.grip_of(0, "none"), nullptr);
  EXPECT_EQ(state.grip_of(1, ""), nullptr);
}

TEST(ServiceState, WhatIsLeftOutKeepsItsValue) {
  ServiceState state;
  ASSERT_TRUE(state.take(PaddedMessage(kSnapshot)));
  // No id, and one coordinate only.
  ASSERT_TRUE(state.take(PaddedMessage(R"({"inverse3":[{"state":{"cursor_position":{"y":0.3}}}]})")));
  const ServiceArm& arm = state.arms()[0];
  EXPECT_EQ(arm.position, Vector3(0.01, 0.3, 0.2));
  EXPECT_EQ(arm.velocity, Vector3(0, 0.5, -1));
  EXPECT_FALSE(arm.powered);
  EXPECT_EQ(arm.told, state.taken());
  ASSERT_TRUE(state.take(PaddedMessage(R"({"wireless_verse_grip":[{"state":{"buttons":{"b":true}}}]})")));
  EXPECT_EQ(state.grip_of(0, "")->buttons, 0b111u);
  EXPECT_LT(arm.told, state.taken()) << "it was not mentioned";
  ASSERT_TRUE(state.take(PaddedMessage(R"({"inverse3":[{}]})")));
  EXPECT_EQ(arm.told, state.taken()) << "it was, though with nothing new";
  for (const char* const nothing :
       {"{}", R"({"inverse3":null})", R"({"inverse3":[]})", R"({"inverse3":[{"state":null,"status":null}]})",
        R"({"other":[1,{"a":{}}]})"})
    EXPECT_TRUE(state.take(PaddedMessage(nothing))) << nothing;
  EXPECT_EQ(arm.position, Vector3(0.01, 0.3, 0.2));
}

TEST(ServiceState, DevicesAreToldApartByIdAndThenByPlace) {
  ServiceState state;
  ASSERT_TRUE(state.take(
      PaddedMessage(R"({"inverse3":[{"device_id":"A","state":{"cursor_position":{"x":1,"y":1,"z":1}}},)"
                    R"({"device_id":"B","state":{"cursor_position":{"x":2,"y":2,"z":2}}}]})")));
  ASSERT_TRUE(state.take(PaddedMessage(R"({"inverse3":[{},{"state":{"cursor_position":{"x":3}}}]})")));
  EXPECT_EQ(state.arms()[1].position.x(), 3.0);
  // The other way around from now on.
  ASSERT_TRUE(state.take(PaddedMessage(R"({"inverse3":[{"device_id":"B"},{"device_id":"A"}]})")));
  ASSERT_TRUE(state.take(PaddedMessage(R"({"inverse3":[{"state":{"cursor_position":{"x":4}}}]})")));
  EXPECT_EQ(state.arms()[1].position.x(), 4.0);
  EXPECT_EQ(state.arms()[0].position.x(), 1.0);
  // A place that nothing has been named for is nobody's; one device too many is left out.
  ASSERT_TRUE(
      state.take(PaddedMessage(R"({"inverse3":[{},{},{},{},{},{"state":{"cursor_position":{"x":9}}}]})")));
  ASSERT_TRUE(state.take(PaddedMessage(
      R"({"inverse3":[{"device_id":"C"},{"device_id":"D"},{"device_id":"E"},{"device_id":"A"}]})")));
  EXPECT_EQ(state.arms().size(), ServiceState::kMostArms);
}

TEST(ServiceState, NothingOfAMessageThatMakesNoSenseCounts) {
  ServiceState state;
  ASSERT_TRUE(state.take(PaddedMessage(kSnapshot)));
  const std::string good = R"({"inverse3":[{"state":{"cursor_position":{"x":9}}}],)";
  std::uint64_t refused = 0;
  for (const std::string& rest :
       {std::string(), std::string("}}"), std::string("\"a\":1"), std::string("\"a\":nan}"),
        std::string("\"verse_grip\":5}"), std::string(R"("verse_grip":[5]})"),
        std::string(R"("inverse3":[{"state":{"cursor_position":{"x":"1"}}}]})"),
        std::string(R"("inverse3":[{"state":{"cursor_position":{"x":null}}}]})"),
        std::string(R"("inverse3":[{"state":{"cursor_position":{"x":1e999}}}]})"),
        std::string(R"("inverse3":[{"state":{"cursor_velocity":[1,2,3]}}]})"),
        std::string(R"("inverse3":[{"state":7}]})"), std::string(R"("inverse3":[{"device_id":7}]})"),
        std::string(R"("inverse3":[{"device_id":""}]})"),
        std::string(R"("inverse3":[{"device_id":"a\"b"}]})"),
        std::string(R"("inverse3":[{"device_id":")") + std::string(41, 'a') + R"("}]})",
        std::string(R"("wireless_verse_grip":[{"state":{"orientation":{"w":true}}}]})"),
        "\"deep\":" + std::string(100, '[') + std::string(100, ']') + "}",
        std::string("\"bytes\":\"\xff\xfe\"}")}) {
    EXPECT_FALSE(state.take(PaddedMessage(good + rest))) << good + rest;
    EXPECT_EQ(state.refused(), ++refused);
    EXPECT_EQ(state.arms()[0].position.x(), 0.01);
  }
  for (const char* const nothing : {"", " ", "null", "7", "[]", "\"text\"", "{", "{}{}", "{} x"})
    EXPECT_FALSE(state.take(PaddedMessage(nothing))) << nothing;
  const std::string all = kSnapshot;
  for (std::size_t size = 0; size < all.size(); ++size)
    EXPECT_FALSE(state.take(PaddedMessage(all.substr(0, size)))) << size;
  EXPECT_EQ(state.taken(), 1u);
}

TEST(ServiceState, AnEnormousMessageIsRefused) {
  ServiceState state;
  const std::string fits = "{\"a\":\"" + std::string(WebSocket::kMostBytes - 8, 'x') + "\"}";
  EXPECT_TRUE(state.take(PaddedMessage(fits)));
  EXPECT_FALSE(state.take(PaddedMessage("{\"a\":\"" + std::string(WebSocket::kMostBytes - 7, 'x') + "\"}")));
  // As many numbers as there is room for.
  std::string numbers = "{\"a\":[0";
  while (numbers.size() + 4 < WebSocket::kMostBytes) numbers += ",0";
  EXPECT_TRUE(state.take(PaddedMessage(numbers + "]}")));
}

TEST(ServiceState, TakesNoMemory) {
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "a sanitizer needs the memory functions";
  ServiceState state;
  const PaddedMessage whole(kSnapshot);
  const PaddedMessage part(
      R"({"inverse3":[{"state":{"cursor_position":{"x":0.123456789,"y":1e-3,"z":7}}}]})");
  const PaddedMessage broken(R"({"inverse3":[{"state":{"cursor_position":{"x":0.123456789,)");
  ASSERT_TRUE(state.take(whole));
  realtime::RealtimeGuard guard;
  for (int i = 0; i < 1000; ++i) {
    state.take(whole);
    state.take(part);
    state.take(broken);
  }
  guard.stop();
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_EQ(guard.frees(), 0u);
  EXPECT_EQ(guard.locks(), 0u);
  EXPECT_EQ(state.refused(), 1000u);
}

TEST(ServiceVersion, IsReadFromEitherField) {
  const auto read = [](const char* answer) {
    const ServiceVersion version = read_service_version(answer);
    return version.text + " " + std::to_string(version.major) + "." + std::to_string(version.minor);
  };
  EXPECT_EQ(read(R"({"git_tag":"v3.4.2","project_version":"3.5.0"})"), "3.5.0 3.5");
  EXPECT_EQ(read(R"({"git_tag":"v3.4.2-7-gabc"})"), "v3.4.2-7-gabc 3.4");
  EXPECT_EQ(read(R"({"git_tag":"release-12.3","project_version":"main"})"), "release-12.3 12.3");
  EXPECT_EQ(read(R"({"project_version":"nightly 7"})"), "nightly 7 0.0");
  EXPECT_EQ(read(R"({"project_version":99999999999999999999.5})"), " 0.0");
  EXPECT_EQ(read(R"({"project_version":"99999999999999999999.5"})"), "99999999999999999999.5 0.0");
  EXPECT_EQ(read("[]"), " 0.0");
  EXPECT_EQ(read(""), " 0.0");
}

TEST(ServiceEvent, IsReadOrNothing) {
  const auto event =
      read_service_event(R"({"name":"device-safety-triggered","category":"device","level":"warning",)"
                         R"("data":{"device_family":"inverse","device_id":"049D"},"message":"stall"})");
  ASSERT_TRUE(event);
  EXPECT_EQ(event->name, "device-safety-triggered");
  EXPECT_EQ(event->device_id, "049D");
  EXPECT_EQ(event->message, "stall");
  EXPECT_TRUE(read_service_event(R"({"name":"a","data":[1],"message":7})"));
  for (const char* const none : {"", "[]", "{}", R"({"name":7})", R"({"name":"a")"})
    EXPECT_FALSE(read_service_event(none)) << none;
}

}  // namespace
}  // namespace icome::devices
