#include "collab/client/kept_copy.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "world/edit/edit_bytes.h"
#include "world/sample_world.h"

namespace icome::collab {
namespace {

KeptCopy sample_copy() {
  KeptCopy copy;
  copy.link = "icome://127.0.0.1:1/table#token=secret";
  copy.key = "a key";
  copy.at = 1'700'000'000'000;
  copy.history = 7;
  copy.sequence = 12;
  copy.author = 3;
  copy.last_number = 40;
  copy.lives = 2;
  copy.role = Role::Edit;
  world::IdSource ids(3);
  const world::ObjectId leg = world::add_object(copy.world, ids, "leg", world::box(0.1));
  copy.edits.push_back({40, "Move leg\nand more", 12, {5, 6}, world::PlaceObject{leg, world::at(1, 2, 3)}});
  return copy;
}

TEST(KeptCopy, IsReadAsItWasWritten) {
  const KeptCopy copy = sample_copy();
  const auto read = kept_copy_from_bytes(to_bytes(copy).value());
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->link, copy.link);
  EXPECT_EQ(read->key, copy.key);
  EXPECT_EQ(read->at, copy.at);
  EXPECT_EQ(read->history, copy.history);
  EXPECT_EQ(read->sequence, copy.sequence);
  EXPECT_EQ(read->author, copy.author);
  EXPECT_EQ(read->last_number, copy.last_number);
  EXPECT_EQ(read->lives, copy.lives);
  EXPECT_EQ(read->role, copy.role);
  EXPECT_EQ(hash(read->world), hash(copy.world));
  ASSERT_EQ(read->edits.size(), 1U);
  EXPECT_EQ(read->edits[0].number, 40U);
  EXPECT_EQ(read->edits[0].name, copy.edits[0].name);
  EXPECT_EQ(read->edits[0].base, 12U);
  EXPECT_EQ(read->edits[0].fences, copy.edits[0].fences);
  EXPECT_EQ(world::to_bytes(read->edits[0].edit).value(), world::to_bytes(copy.edits[0].edit).value());
}

TEST(KeptCopy, IsRefusedWithAnyBitOfItWrongAndCutAnywhere) {
  const std::string good = to_bytes(sample_copy()).value();
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    std::string bytes = good;
    bytes[bit / 8] = char(bytes[bit / 8] ^ (1 << (bit % 8)));
    if (bytes.substr(bytes.size() - 36, 4) != good.substr(good.size() - 36, 4))
      continue;  // padding of a length
    ASSERT_FALSE(kept_copy_from_bytes(bytes)) << "bit " << bit;
  }
  for (std::size_t size = 0; size < good.size(); ++size)
    ASSERT_FALSE(kept_copy_from_bytes(good.substr(0, size))) << size;
}

}  // namespace
}  // namespace icome::collab
