#include "round_trips.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <random>
#include <thread>

#include "base/clock.h"
#include "realtime/this_thread.h"

namespace icome::benchmarks {
namespace {

constexpr double kWay = 0.001;                     // m, that the hand moves
constexpr std::int64_t kPatience = 5'000'000'000;  // ns
constexpr std::int64_t kGlance = 20'000;           // ns
constexpr std::int64_t kServoPeriod = 1'000'000;   // ns

/// Reads and answers until told to stop.
void serve(devices::PointerDevice& device, ServoPace pace, const std::atomic<bool>& stop) {
  static_cast<void>(realtime::ask_for_realtime_priority(80));
  devices::PointerState state;
  std::int64_t next = base::steady_nanoseconds();
  while (!stop.load(std::memory_order_relaxed)) {
    device.read(state);
    device.write({answer_to(state.position.x()), 0.0, 0.0});
    // A short wait at least, as the system takes the processor away from a thread that never waits.
    next = pace == ServoPace::AtOnce ? base::steady_nanoseconds() + kGlance : next + kServoPeriod;
    realtime::sleep_until(next);
  }
}

/// Waits for the answer to a place; false when it never comes.
bool wait_for_answer(const FakeEnd& fake, double x) {
  const std::int64_t end = base::steady_nanoseconds() + kPatience;
  while (std::abs(fake.force() - answer_to(x)) > 1e-9) {
    if (base::steady_nanoseconds() > end) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
  return true;
}

}  // namespace

std::vector<std::int32_t> timed_answers(const FakeEnd& fake, int count) {
  std::mt19937 random(7);
  // Random pauses, so that moves meet every phase of the frames.
  std::uniform_int_distribution<int> pause(1000, 4000);  // us
  std::vector<std::int32_t> durations;
  double x = kWay;
  fake.move(x);
  if (!wait_for_answer(fake, x)) return {};
  for (int i = 0; i < count; ++i) {
    std::this_thread::sleep_for(std::chrono::microseconds(pause(random)));
    x = -x;
    const std::int64_t moved = base::steady_nanoseconds();
    fake.move(x);
    if (!wait_for_answer(fake, x)) return {};
    durations.push_back(static_cast<std::int32_t>(fake.force_since() - moved));
  }
  return durations;
}

std::vector<std::int32_t> round_trips(devices::PointerDevice& device, const FakeEnd& fake, ServoPace pace,
                                      int count) {
  std::atomic<bool> stop = false;
  std::thread servo([&] { serve(device, pace, stop); });
  std::vector<std::int32_t> durations = timed_answers(fake, count);
  stop = true;
  servo.join();
  return durations;
}

}  // namespace icome::benchmarks
