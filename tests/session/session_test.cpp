// A session as the desktop, tools and studies drive it.
#include "session/session.h"

#include <gtest/gtest.h>

#include <limits>

#include "world/sample_world.h"

namespace icome::session {
namespace {

using base::Vector3;
using world::at;
using world::box;

SessionSettings quiet_settings() {
  SessionSettings settings;
  settings.realtime_priority = false;
  return settings;
}

std::unique_ptr<Session> start(SessionSettings settings = quiet_settings()) {
  auto session = Session::create(std::move(settings));
  EXPECT_TRUE(session) << session.error().message;
  return std::move(*session);
}

/// Adds a box of 1 m there, in one action.
world::ObjectId add_box(Session& session, const base::Affine3& place, const std::string& name = "box") {
  const auto shape = session.ids().next<world::GeometryId>();
  const auto id = session.ids().next<world::ObjectId>();
  world::PhysicalObject object{.name = name, .parent_from_object = place, .geometry = shape};
  const auto done = session.perform(
      world::EditGroup{{world::CreateGeometry{shape, box(1.0)}, world::CreateObject{id, 0, object}}},
      "Add " + name);
  EXPECT_TRUE(done) << done.error().message;
  return id;
}

TEST(Session, ShowsAndFeelsWhatIsEdited) {
  const auto session = start();
  session->settle();
  EXPECT_EQ(session->drawn()->object_count(), 0U);
  const auto id = add_box(*session, at(0.0, 0.0, -3.0));
  session->settle();
  ASSERT_EQ(session->drawn()->object_count(), 1U);
  EXPECT_EQ(session->drawn()->bounds().center(), Vector3(0.0, 0.0, -3.0));
  ASSERT_TRUE(session->perform(world::PlaceObject{id, at(2.0, 0.0, 0.0)}, "Move box"));
  session->settle();
  EXPECT_EQ(session->drawn()->bounds().center(), Vector3(2.0, 0.0, 0.0));
  ASSERT_TRUE(session->undo());
  session->settle();
  EXPECT_EQ(session->drawn()->bounds().center(), Vector3(0.0, 0.0, -3.0));
  ASSERT_TRUE(session->undo());
  session->settle();
  EXPECT_EQ(session->drawn()->object_count(), 0U);
  EXPECT_FALSE(session->undo());
  EXPECT_EQ(session->history().redo_name(), "Add box");
}

TEST(Session, KnowsWhetherClosingLosesSomething) {
  const auto session = start();
  EXPECT_FALSE(session->modified());
  const auto id = add_box(*session, at(0.0, 0.0, -3.0));
  EXPECT_TRUE(session->modified());
  ASSERT_TRUE(session->undo());
  EXPECT_FALSE(session->modified());
  ASSERT_TRUE(session->redo());
  ASSERT_TRUE(session->extend(world::PlaceObject{id, at(2.0, 0.0, 0.0)}));
  EXPECT_TRUE(session->modified());
  ASSERT_TRUE(session->undo());
  EXPECT_FALSE(session->modified());
}

TEST(Session, RefusesWhatMakesNoSense) {
  const auto session = start();
  const auto id = add_box(*session, at(0.0, 0.0, -3.0));
  const std::uint64_t before = world::hash(session->world());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(session->perform(world::PlaceObject{id, at(nan, 0.0, 0.0)}, "Move box"));
  EXPECT_FALSE(session->extend(world::PlaceObject{id, at(nan, 0.0, 0.0)}));
  ASSERT_TRUE(session->undo());
  EXPECT_FALSE(session->extend(world::PlaceObject{id, at(1.0, 0.0, 0.0)}));
  ASSERT_TRUE(session->redo());
  EXPECT_EQ(world::hash(session->world()), before);
  EXPECT_EQ(session->history().undo_name(), "Add box");
}

}  // namespace
}  // namespace icome::session
