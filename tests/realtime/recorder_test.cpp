#include "realtime/recorder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <thread>

#include "realtime/guard/guard.h"

namespace icome::realtime {
namespace {

constexpr std::int64_t kMicrosecond = 1000;  // ns
constexpr double kMillisecond = 1e-3;        // s

TEST(LoopRecorder, MeasuresPeriodLatenessBusyTimeAndLoad) {
  LoopRecorder recorder(kMillisecond);
  // Two ticks, due at 0 and 1000 us, started 10 and 30 us late, busy for 100 and 200 us.
  recorder.record({0, 10 * kMicrosecond, 110 * kMicrosecond, 0});
  recorder.record({1000 * kMicrosecond, 1030 * kMicrosecond, 1230 * kMicrosecond, 0});
  const LoopSummary summary = recorder.summary();
  EXPECT_EQ(summary.ticks, 2u);
  EXPECT_EQ(summary.overruns, 0u);
  EXPECT_NEAR(summary.busy.median, 100e-6, 0.2e-6);
  EXPECT_DOUBLE_EQ(summary.busy.max, 200e-6);
  EXPECT_NEAR(summary.load.median, 0.1, 0.0002);
  EXPECT_DOUBLE_EQ(summary.load.max, 0.2);
  EXPECT_DOUBLE_EQ(summary.mean_load, 0.15);
  EXPECT_DOUBLE_EQ(summary.period.max, 1020e-6);
  EXPECT_DOUBLE_EQ(summary.lateness.max, 30e-6);
  EXPECT_NEAR(summary.lateness.median, 10e-6, 0.02e-6);
}

TEST(LoopRecorder, CountsAnOverrunWhenTheTickEndsAfterTheNextDeadline) {
  LoopRecorder recorder(kMillisecond);
  recorder.record({0, 0, 1000 * kMicrosecond, 0});                  // ends on the deadline: in time
  recorder.record({1000000, 1000000, 2000 * kMicrosecond + 1, 0});  // 1 ns after it
  recorder.record({3000000, 3900000, 4100000, 1});                  // short but late, one deadline skipped
  const LoopSummary summary = recorder.summary();
  EXPECT_EQ(summary.overruns, 2u);
  EXPECT_EQ(summary.skipped, 1u);
}

TEST(LoopRecorder, RecordsBusyTimesOfALoopWithoutAClock) {
  LoopRecorder recorder(kMillisecond);
  for (int us = 1; us <= 1000; ++us) recorder.record_busy(us * kMicrosecond);
  recorder.record_busy(1001 * kMicrosecond);
  const LoopSummary summary = recorder.summary();
  EXPECT_EQ(summary.ticks, 1001u);
  EXPECT_EQ(summary.overruns, 1u);
  EXPECT_NEAR(summary.busy.median, 501e-6, 1e-6);
  EXPECT_NEAR(summary.busy.p99, 991e-6, 2e-6);
  EXPECT_NEAR(summary.busy.p999, 1000e-6, 2e-6);
  EXPECT_DOUBLE_EQ(summary.busy.max, 1001e-6);
  EXPECT_EQ(summary.period.max, 0.0);
}

TEST(LoopRecorder, SortsLoadsIntoBinsOfOnePercent) {
  LoopRecorder recorder(kMillisecond);
  recorder.record_busy(0);
  recorder.record_busy(9 * kMicrosecond);     // 0.9 %
  recorder.record_busy(555 * kMicrosecond);   // 55.5 %
  recorder.record_busy(1000 * kMicrosecond);  // the whole period
  recorder.record_busy(7000 * kMicrosecond);  // seven of them
  const auto bins = recorder.load_histogram();
  static_assert(LoopRecorder::kLoadBins >= 20);
  EXPECT_EQ(bins[0], 2u);
  EXPECT_EQ(bins[55], 1u);
  EXPECT_EQ(bins[100], 2u);
  EXPECT_EQ(std::accumulate(bins.begin(), bins.end(), std::uint64_t{0}), 5u);
}

TEST(LoopRecorder, CanBeReadWhileItRecords) {
  constexpr std::int64_t kTicks = 20000;
  LoopRecorder recorder(kMillisecond);
  std::atomic<bool> done = false;
  std::thread loop([&] {
    for (std::int64_t i = 0; i < kTicks; ++i) {
      const std::int64_t due = i * 1000 * kMicrosecond;
      recorder.record({due, due + 5, due + 105, 0});
    }
    done = true;
  });
  std::uint64_t last = 0;
  std::uint64_t backwards = 0;
  std::uint64_t wrong = 0;
  while (!done) {
    const LoopSummary summary = recorder.summary();
    backwards += summary.ticks < last;
    last = summary.ticks;
    wrong += last > 0 && std::abs(summary.busy.median - 100e-9) > 1e-15;
  }
  loop.join();
  EXPECT_EQ(backwards, 0u);
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(recorder.summary().ticks, static_cast<std::uint64_t>(kTicks));
}

TEST(LoopRecorder, RecordsWithoutAllocatingOrLocking) {
  if (!RealtimeGuard::available()) GTEST_SKIP() << "the guard is off under sanitizers";
  LoopRecorder recorder(kMillisecond);
  RealtimeGuard guard;
  recorder.record({0, 10, 20, 0});
  recorder.record({1000000, 9000000, 70000000, 3});
  recorder.record_busy(100);
  guard.stop();
  EXPECT_EQ(guard.allocations() + guard.frees() + guard.locks(), 0u);
}

}  // namespace
}  // namespace icome::realtime
