#include "collab/client/divergence.h"

#include <gtest/gtest.h>

#include "collab/order/world_bytes.h"
#include "world/sample_world.h"

namespace icome::collab {
namespace {

using world::at;
using world::ObjectId;

/// A design with a table and its leg, and a lamp.
class DivergenceTest : public testing::Test {
 protected:
  DivergenceTest() {
    table_ = world::add_object(before_, ids_, "table", world::box(0.3));
    leg_ = world::add_object(before_, ids_, "leg", world::box(0.1), table_);
    lamp_ = world::add_object(before_, ids_, "lamp", world::box(0.2));
    now_ = before_;
  }
  void others(const world::Edit& edit) { ASSERT_TRUE(world::apply(now_, edit)); }
  std::vector<Item> conflicts(const std::vector<world::Edit>& own) const {
    std::vector<Item> items;
    for (const Conflict& it : conflicts_of(own, before_, now_)) items.push_back(it.item);
    return items;
  }

  world::IdSource ids_;
  world::World before_, now_;
  ObjectId table_, leg_, lamp_;
};

TEST_F(DivergenceTest, IsWhereBothChangedTheSameSideOfAThing) {
  const std::vector<world::Edit> own{world::PlaceObject{leg_, at(1, 0, 0)},
                                     world::RenameObject{lamp_, "light"},
                                     world::PlaceObject{leg_, at(2, 0, 0)}};
  EXPECT_TRUE(conflicts(own).empty());
  others(world::RenameObject{leg_, "foot"});
  EXPECT_TRUE(conflicts(own).empty()) << "another side of it";
  others(world::PlaceObject{leg_, at(0, 3, 0)});
  EXPECT_EQ(conflicts(own), std::vector<Item>{item_of(leg_)}) << "once";
  others(world::DeleteObject{lamp_});
  const auto both = conflicts_of(own, before_, now_);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_FALSE(both[0].is_gone);
  EXPECT_TRUE(both[1].is_gone);
}

TEST_F(DivergenceTest, IsNoneWhereOthersTookTheirsBack) {
  others(world::PlaceObject{leg_, at(0, 3, 0)});
  others(world::PlaceObject{leg_, before_.find(leg_)->parent_from_object});
  EXPECT_TRUE(conflicts({world::PlaceObject{leg_, at(1, 0, 0)}}).empty());
}

TEST_F(DivergenceTest, IsWhereOneDeletesWhatOthersChanged) {
  others(world::RenameObject{lamp_, "light"});
  EXPECT_EQ(conflicts({world::DeleteObject{lamp_}}), std::vector<Item>{item_of(lamp_)});
}

TEST_F(DivergenceTest, ComparesWhatThingsAreAndNotWhereTheyLieInMemory) {
  now_ = world_from_bytes(world_to_bytes(before_).value(), {}).value();
  const auto shape = before_.find(leg_)->geometry;
  const std::vector<world::Edit> own{world::ReplaceGeometry{shape, world::box(0.5)}};
  EXPECT_TRUE(conflicts(own).empty());
  others(world::ReplaceGeometry{shape, world::box(0.7)});
  EXPECT_EQ(conflicts(own), std::vector<Item>{item_of(shape)});
}

TEST_F(DivergenceTest, CopiesAnObjectWithAllBelowItBesideTheOther) {
  world::World made = before_;
  ASSERT_TRUE(world::apply(made, world::PlaceObject{table_, at(5, 0, 0)}));
  others(world::PlaceObject{table_, at(0, 5, 0)});
  others(copy_into(made, table_, now_, ids_));
  ASSERT_EQ(now_.roots().size(), 3U);
  const world::PhysicalObject& copy = *now_.find(now_.roots().back());
  EXPECT_EQ(copy.name, "table (copy)");
  EXPECT_EQ(copy.parent_from_object.translation().x(), 5.0);
  ASSERT_EQ(copy.children.size(), 1U);
  EXPECT_EQ(now_.find(copy.children[0])->name, "leg");
  EXPECT_NE(now_.find(copy.children[0])->geometry, now_.find(leg_)->geometry) << "a shape of its own";
  EXPECT_EQ(now_.find(table_)->parent_from_object.translation().y(), 5.0);
}

TEST_F(DivergenceTest, CopiesAnObjectWhoseParentIsGoneToTheTop) {
  others(world::DeleteObject{leg_});
  others(world::DeleteObject{table_});
  others(copy_into(before_, leg_, now_, ids_));
  EXPECT_EQ(now_.find(now_.roots().back())->name, "leg (copy)");
}

}  // namespace
}  // namespace icome::collab
