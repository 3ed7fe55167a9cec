// What changes with time is seen as it is felt: by one clock.
#include "session/display/render_follower.h"

#include <chrono>
#include <vector>

#include "session/sessions.h"
#include "world/shape/solid_geometry.h"

namespace icome::session {
namespace {

using base::Vector3;

constexpr double kExact = 1e-6;  // m: coordinates are drawn in single precision

/// A floor that rises by 0.1 mm a second, 0.1 m wide.
world::GeometryPointer rising_floor() {
  const base::Bounds box(Vector3::Constant(-0.05), Vector3::Constant(0.05));
  return *world::ImplicitGeometry::create("y-0.0001*t", box);
}

double drawn_height(const Session& session) {
  double height = -1.0;
  session.view().drawn()->for_each([&](const render::RenderItem& item) { height = item.bounds.max().y(); });
  return height;
}

double picked_height(const Session& session) {
  const auto picked = session.stage().pick({Vector3(0.01, 0.5, 0.01), -Vector3::UnitY()});
  return picked ? picked->place.point.y() : -1.0;
}

TEST(RenderFollower, WhatChangesIsDrawnAsItIsFelt) {
  const auto session = start();
  add_shape(*session, rising_floor(), base::Affine3::Identity(), "floor");
  session->settle();
  const auto wait_for_another = [&] {
    const render::RenderScenePointer before = session->view().drawn();
    run_until(*session, [&] {
      return session->view().drawn() != before && session->view().drawn()->object_count() == 1;
    });
  };
  wait_for_another();
  const double first = picked_height(*session);
  session->update();
  // What came first may have been begun before; the next one has not.
  wait_for_another();
  wait_for_another();
  const double drawn = drawn_height(*session), last = picked_height(*session);
  EXPECT_GT(first, 0.0);
  EXPECT_GT(last, first);
  EXPECT_GE(drawn, first - kExact);
  EXPECT_LE(drawn, last + kExact);
  EXPECT_NE(drawn, 0.0);
}

TEST(RenderFollower, WhatDoesNotChangeIsMadeOnce) {
  const auto session = start();
  add_box(*session, world::at(0.0, 0.0, 0.0));
  session->settle();
  const render::RenderScenePointer drawn = session->view().drawn();
  for (int i = 0; i < 100; ++i) {
    session->update();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(session->view().drawn(), drawn);
}

TEST(RenderFollower, GoesOnSoonAfterWorkThatWasHeldUp) {
  const auto session = start();
  add_shape(*session, rising_floor(), base::Affine3::Identity(), "floor");
  session->settle();
  DisplayFeed display(1);
  realtime::LatestValue<render::RenderScenePointer> newest;
  const std::vector<double> times{1.0, 31.0, 31.0};  // begun, done 30 s later, and asked at once
  std::size_t asked = 0;
  RenderFollower follower(
      display, newest, [&] { return times.at(asked++); }, true);
  follower.open(session->world(), {});
  follower.go_on(session->world());
  const auto pause = follower.pause(session->world());
  ASSERT_TRUE(pause);
  EXPECT_GT(*pause, std::chrono::milliseconds(500));
  EXPECT_LE(*pause, std::chrono::seconds(2));
}

}  // namespace
}  // namespace icome::session
