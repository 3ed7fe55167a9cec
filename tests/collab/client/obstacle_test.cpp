#include "collab/client/obstacle.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "collab/server/floor.h"
#include "world/random_edits.h"
#include "world/sample_world.h"

namespace icome::collab {
namespace {

/// A client must refuse what the server would refuse, and nothing else.
TEST(Obstacle, IsWhereTheFloorOfTheServerSeesOne) {
  constexpr std::uint32_t kMyself = 1, kPeople = 3;
  base::Random random(7);
  std::size_t refused = 0, let = 0;
  for (std::uint64_t day = 0; day < 60; ++day) {
    world::World world;
    world::RandomEdits edits(day);
    for (int i = 0; i < 150; ++i) (void)world::apply(world, edits.next(world));
    Floor floor;
    for (const auto& [id, object] : world.objects())
      if (random.index(8) == 0)
        (void)floor.request(world, 1 + std::uint32_t(random.index(kPeople)), item_of(id));
    for (const auto& [id, geometry] : world.geometries())
      if (random.index(8) == 0)
        (void)floor.request(world, 1 + std::uint32_t(random.index(kPeople)), item_of(id));
    Holds holds;
    for (const auto& [item, hold] : floor.holds()) holds[item] = {item, hold.holder, hold.fence, 0};
    for (int i = 0; i < 200; ++i) {
      const world::Edit edit = edits.next(world);
      world::World trial = world;
      if (!world::apply(trial, edit)) continue;
      const auto expected = floor.obstacle(world, kMyself, needs_of(edit));
      const auto found = obstacle_to(edit, holds, world, kMyself);
      ASSERT_EQ(found.has_value(), expected.has_value()) << edit_word(edit);
      if (!found) {
        ++let;
        continue;
      }
      ++refused;
      EXPECT_NE(found->holder, kMyself);
      EXPECT_EQ(floor.holds().at(found->item).holder, found->holder);
    }
  }
  EXPECT_GT(refused, 500U);
  EXPECT_GT(let, 500U);
}

}  // namespace
}  // namespace icome::collab
