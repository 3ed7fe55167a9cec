#include "collab/server/floor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/random.h"
#include "repeats.h"
#include "world/sample_world.h"

namespace icome::collab {
namespace {

using world::ObjectId;

/// A table with two legs, the second with a foot, and a lamp beside it.
struct TableWorld {
  world::World world;
  world::IdSource ids;
  ObjectId table = world::add_object(world, ids, "table", nullptr);
  ObjectId leg = world::add_object(world, ids, "leg", world::box(0.1), table);
  ObjectId other_leg = world::add_object(world, ids, "other leg", world::box(0.1), table);
  ObjectId foot = world::add_object(world, ids, "foot", world::box(0.1), other_leg);
  ObjectId lamp = world::add_object(world, ids, "lamp", world::box(0.1));
};

constexpr std::uint32_t kAnn = 1, kBob = 2, kEve = 3;

TEST(Floor, GrantsAnObjectUnlessItAnAncestorOrADescendantIsHeld) {
  const TableWorld it;
  Floor floor;
  ASSERT_TRUE(floor.request(it.world, kAnn, item_of(it.other_leg)));
  EXPECT_EQ(floor.obstacle(it.world, kBob, item_of(it.other_leg))->holder, kAnn);
  EXPECT_EQ(floor.obstacle(it.world, kBob, item_of(it.table))->item, item_of(it.other_leg));
  EXPECT_EQ(floor.obstacle(it.world, kBob, item_of(it.foot))->item, item_of(it.other_leg));
  EXPECT_TRUE(floor.request(it.world, kBob, item_of(it.leg))) << "siblings are free";
  EXPECT_TRUE(floor.request(it.world, kBob, item_of(it.lamp)));
  EXPECT_TRUE(floor.request(it.world, kAnn, item_of(it.foot))) << "one's own hold is not in the way";
}

TEST(Floor, GrantsAThingThatIsNotThereToNobody) {
  const TableWorld it;
  Floor floor;
  EXPECT_EQ(floor.obstacle(it.world, kAnn, Item{ItemKind::Material, 77})->holder, 0U);
  EXPECT_FALSE(floor.request(it.world, kAnn, Item{ItemKind::Material, 77}));
}

TEST(Floor, HoldsASharedShapeForAllItsUsers) {
  TableWorld it;
  const world::GeometryId shape = it.world.find(it.leg)->geometry;
  Floor floor;
  ASSERT_TRUE(floor.request(it.world, kAnn, item_of(shape)));
  EXPECT_FALSE(floor.request(it.world, kBob, item_of(shape)));
  EXPECT_TRUE(floor.request(it.world, kBob, item_of(it.leg))) << "an object that uses it may still be moved";
}

TEST(Floor, FencesEachNewHoldHigher) {
  const TableWorld it;
  Floor floor(100);
  const Hold first = *floor.request(it.world, kAnn, item_of(it.leg));
  EXPECT_EQ(first.fence, 101U);
  EXPECT_EQ(floor.request(it.world, kAnn, item_of(it.leg))->fence, first.fence) << "it is the same hold";
  EXPECT_TRUE(floor.is_held(kAnn, first.fence));
  EXPECT_TRUE(floor.release(kAnn, item_of(it.leg)));
  EXPECT_FALSE(floor.is_held(kAnn, first.fence));
  EXPECT_GT(floor.request(it.world, kAnn, item_of(it.leg))->fence, first.fence);
}

TEST(Floor, GrantsToWhoHasWaitedLongest) {
  const TableWorld it;
  Floor floor;
  ASSERT_TRUE(floor.request(it.world, kAnn, item_of(it.leg)));
  floor.wait(kEve, item_of(it.leg));
  floor.wait(kBob, item_of(it.leg));
  EXPECT_TRUE(floor.grant_waiting(it.world).empty());
  EXPECT_TRUE(floor.take_away(item_of(it.leg)));
  const std::vector<Hold> granted = floor.grant_waiting(it.world);
  ASSERT_EQ(granted.size(), 1U);
  EXPECT_EQ(granted.front().holder, kEve);
  floor.release_all(kBob);
  floor.release_all(kEve);
  EXPECT_TRUE(floor.grant_waiting(it.world).empty()) << "Bob waits no longer";
  EXPECT_TRUE(floor.holds().empty());
}

TEST(Floor, LetsNobodyPutAnObjectIntoWhatAnotherHolds) {
  TableWorld it;
  Floor floor;
  ASSERT_TRUE(floor.request(it.world, kAnn, item_of(it.table)));
  const Needs moves = needs_of(world::MoveObject{it.lamp, it.other_leg, 0, world::Affine3::Identity()});
  EXPECT_EQ(floor.obstacle(it.world, kBob, moves)->item, item_of(it.table));
  EXPECT_FALSE(floor.obstacle(it.world, kAnn, moves));
  const Needs makes = needs_of(world::CreateObject{it.ids.next<ObjectId>(), 0, {.parent = it.leg}});
  EXPECT_TRUE(floor.obstacle(it.world, kBob, makes));
}

/// What the thesis says, by brute force: nothing is asked of the floor's own ways of looking.
class FloorModel {
 public:
  bool may_have(const world::World& world, std::uint32_t holder, ObjectId id) const {
    if (!world.find(id)) return false;
    std::set<ObjectId> on_the_way;
    for (const ObjectId below : world::subtree(world, id)) on_the_way.insert(below);
    for (ObjectId above = id; above; above = world.find(above)->parent) on_the_way.insert(above);
    return std::ranges::none_of(
        holders, [&](const auto& it) { return it.second != holder && on_the_way.contains(it.first); });
  }
  std::map<ObjectId, std::uint32_t> holders;
};

TEST(Floor, IsTheThesissWhateverIsAskedInWhateverOrder) {
  base::Random random(1);
  const int all = repeats(1'000'000);
  TableWorld it;
  std::vector<ObjectId> objects{it.table, it.leg, it.other_leg, it.foot, it.lamp};
  for (int i = 0; i < 15; ++i)
    objects.push_back(
        world::add_object(it.world, it.ids, "more", nullptr, objects[random.index(objects.size())]));
  Floor floor;
  FloorModel model;
  int granted = 0, denied = 0, moved = 0;
  for (int i = 0; i < all; ++i) {
    const auto holder = std::uint32_t(1 + random.index(4));
    const ObjectId id = objects[random.index(objects.size())];
    switch (random.index(8)) {
      case 0:
        EXPECT_EQ(floor.release(holder, item_of(id)),
                  model.holders.contains(id) && model.holders[id] == holder);
        if (model.holders.contains(id) && model.holders[id] == holder) model.holders.erase(id);
        break;
      case 1:
        if (random.index(20) == 0) {
          floor.release_all(holder);
          std::erase_if(model.holders, [&](const auto& hold) { return hold.second == holder; });
        }
        break;
      case 2: {  // an object is moved, as far as the floor lets it
        const ObjectId parent = random.index(4) == 0 ? ObjectId{} : objects[random.index(objects.size())];
        const world::Edit edit = world::MoveObject{id, parent, 0, world::Affine3::Identity()};
        if (!floor.obstacle(it.world, holder, needs_of(edit)) && world::apply(it.world, edit)) {
          floor.objects_moved(it.world);
          ++moved;
        }
        break;
      }
      default: {
        const bool may = model.may_have(it.world, holder, id);
        const bool has = floor.request(it.world, holder, item_of(id)).has_value();
        ASSERT_EQ(has, may) << "request " << i;
        if (has) model.holders[id] = holder;
        ++(has ? granted : denied);
      }
    }
    if (i % 16 != 0) continue;
    ASSERT_EQ(floor.holds().size(), model.holders.size());
    for (const auto& [item, hold] : floor.holds()) {  // never two holders on one path
      ASSERT_NE(hold.holder, 0U);
      for (ObjectId above{item.id}; above; above = it.world.find(above)->parent) {
        const auto other = floor.holds().find(item_of(above));
        ASSERT_TRUE(other == floor.holds().end() || other->second.holder == hold.holder) << "after " << i;
      }
    }
  }
  EXPECT_GT(granted, all / 20);
  EXPECT_GT(denied, all / 20);
  EXPECT_GT(moved, all / 100);
}

}  // namespace
}  // namespace icome::collab
