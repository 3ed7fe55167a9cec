#include "interaction/snapping/snapped_move.h"

#include "interaction/snapping/clutter.h"
#include "interaction/snapping/snap_feel.h"
#include "world/edit/history.h"

namespace icome::interaction {
namespace {

/// A table top at 0.7 m and a crate in the air.
struct Workshop {
  Clutter clutter;
  ObjectId top = clutter.add(solid(geometry::Box{{0.6, 0.02, 0.4}}), at(0.0, 0.68, 0.0));
  ObjectId group =
      clutter.add(nullptr, at(0.0, 0.5, 0.0) * turned(0.7, {1.0, 2.0, 0.0}) * Eigen::Scaling(2.0));
  ObjectId crate = clutter.add(solid(geometry::Box{{0.1, 0.1, 0.1}}),
                               world_from_object(clutter.world, group).inverse() * at(0.3, 1.0, 0.2), group);
  CollisionIndex index{clutter.world};
  SnapFinder finder;

  Vector3 crate_at() const { return world_from_object(clutter.world, crate).translation(); }
  void apply(const world::Edit& edit) {
    applied(clutter.world, edit);
    index.follow(clutter.world, changes_of(edit));
    finder.follow(changes_of(edit));
  }
};

TEST(SnappedMove, PutsACornerOnACornerWithoutGoingThrough) {
  Workshop shop;
  const std::vector<ObjectId> crate = {shop.crate};
  // Wanted with its lower corner nearly at that of the table, and a little below the top: it stops, and
  // snaps.
  const Vector3 wanted = Vector3(0.495, 0.79, 0.31) - shop.crate_at();
  const auto move =
      snapped_move(shop.clutter.world, shop.index, shop.finder, crate, wanted, {.snaps = {.radius = 0.02}});
  ASSERT_TRUE(move);
  ASSERT_TRUE(move->snap);
  EXPECT_EQ(move->snap->snap.kind, SnapKind::Vertex);
  EXPECT_EQ(move->snap->snap.object, shop.top);
  EXPECT_LT((shop.crate_at() + move->move.offset - Vector3(0.5, 0.8, 0.3)).norm(), 1e-6);
  EXPECT_NEAR(shop.crate_at().y() + move->free.y(), 0.8, 1e-6);
  shop.apply(ObjectMove(shop.clutter.world, crate).by(move->move.offset));
  EXPECT_FALSE(shop.index.overlaps(shop.crate));
}

TEST(SnappedMove, DoesNotSnapWhereItWouldGoThroughSomething) {
  Workshop shop;
  const std::vector<ObjectId> crate = {shop.crate};
  // Its middle is near the face, but cannot get there.
  const Vector3 wanted = Vector3(0.1, 0.805, 0.0) - shop.crate_at();
  const auto move = snapped_move(
      shop.clutter.world, shop.index, shop.finder, crate, wanted,
      {.snaps = {.radius = 0.11}, .handles = {.origins = true, .box = false, .vertices = false}});
  ASSERT_TRUE(move);
  EXPECT_FALSE(move->snap);
  EXPECT_EQ(move->move.offset, wanted);
}

TEST(LandObjects, MakesAnEditThatCanBeUndone) {
  Workshop shop;
  const std::uint64_t before = hash(shop.clutter.world);
  const auto edit = land_objects(shop.clutter.world, shop.index, std::vector{shop.crate});
  ASSERT_TRUE(edit);
  world::History history;
  ASSERT_TRUE(history.perform(shop.clutter.world, *edit, "Land"));
  shop.index.follow(shop.clutter.world, changes_of(*edit));
  EXPECT_NEAR(shop.crate_at().y(), 0.8, 1e-9);
  EXPECT_FALSE(shop.index.overlaps(shop.crate));
  ASSERT_TRUE(history.undo(shop.clutter.world));
  EXPECT_EQ(hash(shop.clutter.world), before);
  EXPECT_FALSE(land_objects(shop.clutter.world, shop.index, std::vector{shop.top}));
}

TEST(StoppedDrag, StaysOnTheTableWhileTheHandGoesThroughItAndComesBack) {
  Workshop shop;
  const Vector3 start = shop.crate_at();
  StoppedDrag drag(shop.clutter.world, std::vector{shop.crate});
  const DragRules stops{.snaps = SnapSettings::none()};
  for (int i = 1; i <= 60; ++i) {
    // Down through the table top and on below it, along it all the while.
    const Vector3 wanted(-0.004 * i, -0.02 * i, 0.0);
    const auto edit = drag.to(shop.clutter.world, shop.index, shop.finder, wanted, stops);
    ASSERT_TRUE(edit);
    shop.apply(*edit);
    ASSERT_FALSE(shop.index.overlaps(shop.crate)) << i;
    EXPECT_NEAR(shop.crate_at().y(), std::max(0.8, start.y() + wanted.y()), 1e-6);
    EXPECT_NEAR(shop.crate_at().x(), start.x() + wanted.x(), 1e-6);
    EXPECT_EQ(drag.wanted(), wanted);
    // What is felt holds against going on down.
    const Vector3 force = contact_force(drag.wanted(), drag.free(), Vector3::Zero(), {});
    EXPECT_EQ(force.y() > 0.0, wanted.y() < -0.2 - 1e-6) << i;
  }
  const auto back = drag.to(shop.clutter.world, shop.index, shop.finder, Vector3::Zero(), stops);
  shop.apply(*back);
  EXPECT_LT((shop.crate_at() - start).norm(), 1e-15);
  EXPECT_FALSE(drag.to(shop.clutter.world, shop.index, shop.finder, Vector3(NAN, 0.0, 0.0), stops));
  EXPECT_EQ(drag.wanted(), Vector3::Zero());
}

TEST(StoppedDrag, SnapsAndLetsGo) {
  Workshop shop;
  const Vector3 start = shop.crate_at();
  StoppedDrag drag(shop.clutter.world, std::vector{shop.crate});
  const auto drag_to = [&](const Vector3& place) {
    const auto edit =
        drag.to(shop.clutter.world, shop.index, shop.finder, place - start, {.snaps = {.radius = 0.02}});
    ASSERT_TRUE(edit);
    shop.apply(*edit);
    ASSERT_FALSE(shop.index.overlaps(shop.crate));
  };
  drag_to({0.495, 0.81, 0.31});
  ASSERT_TRUE(drag.snap());
  EXPECT_LT((shop.crate_at() - Vector3(0.5, 0.8, 0.3)).norm(), 1e-6);
  EXPECT_LT((start + drag.free() - Vector3(0.495, 0.81, 0.31)).norm(), 1e-12);
  drag_to({0.4, 1.3, 0.2});
  EXPECT_FALSE(drag.snap());
  EXPECT_LT((shop.crate_at() - Vector3(0.4, 1.3, 0.2)).norm(), 1e-12);
}

/// A crate that is dragged in the workshop.
struct CrateDrag {
  Workshop shop;
  Vector3 start = shop.crate_at();
  StoppedDrag drag{shop.clutter.world, std::vector{shop.crate}};

