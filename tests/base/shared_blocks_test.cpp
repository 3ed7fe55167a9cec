#include "base/shared_blocks.h"

#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <thread>

namespace icome::base {
namespace {

SharedBlocks<int> counted(std::size_t count) {
  std::vector<int> items(count);
  std::iota(items.begin(), items.end(), 0);
  return SharedBlocks<int>(std::move(items));
}

std::vector<int> items_of(const SharedBlocks<int>& list) { return {list.begin(), list.end()}; }

TEST(SharedBlocks, HoldWhatTheyWereMadeOf) {
  for (const std::size_t count : {0U, 1U, 63U, 64U, 65U, 200U}) {
    const SharedBlocks<int> list = counted(count);
    ASSERT_EQ(list.size(), count);
    EXPECT_EQ(list.empty(), count == 0);
    EXPECT_EQ(list.block_count(), (count + 63) / 64);
    std::vector<int> expected(count);
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(items_of(list), expected);
    std::vector<int> by_block;
    for (std::size_t block = 0; block < list.block_count(); ++block)
      by_block.insert(by_block.end(), list.block(block).begin(), list.block(block).end());
    EXPECT_EQ(by_block, expected);
  }
}

TEST(SharedBlocks, ShareTheBlocksThatAChangeLeavesAlone) {
  const SharedBlocks<int> before = counted(200);
  const std::vector<std::uint32_t> indices = {3, 63, 63, 130};
  const SharedBlocks<int> after =
      before.changed(indices, [](std::size_t k, int& item) { item = -int(k) - 1; });
  EXPECT_EQ(items_of(before), items_of(counted(200)));  // stays as it was
  std::vector<int> expected = items_of(before);
  expected[3] = -1;
  expected[63] = -3;  // the last of two changes holds
  expected[130] = -4;
  EXPECT_EQ(items_of(after), expected);
  EXPECT_FALSE(after.shares_block(before, 0));
  EXPECT_TRUE(after.shares_block(before, 1));
  EXPECT_FALSE(after.shares_block(before, 2));
  EXPECT_TRUE(after.shares_block(before, 3));
}

TEST(SharedBlocks, AreReadWhileOthersAreMadeOfThem) {
  SharedBlocks<std::string> newest(std::vector<std::string>(300, "a text too long to lie in the string"));
  const SharedBlocks<std::string> kept = newest;
  std::thread reader([&kept] {
    for (int round = 0; round < 50; ++round) {
      std::size_t letters = 0;
      for (const std::string& text : kept) letters += text.size();
      EXPECT_EQ(letters, 300U * 36U);
    }
  });
  for (std::uint32_t i = 0; i < 300; ++i) {
    const std::vector<std::uint32_t> one = {i};
    newest = newest.changed(one, [](std::size_t, std::string& text) { text = "another text that is long"; });
  }
  reader.join();
  EXPECT_EQ(newest[299], "another text that is long");
}

}  // namespace
}  // namespace icome::base
