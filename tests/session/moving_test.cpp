// What a hand feels of what it moves: surfaces that stop it, snaps that pull, and weight.
#include <cmath>

#include "geometry/csg/csg_tree.h"
#include "geometry/primitive/primitive.h"
#include "session/sessions.h"
#include "world/collision/collisions.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::session {
namespace {

using base::Vector3;

/// A device the tip of which rests on a box of 0.2 m, pressing a little; a wall 0.1 m to the right of it.
class MovingTest : public ::testing::Test {
 protected:
  static constexpr double kGap = 0.1;  // m

  void SetUp() override {
    SessionSettings settings = quiet_settings();
    auto device = hand_at(Vector3(0.0, 1.0, 0.0));
    hand_ = device.get();
    settings.pointers.push_back(std::move(device));
    session_ = start(std::move(settings));
    box_ = add_shape(*session_, world::box(0.2), world::at(0.0, 0.0, 0.0));
    wall_ = add_shape(*session_, world::box(2.0), world::at(1.1 + kGap, 0.0, 0.0), "wall");
    session_->settle();
    offset_ = stage_offset(*session_, Vector3(0.0, 1.0, 0.0));
    hand_->put(to_device(Vector3(0.0, 0.2, 0.0)));
    aim(Vector3(0.0, 0.099, 0.0));
    run_until(*session_, [&] { return session_->hands().touched(0) == box_; });
  }

  Vector3 to_device(const Vector3& place) const { return place - offset_; }
  void aim(const Vector3& place) { hand_->set_target(to_device(place)); }
  void come_to_rest() {
    Vector3 before = Vector3::Constant(1e9);
    std::int64_t seen = 0;  // ns
    for (int still = 0; still < 20;) {
      session_->update();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      constexpr std::int64_t kApart = 5'000'000;  // ns, whatever the machine does beside
      const PointerView& now = session_->hands().pointer(0);
      if (now.time < seen + kApart) continue;
      still = (now.tip - before).norm() < 2e-5 ? still + 1 : 0;
      before = now.tip;
      seen = now.time;
    }
  }
  /// With nothing that pulls but what the settings say.
  void grab(GrabSettings settings = {}) {
    settings.pull_back = false;
    session_->hands().set_grab(settings);
    come_to_rest();
    hand_->hold_buttons(1);
    run_until(*session_, [&] { return session_->hands().holds(0); });
    start_ = session_->hands().pointer(0).tip;
  }
  /// Leads the hand so far off where it took hold; with no more force than the device can hold for long.
  void lead(const Vector3& way) {
    aim(start_ + way);
    come_to_rest();
  }
  Vector3 force() const { return session_->hands().pointer(0).force; }
  Vector3 way() const { return session_->hands().pointer(0).tip - start_; }
  Vector3 box_at() const { return session_->world().find(box_)->parent_from_object.translation(); }
  void expect_no_overlap() const {
    world::CollisionIndex index(session_->world());
    EXPECT_FALSE(index.overlaps(box_));
  }

