#include "collab/order/fitted_edit.h"

#include <gtest/gtest.h>

#include "collab/order/items.h"
#include "collab/order/world_bytes.h"
#include "world/random_edits.h"

namespace icome::collab {
namespace {

using world::ObjectId;

TEST(FittedEdit, PutsAnObjectBehindTheLastWhereThereAreTooFewSiblings) {
  world::World world;
  world::IdSource ids;
  const ObjectId first = world::add_object(world, ids, "first", nullptr);
  const ObjectId late = ids.next<ObjectId>();
  ASSERT_TRUE(apply_fitted(world, world::CreateObject{late, 9, {.name = "late"}}));
  EXPECT_EQ(world.roots(), (std::vector<ObjectId>{first, late}));
  ASSERT_TRUE(apply_fitted(world, world::MoveObject{first, {}, 5, world::Affine3::Identity()}));
  EXPECT_EQ(world.roots(), (std::vector<ObjectId>{late, first})) << "itself is not counted";
}

TEST(FittedEdit, AppliesAGroupWhollyOrNotAtAll) {
  world::World world;
  world::IdSource ids;
  const ObjectId one = ids.next<ObjectId>();
  const std::uint64_t before = hash(world);
  const world::EditGroup group{{world::CreateObject{one, 3, {}}, world::DeleteObject{ObjectId{77}}}};
  EXPECT_FALSE(apply_fitted(world, group));
  EXPECT_EQ(hash(world), before);
}

TEST(FittedEdit, IsTakenBackByItsInverse) {
  world::RandomEdits edits(3);
  world::World world;
  int applied = 0;
  for (int i = 0; i < 2'000; ++i) {
    const world::Edit edit = edits.next(world);
    const std::uint64_t before = hash(world);
    const auto done = apply_fitted(world, edit);
    if (!done) continue;
    ++applied;
    const auto again = world::apply(world, done->inverse);
    ASSERT_TRUE(again) << again.error().message;
    ASSERT_EQ(hash(world), before);
    ASSERT_TRUE(world::apply(world, *again));
  }
  EXPECT_GT(applied, 500);
}

TEST(WorldBytes, MakeAnEqualWorld) {
  world::RandomEdits edits(4);
  world::World world;
  for (int i = 0; i < 500; ++i) (void)world::apply(world, edits.next(world));
  const std::string bytes = world_to_bytes(world).value();
  const world::World again = world_from_bytes(bytes, {}).value();
  EXPECT_EQ(hash(again), hash(world));
  EXPECT_EQ(world_to_bytes(again).value(), bytes);
  EXPECT_FALSE(world_from_bytes(std::string_view(bytes).substr(0, bytes.size() - 8), {}));
}

TEST(Items, NameWhatAnEditNeedsButNotWhatItMakes) {
  world::World world;
  world::IdSource ids;
  const ObjectId table = world::add_object(world, ids, "table", nullptr);
  const ObjectId made = ids.next<ObjectId>(), below = ids.next<ObjectId>();
  const Needs needs = needs_of(world::EditGroup{
      {world::CreateObject{made, 0, {.parent = table}}, world::CreateObject{below, 0, {.parent = made}},
       world::RenameObject{made, "leg"}, world::PlaceObject{table, world::Affine3::Identity()}}});
  EXPECT_EQ(needs.items, std::vector<Item>{item_of(table)});
  EXPECT_EQ(needs.entered, std::vector<ObjectId>{table});
}

TEST(Items, SayWhatAnEditDoes) {
  EXPECT_EQ(edit_word(world::PlaceObject{}), "translate");
  EXPECT_EQ(edit_word(world::EditGroup{{world::CreateGeometry{}, world::CreateObject{}}}), "create");
  EXPECT_EQ(edit_word(world::EditGroup{}), "group");
}

}  // namespace
}  // namespace icome::collab
