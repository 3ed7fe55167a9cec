#include "files/same_design.h"

#include <gtest/gtest.h>

#include "world/every_edit.h"
#include "world/random_edits.h"

namespace icome::files {
namespace {

using namespace world;

World table_of(std::uint64_t first_id, double size, bool clone = true) {
  World world;
  IdSource ids(0, first_id);
  const ObjectId table = add_object(world, ids, "table", box(1.0));
  const ObjectId leg = add_object(world, ids, "leg", box(size), table, at(1.0, 0.0, 0.0));
  duplicated(world, ids, leg, clone ? Duplicate::CloneObject : Duplicate::CopyObject, table);
  return world;
}

TEST(SameDesign, IdsAndRoundingDoNotCount) {
  EXPECT_EQ(difference(table_of(1, 0.1), table_of(70, 0.1)), "");
  EXPECT_EQ(difference(table_of(1, 0.1), table_of(1, 0.1 + 1e-9)), "");
}

TEST(SameDesign, TellsWhatIsDifferent) {
  EXPECT_EQ(difference(table_of(1, 0.1), table_of(1, 0.1001)).substr(0, 5), "\"leg\"");
  EXPECT_EQ(difference(table_of(1, 0.1), table_of(1, 0.1, false)), "\"leg\": shapes are shared otherwise");
  World moved = table_of(1, 0.1);
  applied(moved, PlaceObject{moved.roots()[0], at(0.0, 0.0, 0.1)});
  EXPECT_NE(difference(table_of(1, 0.1), moved), "");
  EXPECT_NE(difference(World(), moved), "");
}

TEST(SameDesign, EveryEditThatShowsMakesADifferentDesign) {
  World world;
  for (const Edit& edit : every_edit()) applied(world, edit);
  EXPECT_EQ(difference(world, world), "");
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    RandomEdits edits(seed);
    World random;
    for (int i = 0; i < 100; ++i) (void)apply(random, edits.next(random));
    EXPECT_EQ(difference(random, random), "");
    EXPECT_EQ(difference(random, World()).empty(), random.roots().empty() && random.scenes().empty());
  }
}

}  // namespace
}  // namespace icome::files
