#include "interaction/object_edits.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "world/random_edits.h"

namespace icome::interaction {
namespace {

using world::ObjectId;
using world::World;

class ObjectEditsTest : public ::testing::Test {
 protected:
  ObjectId create(const std::string& name, ObjectId parent = {}, world::GeometryId shape = {}) {
    const ObjectId id = ids_.next<ObjectId>();
    const std::size_t last = parent ? world_.find(parent)->children.size() : world_.roots().size();
    do_it(world::CreateObject{id, last, {.name = name, .parent = parent, .geometry = shape}});
    return id;
  }
  void do_it(const world::Edit& edit) {
    const auto done = world::apply(world_, edit);
    ASSERT_TRUE(done) << done.error().message;
  }

  World world_;
  world::IdSource ids_;
};

TEST_F(ObjectEditsTest, DeletingFreesAShapeThatOnlyTheDeletedShare) {
  const auto shape = ids_.next<world::GeometryId>(), kept = ids_.next<world::GeometryId>();
  do_it(world::CreateGeometry{shape, world::box(1.0)});
  do_it(world::CreateGeometry{kept, world::box(2.0)});
  const ObjectId one = create("one", {}, shape), two = create("two", {}, shape);
  create("below", one, kept);
  create("other", {}, kept);
  do_it(delete_objects(world_, std::vector{one, two, one}));
  EXPECT_EQ(world_.objects().size(), 1U);
  EXPECT_FALSE(world_.find(shape));
  EXPECT_TRUE(world_.find(kept));
}

TEST_F(ObjectEditsTest, PutsThingsSideBySideWhereTheyAreDropped) {
  const ObjectId a = create("a"), b = create("b"), c = create("c"), d = create("d"), e = create("e");
  // Before d: a and e, which stand on both sides of it.
  do_it(*put_under(world_, std::vector{e, a}, {}, 3));
  EXPECT_EQ(world_.roots(), (std::vector{b, c, e, a, d}));
  do_it(*put_under(world_, std::vector{b, c}, {}, 5));
  EXPECT_EQ(world_.roots(), (std::vector{e, a, d, b, c}));
  do_it(*put_under(world_, std::vector{a}, d, 99));
  EXPECT_EQ(world_.find(d)->children, std::vector{a});
}

TEST_F(ObjectEditsTest, NothingGoesUnderItself) {
  const ObjectId above = create("above"), below = create("below", above);
  EXPECT_FALSE(put_under(world_, std::vector{above}, below, 0));
  EXPECT_FALSE(put_under(world_, std::vector{above}, above, 0));
  EXPECT_FALSE(put_under(world_, std::vector{above}, ObjectId{12345}, 0));
}

TEST_F(ObjectEditsTest, GroupingNeedsObjects) {
  EXPECT_FALSE(group_objects(world_, {}, ids_));
  EXPECT_FALSE(group_objects(world_, std::vector{ObjectId{7}}, ids_));
}

/// In worlds made at random, the moved objects stay where they are, siblings keep their order, and what was
/// asked for is where it was asked for.
TEST(ObjectEdits, KeepPlacesInTheWorld) {
  base::Random random(11);
  world::RandomEdits thinker(12);
  World world;
  for (int i = 0; i < 400; ++i) world::apply(world, thinker.next(world)).has_value();
  std::vector<ObjectId> all;
  for (const auto& [id, object] : world.objects()) all.push_back(id);
  std::sort(all.begin(), all.end());
  ASSERT_GT(all.size(), 20U);
  world::IdSource ids(3);
  int moved = 0;
  for (int i = 0; i < 300; ++i) {
    std::vector<ObjectId> some;
    for (int n = 0; n < 3; ++n) some.push_back(all[random.index(all.size())]);
    World next = world;
    const bool group = random.index(2) == 0;
    const ObjectId parent = random.index(3) == 0 ? ObjectId{} : all[random.index(all.size())];
    const auto grouping = group ? group_objects(world, some, ids) : base::fail("");
    const auto edit = group ? (grouping ? base::Result<world::Edit>(grouping->edit) : base::fail(""))
                            : put_under(world, some, parent, random.index(4));
    if (!edit || !world::apply(next, *edit)) continue;
    ++moved;
    for (const ObjectId id : some) {
      const auto before = world::world_from_object(world, id), after = world::world_from_object(next, id);
      EXPECT_TRUE(after.isApprox(before, 1e-9));
    }
    EXPECT_EQ(next.objects().size(), world.objects().size() + (group ? 1 : 0));
  }
  EXPECT_GT(moved, 100);
}

}  // namespace
}  // namespace icome::interaction
