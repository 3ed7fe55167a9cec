#include "realtime/locks.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace icome::realtime {
namespace {

constexpr std::size_t kThreads = 4;

struct Crowd {
  std::uint64_t entries = 0;               // not atomic: only the lock protects it
  std::atomic<int> inside = 0;             // threads between lock and unlock
  std::atomic<std::uint64_t> clashes = 0;  // entries that found another thread inside
};

// `locked(thread, section)` runs the section under the lock as the given thread.
template <typename Locked>
void enter_from_all_threads(Crowd& crowd, std::uint64_t entries_each, const Locked& locked) {
  std::vector<std::thread> threads;
  for (std::size_t thread = 0; thread < kThreads; ++thread) {
    threads.emplace_back([&, thread] {
      for (std::uint64_t i = 0; i < entries_each; ++i) {
        locked(thread, [&] {
          if (crowd.inside.fetch_add(1, std::memory_order_relaxed) != 0) ++crowd.clashes;
          ++crowd.entries;
          crowd.inside.fetch_sub(1, std::memory_order_relaxed);
        });
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST(BakeryLock, LetsOneThreadInAtATime) {
  constexpr std::uint64_t kEntries = 20000;
  BakeryLock<kThreads> lock;
  Crowd crowd;
  enter_from_all_threads(crowd, kEntries, [&](std::size_t thread, const auto& section) {
    lock.lock(thread);
    section();
    lock.unlock(thread);
  });
  EXPECT_EQ(crowd.clashes, 0u);
  EXPECT_EQ(crowd.entries, kThreads * kEntries);
}

TEST(BakeryLock, LetsOneThreadInWhenTwoComeAtTheSameMoment) {
  // The race that the memory order decides: both draw a ticket before either sees the other's. They
  // meet before each entry, since threads that queue rarely come to the door together.
  constexpr std::uint64_t kEntries = 100000;
  BakeryLock<2> lock;
  std::uint64_t entries = 0;
  std::array<std::atomic<std::uint64_t>, 2> arrivals{};
  const auto enter = [&](std::size_t thread) {
    for (std::uint64_t entry = 1; entry <= kEntries; ++entry) {
      arrivals[thread].store(entry, std::memory_order_relaxed);
      SpinWait spin;
      while (arrivals[1 - thread].load(std::memory_order_relaxed) < entry) spin.pause();
      // A few nanoseconds before or after the other: each entry tries another offset.
      for (std::uint64_t i = 0; i < entry % (thread == 0 ? 61 : 37); ++i) asm volatile("");
      lock.lock(thread);
      ++entries;
      lock.unlock(thread);
    }
  };
  std::thread other(enter, 1);
  enter(0);
  other.join();
  EXPECT_EQ(entries, 2 * kEntries);
}

TEST(SpinLock, LetsOneThreadInAtATime) {
  constexpr std::uint64_t kEntries = 50000;
  SpinLock lock;
  Crowd crowd;
  enter_from_all_threads(crowd, kEntries, [&](std::size_t, const auto& section) {
    const std::scoped_lock held(lock);
    section();
  });
  EXPECT_EQ(crowd.clashes, 0u);
  EXPECT_EQ(crowd.entries, kThreads * kEntries);
}

TEST(SpinLock, CannotBeTakenTwice) {
  SpinLock lock;
  EXPECT_TRUE(lock.try_lock());
  EXPECT_FALSE(lock.try_lock());
  lock.unlock();
  EXPECT_TRUE(lock.try_lock());
}

}  // namespace
}  // namespace icome::realtime
