#include "world/edit/edits_of.h"

#include "world/edit/edit_bytes.h"
#include "world/every_edit.h"
#include "world/random_edits.h"

namespace icome::world {
namespace {

World rebuilt(const World& world) {
  World result;
  for (const Edit& edit : edits_of(world)) applied(result, edit);
  return result;
}

std::vector<std::string> bytes_of(const World& world) {
  std::vector<std::string> result;
  for (const Edit& edit : edits_of(world)) result.push_back(*to_bytes(edit));
  return result;
}

void expect_equal(const World& one, const World& other) {
  EXPECT_EQ(hash(one), hash(other));
  EXPECT_EQ(one.last_numbers(), other.last_numbers());
  for (const auto& [id, geometry] : one.geometries()) EXPECT_EQ(other.find(id)->users, geometry.users);
  for (const auto& [id, material] : one.materials()) EXPECT_EQ(other.find(id)->users, material.users);
  for (const auto& [id, texture] : one.textures()) EXPECT_EQ(other.find(id)->users, texture.users);
}

TEST(EditsOf, MakeAnEqualWorld) {
  EXPECT_TRUE(edits_of(World()).empty());
  World world;
  for (const Edit& edit : every_edit()) {
    applied(world, edit);
    expect_equal(rebuilt(world), world);
  }
}

TEST(EditsOf, AreTheSameForTheSameWorld) {
  for (int seed = 0; seed < 50; ++seed) {
    World world;
    RandomEdits edits{std::uint64_t(seed)};
    for (int i = 0; i < 60; ++i) (void)apply(world, edits.next(world));
    const World again = rebuilt(world);
    expect_equal(again, world);
    EXPECT_EQ(bytes_of(again), bytes_of(world));
  }
}

TEST(EditsOf, NeverLetANumberBeGivenTwice) {
  World world;
  IdSource ids(7);
  const ObjectId gone = add_object(world, ids, "gone", box(1.0));
  applied(world, delete_subtree(world, gone));
  EXPECT_EQ(rebuilt(world).next_number(7), world.next_number(7));
}

TEST(EditsOf, WriteUnchangedCopiesOnce) {
  World world;
  IdSource ids;
  const ObjectId table = add_object(world, ids, "table", sharp_loop());
  for (int i = 0; i < 5; ++i) duplicated(world, ids, table, Duplicate::CopyObject);
  const World again = rebuilt(world);
  expect_equal(again, world);
  for (const auto& [id, geometry] : again.geometries())
    EXPECT_EQ(geometry.shape, again.find(again.find(again.roots()[0])->geometry)->shape);
}

TEST(EditsOf, ComeOneByOne) {
  World world;
  IdSource ids;
  for (int i = 0; i < 1000; ++i) add_object(world, ids, "object", nullptr);
  for (const Edit& edit : edits_of(world)) EXPECT_FALSE(std::holds_alternative<EditGroup>(edit.what));
  EXPECT_EQ(edits_of(world).size(), 1001u) << "what was spent, and the objects";
}

}  // namespace
}  // namespace icome::world
