#include "collab/content/outline.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "collab/content/content_shelf.h"
#include "collab/order/world_bytes.h"
#include "world/edit/edit_bytes.h"
#include "world/every_edit.h"
#include "world/sample_world.h"

namespace icome::collab {
namespace {

std::string written(const world::Edit& edit) { return world::to_bytes(edit).value(); }

world::Edit picture_edit(const std::string& bytes) {
  world::IdSource ids(1);
  return world::CreateTexture{ids.next<world::TextureId>(),
                              {"wood", "image/png", std::make_shared<const std::string>(bytes)}};
}

/// The whole that a receiver makes of what is on a shelf.
std::string put_together(const ContentShelf& shelf, const std::string& outline_bytes) {
  const Outline outline = outline_from_bytes(outline_bytes).value();
  std::vector<ContentPointer> contents;
  for (const ContentPlace& place : outline.places) contents.push_back(shelf.find(place.hash));
  return whole_of(outline, contents);
}

// The name is one that another program computes: printf 'abc' | sha256sum
TEST(Outline, NamesAContentByItsSha256) {
  const ContentHash hash = hash_of_content("abc");
  ASSERT_EQ(hash.size(), 32U);
  EXPECT_EQ(hash.substr(0, 4), "\xba\x78\x16\xbf");
  EXPECT_EQ(hash.substr(28), std::string("\xf2\x00\x15\xad", 4));
}

TEST(Outline, GivesEveryEditBackByteForByte) {
  std::size_t with_contents = 0;
  for (const std::size_t least : {1U, 8U, 64U, 300U}) {
    ContentShelf shelf(least);
    for (const world::Edit& edit : world::every_edit()) {
      const std::string whole = written(edit);
      const ContentShelf::Shelved shelved = shelf.take_edit(whole);
      if (!shelved.outline) continue;
      ++with_contents;
      for (const ContentPointer& content : shelved.contents) EXPECT_GE(content->size(), least);
      EXPECT_EQ(put_together(shelf, *shelved.outline), whole);
    }
  }
  EXPECT_GT(with_contents, 8U) << "shapes, pictures, and groups of them";
}

TEST(Outline, OfAWorldHasEachPictureOnce) {
  const std::string picture(100'000, 'p');
  world::World world;
  world::IdSource ids;
  for (int i = 0; i < 3; ++i)
    ASSERT_TRUE(world::apply(
        world, world::CreateTexture{ids.next<world::TextureId>(),
                                    {"wood", "image/png", std::make_shared<const std::string>(picture)}}));
  ContentShelf shelf(1'000);
  const std::string whole = world_to_bytes(world).value();
  const ContentShelf::ShelvedWorld shelved = shelf.take_world(whole);
  EXPECT_LT(shelved.shelved.outline->size(), 2'000U);
  ASSERT_EQ(shelved.shelved.contents.size(), 3U);
  EXPECT_EQ(shelved.shelved.contents[0], shelved.shelved.contents[2]) << "the same bytes, not a copy";
  EXPECT_EQ(shelf.find(shelved.hash), shelved.shelved.outline);
  EXPECT_EQ(put_together(shelf, *shelved.shelved.outline), whole);
}

TEST(Outline, ContentsGoWithTheLastWhoHasThem) {
  ContentShelf shelf(10);
  const std::string picture(1'000, 'x');
  auto shelved = shelf.take_edit(written(picture_edit(picture)));
  const ContentHash hash = hash_of_content(picture);
  EXPECT_TRUE(shelf.find(hash));
  shelved = {};
  EXPECT_FALSE(shelf.find(hash));
}

// Whatever the bytes are, they are an outline that can be used, or refused.
TEST(Outline, OfAStrangerIsSoundOrRefused) {
  base::Random random(7);
  const Outline sound = outline_of(std::string(500, 'a'), {{10, 50}, {60, 1}, {100, 200}});
  const std::string good = to_bytes(sound);
  int refused = 0;
  for (int i = 0; i < 100'000; ++i) {
    std::string bytes = good;
    for (std::size_t flips = 1 + random.index(3); flips > 0; --flips)
      bytes[random.index(random.index(2) == 0 ? 8 + 3 * 48 : bytes.size())] = char(random.bits());
    if (random.index(4) == 0) bytes.resize(random.index(bytes.size() + 1));
    const auto read = outline_from_bytes(bytes);
    if (!read) {
      ++refused;
      continue;
    }
    std::vector<ContentPointer> contents;
    std::uint64_t size = 0;
    for (const ContentPlace& place : read->places) size += place.size;
    if (size > 100'000) continue;  // sound, but long
    for (const ContentPlace& place : read->places)
      contents.push_back(std::make_shared<const std::string>(place.size, 'b'));
    EXPECT_EQ(whole_of(*read, contents).size(), read->whole_size());
  }
  EXPECT_GT(refused, 10'000);
}

}  // namespace
}  // namespace icome::collab