  devices::SimulatedDevice* hand_ = nullptr;
  std::unique_ptr<Session> session_;
  Vector3 offset_ = Vector3::Zero();  // of the stage from the device
  world::ObjectId box_, wall_;
  Vector3 start_ = Vector3::Zero();  // of the tip, as it took hold
};

TEST_F(MovingTest, AHeldBoxStopsAtAWallThatIsFelt) {
  grab();
  lead({kGap + 0.002, 0.0, 0.0});
  EXPECT_NEAR(box_at().x(), kGap, 1e-5);
  expect_no_overlap();
  const double shallow = -force().x();
  const double shallow_depth = way().x() - kGap;
  EXPECT_GT(shallow, 0.05);
  EXPECT_GT(shallow_depth, 0.0);
  lead({kGap + 0.005, 0.0, 0.0});
  expect_no_overlap();
  const double deep = -force().x();
  EXPECT_GT(deep, 1.5 * shallow) << "the deeper the stronger";
  EXPECT_GT(way().x() - kGap, shallow_depth);
  EXPECT_NEAR(deep / (way().x() - kGap), shallow / shallow_depth, 0.35 * deep / (way().x() - kGap))
      << "a spring";
  EXPECT_NEAR(force().y(), 0.0, 0.1);
  lead({0.05, 0.0, 0.0});
  EXPECT_LT(force().norm(), 0.1) << "away from the wall it is free";
  EXPECT_NEAR(box_at().x(), 0.05, 0.005);
}

TEST_F(MovingTest, AHeldBoxSlidesAlongAWallAndOneUndoBringsItHome) {
  grab();
  lead({kGap + 0.004, 0.0, 0.0});
  lead({kGap + 0.004, 0.15, 0.0});
  EXPECT_NEAR(box_at().x(), kGap, 1e-5);
  EXPECT_NEAR(box_at().y(), 0.15, 0.005);
  EXPECT_LT(force().x(), -0.1);
  EXPECT_NEAR(force().y(), 0.0, 0.1) << "no friction";
  expect_no_overlap();
  hand_->hold_buttons(0);
  run_until(*session_, [&] { return !session_->hands().holds(0); });
  EXPECT_EQ(session_->history().undo_name(), "Move box");
  ASSERT_TRUE(session_->history().undo());
  EXPECT_EQ(box_at(), Vector3::Zero());
  EXPECT_EQ(session_->history().undo_name(), "Add wall");
}

TEST_F(MovingTest, GoesThroughWallsIfThatIsWanted) {
  grab({.stop = false});
  lead({kGap + 0.05, 0.0, 0.0});
  EXPECT_NEAR(box_at().x(), kGap + 0.05, 0.002);
  EXPECT_LT(force().norm(), 0.1);
}

TEST_F(MovingTest, StopsAtWhatHasComeSinceItsSurroundingsWereLookedAt) {
  grab();
  lead({0.0, 0.01, 0.0});
  hand_->hold_buttons(0);
  run_until(*session_, [&] { return !session_->hands().holds(0); });
  ASSERT_TRUE(session_->history().undo());
  ASSERT_TRUE(session_->history().perform(world::PlaceObject{wall_, world::at(9.0, 0.0, 0.0)}, "Move wall"));
  add_shape(*session_, world::box(0.2), world::at(0.0, 0.24, 0.0), "lid");
  session_->settle();
  aim(Vector3(0.0, 0.099, 0.0));
  run_until(*session_, [&] { return session_->hands().touched(0) == box_; });
  grab();
  lead({0.15, 0.0, 0.0});
  EXPECT_NEAR(box_at().x(), 0.15, 0.005) << "the wall is gone";
  lead({0.0, 0.0, 0.0});
  lead({0.0, 0.043, 0.0});
  EXPECT_NEAR(box_at().y(), 0.04, 1e-5) << "the lid is there";
  expect_no_overlap();
}

TEST_F(MovingTest, ASnapPullsNearItAndNowhereElse) {
  // The grid has a place 20 mm to the right.
  GrabSettings settings;
  settings.snaps.grid = true;
  settings.snaps.spacing = 0.02;
  settings.snaps.radius = 0.006;
  settings.snap_strength = 0.25;
  grab(settings);
  lead({0.01, 0.0, 0.0});
  EXPECT_LT(force().norm(), 0.05) << "between two places";
  EXPECT_NEAR(box_at().x(), way().x(), 1e-3);
  // The hand's spring and the well come to rest between where the hand is led and the place.
  lead({0.0175, 0.0, 0.0});
  EXPECT_NEAR(box_at().x(), 0.02, 1e-9);
  const double weak = force().x();
  EXPECT_GT(weak, 0.05);
  EXPECT_LE(weak, 0.27) << "no more than its strength";
  settings.snap_strength = 1.0;
  settings.pull_back = false;
  session_->hands().set_grab(settings);
  lead({0.0174, 0.0, 0.0});
  EXPECT_GT(force().x(), 1.3 * weak) << "set stronger";
}

TEST_F(MovingTest, AFaceToSnapToPullsAcrossOnly) {
  GrabSettings settings;
  settings.stop = false;
  settings.snaps.faces = true;
  settings.snaps.radius = 0.01;
  grab(settings);
  lead({kGap - 0.004, 0.03, 0.0});
  EXPECT_NEAR(box_at().x(), kGap, 1e-9);
  EXPECT_GT(force().x(), 0.1);
  EXPECT_NEAR(force().y(), 0.0, 0.05);
  EXPECT_NEAR(box_at().y(), 0.03, 0.002);
}

TEST_F(MovingTest, WhatIsHeldHasItsWeight) {
  grab({.weight = 0.7});
  lead({-0.05, 0.1, 0.0});
  EXPECT_NEAR(force().y(), -0.7, 0.05);
  EXPECT_NEAR(force().x(), 0.0, 0.05);
}

TEST(ObjectDrag, KeepsToALineAndTellsWhatStopsIt) {
  const auto session = start();
  const auto box = add_shape(*session, world::box(0.2), world::at(0.0, 0.0, 0.0));
  const auto wall = add_shape(*session, world::box(2.0), world::at(1.2, 0.5, 0.0), "wall");
  const std::vector<world::ObjectId> objects{box};
  ObjectDrag drag(*session, objects, "Move box");
  const auto place = [&] { return session->world().find(box)->parent_from_object.translation(); };
  ASSERT_TRUE(drag.to(*session, {.offset = Vector3(0.5, 0.3, 0.0), .axis = Vector3::UnitX()}));
  EXPECT_NEAR(place().x(), 0.1, 1e-5);
  EXPECT_EQ(place().y(), 0.0) << "it does not slide off the line";
  EXPECT_EQ(drag.words(*session), "Stopped at wall");
  const auto revision = session->history().undo_name();
  ASSERT_TRUE(drag.to(*session, {.offset = Vector3(0.0, 0.3, 0.0)}));
  EXPECT_EQ(drag.words(*session), "");
  EXPECT_EQ(session->history().undo_name(), "Move box");
  EXPECT_FALSE(drag.to(*session, {.offset = Vector3(NAN, 0.0, 0.0)}));
  EXPECT_LT((place() - Vector3(0.0, 0.3, 0.0)).norm(), 1e-12);
  ASSERT_TRUE(session->history().undo());
  EXPECT_EQ(place(), Vector3::Zero()) << "one action";
  (void)wall;
}

/// Of so many triangles that main does not wait for them.
world::GeometryPointer scan() {
  return std::make_shared<world::MeshGeometry>(geometry::tessellate(geometry::Sphere{0.1}, 1e-5));
}

TEST(ObjectDrag, ByThingsOfManyTrianglesIsWorkedOutBesideMain) {
  const auto session = start();
  const auto ball = add_shape(*session, scan(), world::at(0.0, 0.0, 0.0));
  add_shape(*session, scan(), world::at(0.5, 0.0, 0.0), "other");
  const std::vector<world::ObjectId> objects{ball};
  const auto place = [&] { return session->world().find(ball)->parent_from_object.translation(); };
  ObjectDrag drag(*session, objects, "Move ball");
  ASSERT_TRUE(drag.to(*session, {.offset = Vector3(0.35, 0.0, 0.0)}));
  ASSERT_TRUE(drag.pending());
  EXPECT_EQ(place(), Vector3::Zero()) << "where it is known that it may be";
  EXPECT_EQ(drag.words(*session), "Finding out how far it can go\u2026");
  // The hand goes on meanwhile; what counts is where it is in the end.
  ASSERT_TRUE(drag.to(*session, {.offset = Vector3(0.6, 0.0, 0.0)}));
  run_until(*session, [&] { return drag.go_on(*session).has_value() && !drag.pending(); });
  EXPECT_NEAR(place().x(), 0.3, 1e-3);
  world::CollisionIndex index(session->world());
  EXPECT_FALSE(index.overlaps(ball));
  EXPECT_EQ(drag.words(*session), "Stopped at other");
  ASSERT_TRUE(session->history().undo());
  EXPECT_EQ(place(), Vector3::Zero()) << "one action";
}

/// A hollow box, half of whose length is that (m): nobody waits until it is meshed.
world::GeometryPointer hollow(double half) {
  geometry::CsgTree tree;
  const auto whole = tree.add_leaf(geometry::Primitive(geometry::Box{Vector3::Constant(half)}));
  const auto hole = tree.add_leaf(geometry::Primitive(geometry::Box{Vector3::Constant(half - 0.01)}));
  tree.add(geometry::CsgOperator::Difference, whole, hole);
  return std::make_shared<world::CsgGeometry>(std::move(tree));
}

TEST(ObjectDrag, GetsThereAlthoughAllAroundMustBeMadeReadyFirst) {
  const auto session = start();
  const auto box = add_shape(*session, world::box(0.1), world::at(0.0, 0.0, 0.0));
  for (const double half : {0.3, 0.4, 0.5, 0.6, 0.7})
    add_shape(*session, hollow(half), world::at(0.0, 0.0, 0.0), "hollow");
  const std::vector<world::ObjectId> objects{box};
  ObjectDrag drag(*session, objects, "Move box");
  ASSERT_TRUE(drag.to(*session, {.offset = Vector3(0.1, 0.0, 0.0)}));
  ASSERT_TRUE(drag.pending());
  run_until(*session, [&] { return drag.go_on(*session).has_value() && !drag.pending(); });
  EXPECT_NEAR(session->world().find(box)->parent_from_object.translation().x(), 0.1, 1e-9);
}

TEST(ObjectDrag, WhatWasWorkedOutForAnotherWorldIsNotTaken) {
  const auto session = start();
  const auto ball = add_shape(*session, scan(), world::at(0.0, 0.0, 0.0));
  const auto other = add_shape(*session, scan(), world::at(9.0, 0.0, 0.0), "other");
  add_shape(*session, scan(), world::at(0.3, 0.17, 0.17), "passed closely");
  const std::vector<world::ObjectId> objects{ball};
  ObjectDrag drag(*session, objects, "Move ball");
  ASSERT_TRUE(drag.to(*session, {.offset = Vector3(0.6, 0.0, 0.0)}));
  ASSERT_TRUE(drag.pending());
  ASSERT_TRUE(session->history().perform(world::PlaceObject{other, world::at(0.5, 0.0, 0.0)}, "Move other"));
  run_until(*session, [&] { return drag.go_on(*session).has_value() && !drag.pending(); });
  world::CollisionIndex index(session->world());
  EXPECT_FALSE(index.overlaps(ball));
  EXPECT_NEAR(session->world().find(ball)->parent_from_object.translation().x(), 0.3, 1e-3);
}

TEST(ObjectDrag, CanBeLeftWhileItIsWorkedOut) {
  const auto session = start();
  const auto ball = add_shape(*session, scan(), world::at(0.0, 0.0, 0.0));
  const auto box = add_shape(*session, world::box(0.2), world::at(0.0, 1.0, 0.0));
  add_shape(*session, scan(), world::at(0.5, 0.0, 0.0), "other");
  const std::vector<world::ObjectId> objects{ball}, others{box};
  {
    ObjectDrag drag(*session, objects, "Move ball");
    ASSERT_TRUE(drag.to(*session, {.offset = Vector3(0.6, 0.0, 0.0)}));
    ASSERT_TRUE(drag.pending());
  }
  // The next one gets its turn as soon as the thread has let go.
  ObjectDrag drag(*session, others, "Move box");
  ASSERT_TRUE(drag.to(*session, {.offset = Vector3(0.0, 0.3, 0.0)}));
  run_until(*session, [&] { return drag.go_on(*session).has_value() && !drag.pending(); });
  EXPECT_NEAR(session->world().find(box)->parent_from_object.translation().y(), 1.3, 1e-9);
  EXPECT_EQ(session->world().find(ball)->parent_from_object.translation(), Vector3(Vector3::Zero()));
}

TEST(ObjectDrag, SnapsUnlessThatIsNotWanted) {
  const auto session = start();
  const auto box = add_shape(*session, world::box(0.2), world::at(0.0, 0.0, 0.0));
  add_shape(*session, world::box(0.2), world::at(1.0, 0.0, 0.0), "other");
  GrabSettings settings;
  settings.snaps = {.radius = 0.02};
  session->hands().set_grab(settings);
  const std::vector<world::ObjectId> objects{box};
  ObjectDrag drag(*session, objects, "Move box");
  const auto place = [&] { return session->world().find(box)->parent_from_object.translation(); };
  const Vector3 near(0.79, 0.005, 0.0);
  ASSERT_TRUE(drag.to(*session, {.offset = near}));
  EXPECT_LT((place() - Vector3(0.8, 0.0, 0.0)).norm(), 1e-6);
  EXPECT_EQ(drag.words(*session), "Snapped to a corner of other");
  ASSERT_TRUE(drag.to(*session, {.offset = near, .snap = false}));
  EXPECT_LT((place() - near).norm(), 1e-12);
}

}  // namespace
}  // namespace icome::session
