#include "world/edit/copy.h"

#include "world/sample_world.h"

namespace icome::world {
namespace {

/// Thesis 2.4.1 and figure 2.9: a table whose leg was modelled once and cloned three times.
struct Table {
  World world;
  IdSource ids;
  ObjectId top = add_object(world, ids, "table", box(1.0));
  ObjectId leg = add_object(world, ids, "leg", one_triangle(), top, at(1.0, 1.0, 0.0));

  Table() {
    for (int i = 0; i < 3; ++i) duplicated(world, ids, leg, Duplicate::CloneObject, top);
  }

  GeometryId shape_of(ObjectId id) const { return world.find(id)->geometry; }
  const std::vector<ObjectId>& legs(ObjectId table) const { return world.find(table)->children; }
};

TEST(Duplicate, ClonedLegsShareOneShape) {
  const Table table;
  EXPECT_EQ(table.legs(table.top).size(), 4u);
  EXPECT_EQ(table.world.find(table.shape_of(table.leg))->users, 4u);
}

TEST(Duplicate, ACopiedTablesLegsAreClonesOfEachOtherOnly) {
  Table table;
  const ObjectId second = duplicated(table.world, table.ids, table.top, Duplicate::CopyObjectAndChildren);
  const GeometryId first_legs = table.shape_of(table.leg);
  const GeometryId second_legs = table.shape_of(table.legs(second)[0]);
  EXPECT_NE(second_legs, first_legs);
  EXPECT_NE(table.shape_of(second), table.shape_of(table.top));
  for (const ObjectId leg : table.legs(second)) EXPECT_EQ(table.shape_of(leg), second_legs);

  // To adjust the shape of one leg of the second table changes all of its legs, and none of the first.
  const auto before = table.world.find(first_legs)->shape;
  applied(table.world, MoveVertices{second_legs, {1}, {{2.0, 0.0, 0.0}}});
  const auto& changed = dynamic_cast<const MeshGeometry&>(*table.world.find(second_legs)->shape);
  EXPECT_EQ(changed.mesh.positions[1].x(), 2.0);
  EXPECT_EQ(table.world.find(second_legs)->users, 4u);
  EXPECT_EQ(table.world.find(first_legs)->shape, before);
}

struct Expected {
  Duplicate how;
  bool own_top, children, own_legs;
};

class SixWays : public testing::TestWithParam<Expected> {};

INSTANTIATE_TEST_SUITE_P(All, SixWays,
                         testing::Values(Expected{Duplicate::CopyObject, true, false, false},
                                         Expected{Duplicate::CopyObjectAndChildren, true, true, true},
                                         Expected{Duplicate::CloneObject, false, false, false},
                                         Expected{Duplicate::CloneObjectAndChildren, false, true, false},
                                         Expected{Duplicate::CopyObjectCloneChildren, true, true, false},
                                         Expected{Duplicate::CloneObjectCopyChildren, false, true, true}));

TEST_P(SixWays, CopyOrShareShapes) {
  Table table;
  const MaterialId wood = table.ids.next<MaterialId>();
  applied(table.world, CreateMaterial{wood, {.name = "wood"}});
  applied(table.world, ChooseMaterial{table.top, wood});
  const ObjectId made = duplicated(table.world, table.ids, table.top, GetParam().how);
  EXPECT_EQ(table.shape_of(made) != table.shape_of(table.top), GetParam().own_top);
  EXPECT_EQ(table.world.find(made)->material, wood);
  EXPECT_EQ(table.world.find(wood)->users, 2u);
  ASSERT_EQ(table.legs(made).size(), GetParam().children ? 4u : 0u);
  for (const ObjectId leg : table.legs(made))
    EXPECT_EQ(table.shape_of(leg) != table.shape_of(table.leg), GetParam().own_legs);
}

TEST_P(SixWays, AreUndoneWhole) {
  Table table;
  const std::uint64_t before = hash(table.world);
  const auto made = duplicate(table.world, table.top, GetParam().how, {}, table.ids);
  const Edit inverse = applied(table.world, made->edit);
  EXPECT_NE(hash(table.world), before);
  applied(table.world, inverse);
  EXPECT_EQ(hash(table.world), before);
}

TEST(Duplicate, MayGoUnderItsModel) {
  Table table;
  const ObjectId made =
      duplicated(table.world, table.ids, table.top, Duplicate::CloneObjectAndChildren, table.leg);
  EXPECT_EQ(table.world.find(made)->parent, table.leg);
  EXPECT_EQ(subtree(table.world, made).size(), 5u);
}

TEST(Duplicate, RefusesWhatIsGone) {
  Table table;
  EXPECT_FALSE(duplicate(table.world, ObjectId{99}, Duplicate::CopyObject, {}, table.ids));
  EXPECT_FALSE(duplicate(table.world, table.top, Duplicate::CopyObject, ObjectId{99}, table.ids));
}

}  // namespace
}  // namespace icome::world
