#include "realtime/latest_value.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <thread>

#include "realtime/guard/guard.h"

namespace icome::realtime {
namespace {

TEST(LatestValue, ReadsTheInitialValueUntilSomethingIsPublished) {
  LatestValue<int> box(7);
  EXPECT_FALSE(box.update());
  EXPECT_EQ(box.read(), 7);
}

TEST(LatestValue, GivesTheNewestOfSeveralPublishedValues) {
  LatestValue<int> box;
  for (int value : {1, 2, 3, 4, 5}) box.publish(value);
  EXPECT_TRUE(box.update());
  EXPECT_EQ(box.read(), 5);
  EXPECT_FALSE(box.update()) << "nothing was published since";
  EXPECT_EQ(box.read(), 5);
}

TEST(LatestValue, KeepsTheReadValueWhileTheWriterGoesOn) {
  LatestValue<int> box;
  box.publish(1);
  ASSERT_TRUE(box.update());
  for (int value = 2; value < 10; ++value) {
    box.publish(value);
    EXPECT_EQ(box.read(), 1);
  }
}

TEST(LatestValue, DoesNotShowASlotBeforeItIsPublished) {
  LatestValue<int> box(0);
  box.write_slot() = 9;
  EXPECT_FALSE(box.update());
  EXPECT_EQ(box.read(), 0);
  box.publish();
  ASSERT_TRUE(box.update());
  EXPECT_EQ(box.read(), 9);
}

// Large enough that a copy takes many instructions: a torn value would show.
using Block = std::array<std::uint64_t, 64>;

TEST(LatestValue, NeverTearsNorGoesBackBetweenThreads) {
  constexpr std::uint64_t kLast = 20000;
  LatestValue<Block> box;
  std::thread writer([&box] {
    for (std::uint64_t n = 1; n <= kLast; ++n) {
      box.write_slot().fill(n);
      box.publish();
    }
  });
  std::uint64_t seen = 0;
  std::uint64_t torn = 0;
  std::uint64_t backwards = 0;
  while (seen < kLast) {
    if (!box.update()) {
      std::this_thread::yield();
      continue;
    }
    const Block& block = box.read();
    for (std::uint64_t number : block) torn += number != block[0];
    backwards += block[0] <= seen;
    seen = block[0];
    if (torn + backwards > 0) break;
  }
  writer.join();
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(backwards, 0u);
}

TEST(LatestValue, NeitherAllocatesNorLocks) {
  if (!RealtimeGuard::available()) GTEST_SKIP() << "the guard is off under sanitizers";
  LatestValue<Block> box;
  RealtimeGuard guard;
  box.write_slot().fill(3);
  box.publish();
  const bool updated = box.update();
  guard.stop();
  EXPECT_TRUE(updated);
  EXPECT_EQ(guard.allocations() + guard.frees() + guard.locks(), 0u);
}

}  // namespace
}  // namespace icome::realtime
