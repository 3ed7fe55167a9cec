#include "interaction/object_move.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "world/edit/edit_bytes.h"
#include "world/edit/history.h"

namespace icome::interaction {
namespace {

using base::Affine3;
using base::Vector3;
using world::ObjectId;

/// A table with a leg (turned, stretched and mirrored in it) that has a foot; and a lamp.
struct TwoThings {
  world::World world;
  world::IdSource ids{1};
  ObjectId table = make("table", {}, place(1.0));
  ObjectId leg = make("leg", table, place(2.0));
  ObjectId foot = make("foot", leg, place(3.0));
  ObjectId lamp = make("", {}, place(4.0));

  static Affine3 place(double number) {
    return Affine3(Eigen::Translation3d(number, 2.0, -number)) *
           Eigen::AngleAxisd(number, Vector3(1.0, number, 2.0).normalized()) *
           Eigen::Scaling(0.5, number, -2.0);
  }
  ObjectId make(const char* name, ObjectId parent, const Affine3& where) {
    const auto id = ids.next<ObjectId>();
    world::PhysicalObject object;
    object.name = name;
    object.parent = parent;
    object.parent_from_object = where;
    EXPECT_TRUE(apply(world, world::CreateObject{id, 0, object}));
    return id;
  }
  Vector3 at(ObjectId id) const { return world_from_object(world, id).translation(); }
};

TEST(ObjectMove, GoesByTheOffsetWhateverTheParentsDo) {
  TwoThings room;
  const std::vector<ObjectId> moved = {room.foot, room.lamp};
  const ObjectMove move(room.world, moved);
  const Vector3 foot = room.at(room.foot), lamp = room.at(room.lamp), leg = room.at(room.leg);
  base::Random random(1);
  for (int i = 0; i < 20; ++i) {  // each step counts from the beginning
    const Vector3 offset = random.uniform(0.0, 2.0) * random.direction();
    ASSERT_TRUE(apply(room.world, move.by(offset)));
    EXPECT_TRUE((room.at(room.foot) - foot).isApprox(offset, 1e-12));
    EXPECT_TRUE((room.at(room.lamp) - lamp).isApprox(offset, 1e-12));
    EXPECT_EQ(room.at(room.leg), leg);
  }
}

TEST(ObjectMove, ADragIsOneStepBackHoweverManyItHad) {
  const std::vector<std::vector<ObjectId>> selections = {{TwoThings().foot},
                                                         {TwoThings().foot, TwoThings().lamp}};
  for (const std::vector<ObjectId>& moved : selections) {
    TwoThings room;
    const std::uint64_t before = hash(room.world);
    const ObjectMove move(room.world, moved);
    world::History history;
    ASSERT_TRUE(history.perform(room.world, move.by({0.1, 0.0, 0.0}), "Move"));
    base::Random random(2);
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(history.extend(room.world, move.by(random.direction())));
    const std::uint64_t after = hash(room.world);
    const auto undone = history.undo(room.world);
    ASSERT_TRUE(undone);
    EXPECT_EQ(hash(room.world), before);
    // It took no more than a drag of one step does.
    EXPECT_EQ(to_bytes(*undone)->size(), to_bytes(move.by({0.1, 0.0, 0.0}))->size());
    ASSERT_TRUE(history.redo(room.world));
    EXPECT_EQ(hash(room.world), after);
  }
}

TEST(ObjectMove, LeavesTurnAndStretchAlone) {
  TwoThings room;
  const auto before = world_from_object(room.world, room.foot).linear().eval();
  const ObjectMove move(room.world, std::vector{room.foot});
  ASSERT_TRUE(apply(room.world, move.by({0.1, 0.2, 0.3})));
  EXPECT_EQ(world_from_object(room.world, room.foot).linear(), before);
}

TEST(ObjectMove, MovesWhatIsSelectedAlongWithItsParentOnce) {
  TwoThings room;
  const std::vector<ObjectId> all = {room.foot, room.table, room.lamp, room.table};
  const ObjectMove move(room.world, all);
  EXPECT_EQ(move.objects(), (std::vector<ObjectId>{room.table, room.lamp}));
  const Vector3 foot = room.at(room.foot);
  ASSERT_TRUE(apply(room.world, move.by(Vector3::UnitX())));
  EXPECT_TRUE((room.at(room.foot) - foot).isApprox(Vector3::UnitX(), 1e-12));
}

TEST(ObjectMove, LeavesWhatParentsShrinkToNothing) {
  TwoThings room;
  ObjectId parent = {};
  for (int i = 0; i < 5; ++i) parent = room.make("", parent, Affine3(Eigen::Scaling(1e-100)));
  EXPECT_TRUE(ObjectMove(room.world, std::vector{parent}).empty());
}

TEST(ObjectMove, LeavesOutWhatIsGone) {
  TwoThings room;
  ASSERT_TRUE(apply(room.world, delete_subtree(room.world, room.table)));
  EXPECT_TRUE(ObjectMove(room.world, std::vector{room.leg, ObjectId{}}).empty());
}

}  // namespace
}  // namespace icome::interaction
