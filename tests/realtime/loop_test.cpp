#include "realtime/loop.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "realtime/guard/guard.h"

namespace icome::realtime {
namespace {

// Ordinary priority: the tests wait in their ticks, which must not hold up the machine they run on.
LoopSettings modest_settings() {
  LoopSettings settings;
  settings.realtime_priority = false;
  settings.lock_memory = false;
  return settings;
}

TEST(Timetable, DoesNotDriftAtRatesThatAreNoWholeNanoseconds) {
  const Timetable timetable(100, 3000.0);
  EXPECT_EQ(timetable.deadline(0), 100);
  EXPECT_EQ(timetable.deadline(1), 100 + 333333);
  EXPECT_EQ(timetable.deadline(2), 100 + 666667);
  // A day of ticks ends on the nanosecond; adding up 333,333 ns would end 86 ms early.
  EXPECT_EQ(timetable.deadline(3000ULL * 86400), 100 + 86400LL * 1'000'000'000);
}

TEST(Timetable, SkipsTheDeadlinesThatHavePassed) {
  const Timetable timetable(0, 1000.0);
  EXPECT_EQ(timetable.next(0, 0), 1u);
  EXPECT_EQ(timetable.next(0, 999'999), 1u);
  EXPECT_EQ(timetable.next(0, 1'000'000), 2u) << "a deadline that is now has passed";
  EXPECT_EQ(timetable.next(3, 7'500'000), 8u);
  EXPECT_EQ(timetable.next(3, 2'000'000), 4u) << "never the same deadline twice";
  EXPECT_EQ(timetable.next(0, 3'600'000'000'000), 3'600'001u);
}

TEST(LoopRunner, RefusesARateOrPriorityOutOfRangeWithASentence) {
  const auto tick = [](const TickInfo&) { return false; };
  for (double rate : {499.0, 10001.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    LoopSettings settings = modest_settings();
    settings.rate_hz = rate;
    const auto runner = LoopRunner::create(settings, tick);
    ASSERT_FALSE(runner.has_value()) << rate;
    EXPECT_NE(runner.error().message.find("500 to 10000"), std::string::npos);
  }
  for (int priority : {0, 100}) {
    LoopSettings settings = modest_settings();
    settings.priority = priority;
    const auto runner = LoopRunner::create(settings, tick);
    ASSERT_FALSE(runner.has_value()) << priority;
    EXPECT_NE(runner.error().message.find("1 to 99"), std::string::npos);
  }
}

TEST(LoopRunner, EndsWhenTheTickSaysSo) {
  int ticks = 0;
  auto runner = LoopRunner::create(modest_settings(), [&](const TickInfo&) { return ++ticks < 20; });
  ASSERT_TRUE(runner.has_value());
  (*runner)->wait();
  EXPECT_FALSE((*runner)->running());
  EXPECT_EQ(ticks, 20);
  EXPECT_EQ((*runner)->recorder().summary().ticks, 20u);
}

TEST(LoopRunner, TicksAtItsDeadlinesAndNeverBeforeThem) {
  struct Seen {
    TickInfo info;
    std::int64_t started;
  };
  std::vector<Seen> seen;
  LoopSettings settings = modest_settings();
  settings.rate_hz = 4000.0;
  const std::int64_t before = base::steady_nanoseconds();
  auto runner = LoopRunner::create(settings, [&](const TickInfo& info) {
    seen.push_back({info, base::steady_nanoseconds()});
    return seen.size() < 50;
  });
  ASSERT_TRUE(runner.has_value());
  (*runner)->wait();
  EXPECT_EQ(seen[0].info.index, 0u);
  EXPECT_DOUBLE_EQ(seen[0].info.dt, 1.0 / 4000.0);
  EXPECT_GE(seen[0].info.scheduled, before + 250'000);
  for (std::size_t i = 1; i < seen.size(); ++i) {
    const TickInfo& last = seen[i - 1].info;
    const TickInfo& info = seen[i].info;
    EXPECT_GE(seen[i].started, info.scheduled);
    EXPECT_GT(info.index, last.index);
    // 250 us a deadline, on the grid of the first one whatever was skipped.
    EXPECT_EQ(info.scheduled - seen[0].info.scheduled, static_cast<std::int64_t>(info.index) * 250'000);
    EXPECT_NEAR(info.dt, static_cast<double>(info.index - last.index) / 4000.0, 1e-12);
  }
}

TEST(LoopRunner, SkipsDeadlinesMissedByALongTickInsteadOfBursting) {
  constexpr std::uint64_t kLongTick = 3;
  std::vector<std::uint64_t> indices;
  std::uint64_t long_index = 0;
  std::uint64_t bursts = 0;
  std::int64_t last_finished = 0;
  auto runner = LoopRunner::create(modest_settings(), [&](const TickInfo& info) {
    bursts += info.scheduled <= last_finished;
    if (indices.size() == kLongTick) {
      long_index = info.index;
      // Until 3.5 periods after its own deadline, however fast the machine is.
      while (base::steady_nanoseconds() < info.scheduled + 3'500'000) {
      }
    }
    indices.push_back(info.index);
    last_finished = base::steady_nanoseconds();
    return indices.size() < 8;
  });
  ASSERT_TRUE(runner.has_value());
  (*runner)->wait();
  EXPECT_GE(indices[kLongTick + 1], long_index + 4);
  EXPECT_EQ(bursts, 0u) << "a tick was started for a deadline that had passed already";
  const LoopSummary summary = (*runner)->recorder().summary();
  EXPECT_GE(summary.overruns, 1u);
  EXPECT_EQ(summary.skipped, indices.back() + 1 - indices.size());
  EXPECT_EQ(summary.ticks, indices.size());
}

TEST(LoopRunner, StopsWhenAskedAndWhenDestroyed) {
  std::atomic<std::uint64_t> ticks = 0;
  auto runner = LoopRunner::create(modest_settings(), [&](const TickInfo&) {
    ++ticks;
    return true;
  });
  ASSERT_TRUE(runner.has_value());
  while (ticks < 3) std::this_thread::yield();
  EXPECT_TRUE((*runner)->running());
  (*runner)->stop();
  EXPECT_FALSE((*runner)->running());
  const std::uint64_t at_stop = ticks;
  (*runner)->stop();
  EXPECT_EQ(ticks, at_stop);

  auto other = LoopRunner::create(modest_settings(), [&](const TickInfo&) {
    ++ticks;
    return true;
  });
  ASSERT_TRUE(other.has_value());
  other->reset();
  const std::uint64_t at_end = ticks;
  std::this_thread::yield();
  EXPECT_EQ(ticks, at_end);
}

TEST(LoopRunner, ReportsWhatItAskedForAndGot) {
  int policy = -1;
  LoopSettings settings;
  settings.name = "a name longer than the kernel takes";
  auto runner = LoopRunner::create(settings, [&](const TickInfo&) {
    policy = sched_getscheduler(0);
    return false;
  });
  ASSERT_TRUE(runner.has_value());
  (*runner)->wait();
  const LoopReport& report = (*runner)->report();
  EXPECT_EQ(report.realtime_priority, policy == SCHED_FIFO);
  EXPECT_EQ(report.notice.empty(), report.realtime_priority && report.memory_locked) << report.notice;

  auto modest = LoopRunner::create(modest_settings(), [](const TickInfo&) { return false; });
  ASSERT_TRUE(modest.has_value());
  EXPECT_FALSE((*modest)->report().realtime_priority);
  EXPECT_FALSE((*modest)->report().memory_locked);
  EXPECT_EQ((*modest)->report().notice, "");
}

// In a process of its own: becomes an ordinary user without the right to real-time priority, starts a
// loop and exits with 0 when the loop ran and said what was refused.
[[noreturn]] void run_without_permission() {
  const rlimit none{0, 0};
  setrlimit(RLIMIT_RTPRIO, &none);
  setrlimit(RLIMIT_MEMLOCK, &none);
  constexpr uid_t kNobody = 65534;
  if (geteuid() == 0 && setuid(kNobody) != 0) std::_Exit(2);
  int ticks = 0;
  auto runner = LoopRunner::create(LoopSettings{}, [&](const TickInfo&) { return ++ticks < 3; });
  if (!runner.has_value()) std::_Exit(3);
  (*runner)->wait();
  const LoopReport& report = (*runner)->report();
  const auto says = [&](const char* word) { return report.notice.find(word) != std::string::npos; };
  const bool priority_told = !report.realtime_priority && says("rtprio 80");
  // The sanitizers make memory locking succeed without doing it.
  const bool memory_told = report.memory_locked ? !RealtimeGuard::available() : says("memlock");
  std::_Exit(ticks == 3 && priority_told && memory_told ? 0 : 1);
}

TEST(LoopRunnerDeathTest, RunsAndSaysWhatToDoWhereNothingIsPermitted) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(run_without_permission(), testing::ExitedWithCode(0), "");
}

TEST(LoopRunner, AddsNoAllocationOrLockToItsTicks) {
  if (!RealtimeGuard::available()) GTEST_SKIP() << "the guard is off under sanitizers";
  std::optional<RealtimeGuard> guard;
  int ticks = 0;
  auto runner = LoopRunner::create(modest_settings(), [&](const TickInfo&) {
    if (ticks == 0) guard.emplace();
    if (ticks == 30) guard->stop();
    return ticks++ < 30;
  });
  ASSERT_TRUE(runner.has_value());
  (*runner)->wait();
  EXPECT_EQ(guard->allocations(), 0u);
  EXPECT_EQ(guard->frees(), 0u);
  EXPECT_EQ(guard->locks(), 0u);
}

}  // namespace
}  // namespace icome::realtime
