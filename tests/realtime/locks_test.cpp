#include "realtime/locks.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include "base/clock.h"

namespace icome::realtime {
namespace {

constexpr std::size_t kThreads = 4;

// How long a test tries to provoke a clash. On a loaded machine the threads hand over slowly and meet
// less often, but what they may and may not see is the same.
constexpr std::int64_t kTrialTime = 300'000'000;  // ns

struct Crowd {
  std::uint64_t entries = 0;               // not atomic: only the lock protects it
  std::atomic<std::uint64_t> calls = 0;    // what `entries` has to become
  std::atomic<int> inside = 0;             // threads between lock and unlock
  std::atomic<std::uint64_t> clashes = 0;  // entries that found another thread inside
};

// `locked(thread, section)` runs the section under the lock as the given thread.
template <typename Locked>
void enter_from_all_threads(Crowd& crowd, const Locked& locked) {
  const std::int64_t end = base::steady_nanoseconds() + kTrialTime;
  const auto enter = [&](std::size_t thread) {
    do {
      locked(thread, [&crowd] {
        if (crowd.inside.fetch_add(1, std::memory_order_relaxed) != 0) ++crowd.clashes;
        ++crowd.entries;
        crowd.inside.fetch_sub(1, std::memory_order_relaxed);
      });
      crowd.calls.fetch_add(1, std::memory_order_relaxed);
    } while (base::steady_nanoseconds() < end);
  };
  std::vector<std::thread> threads;
  for (std::size_t thread = 0; thread < kThreads; ++thread) threads.emplace_back(enter, thread);
  for (std::thread& thread : threads) thread.join();
}

TEST(BakeryLock, LetsOneThreadInAtATime) {
  BakeryLock<kThreads> lock;
  Crowd crowd;
  enter_from_all_threads(crowd, [&](std::size_t thread, const auto& section) {
    lock.lock(thread);
    section();
    lock.unlock(thread);
  });
  EXPECT_EQ(crowd.clashes, 0u);
  EXPECT_EQ(crowd.entries, crowd.calls);
}

// Two threads that come to a Bakery lock at the same moment, again and again: the race that the memory
// order decides, in which both draw a ticket before either sees the other's. They meet before each
// entry, since threads that queue rarely come to the door together.
struct Meeting {
  static constexpr std::uint64_t kOver = ~std::uint64_t{0};

  BakeryLock<2> lock;
  std::uint64_t entries = 0;  // not atomic: only the lock protects it
  std::array<std::atomic<std::uint64_t>, 2> arrivals{};

  // Waits until the other thread comes for this entry too; false when it has left instead.
  bool meet(std::size_t thread, std::uint64_t entry) {
    arrivals[thread].store(entry, std::memory_order_relaxed);
    SpinWait spin;
    while (arrivals[1 - thread].load(std::memory_order_relaxed) < entry) spin.pause();
    return arrivals[1 - thread].load(std::memory_order_relaxed) != kOver;
  }

  // A few nanoseconds before or after the other: each entry tries another offset.
  void enter(std::size_t thread, std::uint64_t entry) {
    for (std::uint64_t i = 0; i < entry % (thread == 0 ? 61 : 37); ++i) asm volatile("");
    lock.lock(thread);
    ++entries;
    lock.unlock(thread);
  }
};

TEST(BakeryLock, LetsOneThreadInWhenTwoComeAtTheSameMoment) {
  Meeting meeting;
  std::uint64_t met_by_other = 0;
  std::thread other([&] {
    for (; meeting.meet(1, met_by_other + 1); ++met_by_other) meeting.enter(1, met_by_other + 1);
  });
  const std::int64_t end = base::steady_nanoseconds() + kTrialTime;
  std::uint64_t met = 0;
  do {
    ++met;
    meeting.meet(0, met);
    meeting.enter(0, met);
  } while (base::steady_nanoseconds() < end);
  meeting.arrivals[0] = Meeting::kOver;
  other.join();
  EXPECT_EQ(meeting.entries, met + met_by_other);
}

TEST(SpinLock, LetsOneThreadInAtATime) {
  SpinLock lock;
  Crowd crowd;
  enter_from_all_threads(crowd, [&](std::size_t, const auto& section) {
    const std::scoped_lock held(lock);
    section();
  });
  EXPECT_EQ(crowd.clashes, 0u);
  EXPECT_EQ(crowd.entries, crowd.calls);
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