  void to(const Vector3& offset, const DragRules& rules) {
    const auto edit = drag.to(shop.clutter.world, shop.index, shop.finder, offset, rules);
    ASSERT_TRUE(edit) << edit.error().message;
    shop.apply(*edit);
  }
  Vector3 offset() const { return shop.crate_at() - start; }
};

TEST(StoppedDrag, DoesNotGoInBySoLittleThatItCountsAsArrived) {
  for (const double in : {1e-8, 1e-7, 3e-7}) {
    CrateDrag drag;
    drag.to({0.0, -0.2 - in, 0.0}, {.snaps = SnapSettings::none()});
    EXPECT_FALSE(drag.shop.index.overlaps(drag.shop.crate)) << in;
    EXPECT_NEAR(drag.offset().y(), -0.2, 1e-6);
  }
}

TEST(StoppedDrag, DoesNotCreepWhereItRests) {
  CrateDrag drag;
  drag.to({0.05, -0.5, 0.0}, {.snaps = SnapSettings::none()});
  const Vector3 rests = drag.drag.offset();
  for (int i = 0; i < 5; ++i) {
    drag.to({0.05, -0.6 - i, 0.0}, {.snaps = SnapSettings::none()});
    EXPECT_EQ(drag.drag.offset(), rests);
    EXPECT_FALSE(drag.drag.contacts().empty());
  }
}

TEST(StoppedDrag, GoesThroughEverythingIfThatIsWanted) {
  CrateDrag drag;
  drag.to({0.0, -0.3, 0.0}, {.stops = {.stop = false}, .snaps = SnapSettings::none()});
  EXPECT_TRUE(drag.shop.index.overlaps(drag.shop.crate));
  EXPECT_LT((drag.offset() - Vector3(0.0, -0.3, 0.0)).norm(), 1e-12);
  EXPECT_TRUE(drag.drag.contacts().empty());
  // It snaps all the same: the corner that is 1 mm from the table's lower one.
  CrateDrag snapped;
  snapped.to({0.201, -0.24, 0.101}, {.stops = {.stop = false}, .snaps = {.radius = 0.003}});
  EXPECT_LT((snapped.offset() - Vector3(0.2, -0.24, 0.1)).norm(), 1e-9);
  EXPECT_TRUE(snapped.drag.snap());
}

TEST(StoppedDrag, TellsWhatHoldsItWhereItSnaps) {
  CrateDrag drag;
  drag.to({0.195, -0.25, 0.11}, {.snaps = {.radius = 0.02}});
  ASSERT_TRUE(drag.drag.snap());
  EXPECT_LT((drag.offset() - Vector3(0.2, -0.2, 0.1)).norm(), 1e-6);
  ASSERT_EQ(drag.drag.contacts().size(), 1U);
  EXPECT_LT((drag.drag.contacts()[0].normal - Vector3::UnitY()).norm(), 1e-9);
  EXPECT_NEAR(drag.drag.free().y(), -0.2, 1e-6);
}

TEST(StoppedDrag, KeepsToALineAlsoAtSurfaces) {
  CrateDrag drag;
  const Vector3 slope = Vector3(1.0, -1.0, 0.0).normalized();
  const DragRules plain{.snaps = SnapSettings::none()};
  const DragRules rules{.snaps = SnapSettings::none(), .axis = slope};
  drag.to(0.5 * slope, rules);
  EXPECT_LT((drag.offset() - Vector3(0.2, -0.2, 0.0)).norm(), 1e-5) << "it does not slide along the table";
  EXPECT_FALSE(drag.drag.contacts().empty());
  drag.to(0.1 * slope, rules);
  EXPECT_LT((drag.offset() - 0.1 * slope).norm(), 1e-12);
  // From beside the line it comes back to it first.
  drag.to({0.1, -0.9, 0.1}, plain);
  drag.to(-0.1 * slope, rules);
  EXPECT_LT((drag.offset() + 0.1 * slope).norm(), 1e-12);
  drag.to({0.0, -0.9, 0.0}, plain);
  drag.to(0.5 * slope, rules);
  EXPECT_FALSE(drag.shop.index.overlaps(drag.shop.crate));
  EXPECT_FALSE(drag.drag.contacts().empty()) << "the line leads through the table";
}

TEST(StoppedDrag, SnapsAlongALine) {
  CrateDrag drag;
  const DragRules along_x{.snaps = {.radius = 0.02}, .axis = Vector3::UnitX()};
  drag.shop.clutter.add(solid(geometry::Box{{0.1, 0.1, 0.1}}), at(0.85, 1.005, 0.205));
  drag.shop.index = CollisionIndex(drag.shop.clutter.world);
  // Towards the side of the other, whose corners are 7 mm off the line.
  drag.to({0.345, 0.0, 0.0}, along_x);
  EXPECT_TRUE(drag.drag.snap());
  EXPECT_LT((drag.offset() - Vector3(0.35, 0.0, 0.0)).norm(), 1e-6);
  // A turned face: to where the line meets it.
  CrateDrag other;
  const Affine3 leaning = at(1.0, 1.0, 0.2) * turned(0.5, Vector3::UnitZ());
  other.shop.clutter.add(solid(geometry::Box{{0.3, 0.6, 0.6}}), leaning);
  other.shop.index = CollisionIndex(other.shop.clutter.world);
  const DragRules to_faces{.stops = {.stop = false},
                           .snaps = {.radius = 0.02, .vertices = false, .middles = false, .edges = false},
                           .handles = {.box = false, .vertices = false},
                           .axis = Vector3::UnitX()};
  const double meets = 1.0 - 0.3 / std::cos(0.5) - 0.3;
  other.to({meets - 0.01, 0.0, 0.0}, to_faces);
  ASSERT_TRUE(other.drag.snap());
  EXPECT_LT((other.offset() - Vector3(meets, 0.0, 0.0)).norm(), 1e-9);
}

}  // namespace
}  // namespace icome::interaction
