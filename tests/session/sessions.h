#pragma once
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>

#include "devices/simulated/simulated_device.h"
#include "session/session.h"
#include "world/sample_world.h"

namespace icome::session {

/// What tests can do without: a priority that few machines allow.
inline SessionSettings quiet_settings() {
  SessionSettings settings;
  settings.realtime_priority = false;
  return settings;
}

inline std::unique_ptr<Session> start(SessionSettings settings = quiet_settings()) {
  auto session = Session::create(std::move(settings));
  if (!session) throw std::runtime_error(session.error().message);
  return std::move(*session);
}

/// A hand that rests there.
inline std::unique_ptr<devices::SimulatedDevice> hand_at(const base::Vector3& place) {
  devices::SimulatedSettings settings;
  settings.start = place;
  return std::make_unique<devices::SimulatedDevice>(settings);
}

/// Adds an object of a shape there, in one action.
inline world::ObjectId add_shape(Session& session, world::GeometryPointer shape, const base::Affine3& place,
                                 const std::string& name = "box") {
  const auto geometry = session.ids().next<world::GeometryId>();
  const auto id = session.ids().next<world::ObjectId>();
  world::PhysicalObject object{.name = name, .parent_from_object = place, .geometry = geometry};
  const auto done = session.history().perform(
      world::EditGroup{{world::CreateGeometry{geometry, std::move(shape)},
                        world::CreateObject{id, session.world().roots().size(), object}}},
      "Add " + name);
  if (!done) throw std::runtime_error(done.error().message);
  return id;
}

inline world::ObjectId add_box(Session& session, const base::Affine3& place,
                               const std::string& name = "box") {
  return add_shape(session, world::box(1.0), place, name);
}

/// Goes on as a main loop does until that is so. A test that waits for ever says what it waits for by its
/// name.
template <typename IsSo>
std::vector<SessionEvent> run_until(Session& session, const IsSo& is_so) {
  std::vector<SessionEvent> events;
  for (;;) {
    for (SessionEvent& event : session.update()) events.push_back(std::move(event));
    if (is_so()) return events;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// Where the hand of device 0 has come to rest, in the stage's frame: it is the servo's to ask.
inline base::Vector3 tip_at_rest(Session& session) {
  constexpr std::int64_t kApart = 30'000'000;  // ns
  constexpr double kStill = 1e-6;              // m
  PointerView before = session.hands().pointer(0);
  run_until(session, [&] {
    const PointerView& now = session.hands().pointer(0);
    if (now.time < before.time + kApart) return false;
    const bool rests = before.time > 0 && (now.tip - before.tip).norm() < kStill;
    before = now;
    return rests;
  });
  return before.tip;
}

/// How far the stage's frame is off that of device 0, the hand of which rests at `start`: where the view has
/// put its workspace.
inline base::Vector3 stage_offset(Session& session, const base::Vector3& start) {
  return tip_at_rest(session) - start;
}

/// How many events of a kind there are.
inline std::size_t count(const std::vector<SessionEvent>& events, SessionEvent::Kind kind) {
  std::size_t result = 0;
  for (const SessionEvent& event : events) result += event.kind == kind ? 1 : 0;
  return result;
}

}  // namespace icome::session
