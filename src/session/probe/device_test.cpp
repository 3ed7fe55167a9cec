#include "session/probe/device_test.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "base/clock.h"
#include "haptics/servo/force_limiter.h"
#include "realtime/loop.h"

namespace icome::session {
namespace {

constexpr double kLongestTest = 600.0;  // s
constexpr double kRampSeconds = 1.5;    // s that the slow force takes to grow, and again to fall
constexpr int kPushes = 10;             // short ones, to and fro
constexpr double kPushSeconds = 0.03;   // s that each lasts
constexpr double kPauseSeconds = 0.4;   // s to come to rest after it
constexpr double kLeastWay = 20e-6;     // m, by which a push is told from noise
constexpr double kRate = 2000.0;        // N/s, the fastest that a force changes here
// A hand that holds a device still stays within these, and so does a tracker that lies on a table.
constexpr double kStillNoise = 0.002;  // m
constexpr double kStillWay = 0.015;    // m

/// The force along y (N) at a time since the forces began, for a test with this strongest one.
double asked_force(double t, double strongest) {
  if (t < kRampSeconds) return strongest * t / kRampSeconds;
  if (t < 2.0 * kRampSeconds) return strongest * (2.0 - t / kRampSeconds);
  const double since = t - 2.0 * kRampSeconds;
  const int push = int(since / (kPushSeconds + kPauseSeconds));
  // Each push begins with a pause.
  if (push >= kPushes || since - push * (kPushSeconds + kPauseSeconds) < kPauseSeconds) return 0.0;
  return push % 2 == 0 ? strongest : -strongest;
}

double force_seconds() {
  return 2.0 * kRampSeconds + kPushes * (kPushSeconds + kPauseSeconds) + kPauseSeconds;
}

/// Ticks a device on a loop, and keeps its readings.
class Probe {
 public:
  Probe(devices::PointerDevice& device, const DeviceTestSettings& settings, double seconds)
      : device_(device),
        settings_(settings),
        limiter_(device.info(), {.max_rate = kRate}),
        all_(std::size_t(std::clamp(seconds, 0.1, kLongestTest) * settings.rate_hz)) {
    ticks_.resize(all_);
  }

  base::Result<void> run(const std::function<bool(double, double)>& goes_on) {
    realtime::LoopSettings loop_settings;
    loop_settings.rate_hz = settings_.rate_hz;
    loop_settings.lock_memory = false;
    loop_settings.name = "device test";
    auto loop = realtime::LoopRunner::create(loop_settings,
                                             [this](const realtime::TickInfo& info) { return tick(info); });
    if (!loop) return tl::unexpected(loop.error());
    while ((*loop)->running() && !is_away()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      if (!goes_on(double(done_.load(std::memory_order_relaxed)) / settings_.rate_hz,
                   double(all_) / settings_.rate_hz))
        break;
    }
    (*loop)->stop();
    device_.write(Vector3::Zero());
    ticks_.resize(done_.load(std::memory_order_acquire));
    return {};
  }

  std::vector<ProbedTick>& ticks() { return ticks_; }
  std::uint64_t lost() const { return lost_; }
  bool lost_at_end() const { return lost_in_a_row_.load(std::memory_order_relaxed) > 0; }

 private:
  /// Has the device been away for so long that it hardly comes back?
  bool is_away() const {
    constexpr double kLongestLoss = 3.0;  // s
    return double(lost_in_a_row_.load(std::memory_order_relaxed)) > kLongestLoss * settings_.rate_hz;
  }
  bool tick(const realtime::TickInfo& info) {
    const std::size_t index = done_.load(std::memory_order_relaxed);
    if (index >= all_) return false;
    const devices::DeviceStatus status = device_.read(state_);
    const std::int64_t now = base::steady_nanoseconds();
    if (index == 0) start_ = now;
    ProbedTick& tick = ticks_[index];
    tick.t = 1e-9 * double(now - start_);
    tick.fresh = status == devices::DeviceStatus::Ok;
    const bool is_lost = status == devices::DeviceStatus::Lost;
    if (is_lost) ++lost_;
    lost_in_a_row_.store(is_lost ? lost_in_a_row_.load(std::memory_order_relaxed) + 1 : 0,
                         std::memory_order_relaxed);
    tick.position = state_.position;
    Vector3 wanted = Vector3::Zero();
    if (settings_.force > 0.0 && tick.t >= settings_.seconds)
      wanted.y() = asked_force(tick.t - settings_.seconds, settings_.force);
    tick.force = limiter_.limit(wanted, info.dt, {.source_fresh = tick.fresh, .device_ok = !is_lost});
    device_.write(tick.force);
    done_.store(index + 1, std::memory_order_release);
    return true;
  }

  devices::PointerDevice& device_;
  DeviceTestSettings settings_;
  haptics::ForceLimiter limiter_;
  std::size_t all_;
  std::vector<ProbedTick> ticks_;
  std::atomic<std::size_t> done_ = 0;
  devices::PointerState state_;
  std::int64_t start_ = 0;  // ns, of the first tick
  std::uint64_t lost_ = 0;
  std::atomic<std::uint64_t> lost_in_a_row_ = 0;  // ticks, up to the newest one
};

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void measure_readings(DeviceTestResult& result) {
  std::vector<double> gaps;
  double last = std::numeric_limits<double>::quiet_NaN();
  for (const ProbedTick& tick : result.ticks) {
    if (!tick.fresh) {
      ++result.stalled;
      continue;
    }
    ++result.readings;
    if (std::isfinite(last)) gaps.push_back(1e3 * (tick.t - last));
    last = tick.t;
  }
  result.stalled -= std::min(result.stalled, result.lost);
  if (!result.ticks.empty() && result.ticks.back().t > 0.0)
    result.rate_hz = double(result.readings - (result.readings > 0)) / result.ticks.back().t;
  result.interval_ms = {quantile(gaps, 0.5), quantile(gaps, 0.99), quantile(gaps, 1.0)};
}

/// Standard deviation about the straight line that fits best, so that a slow drift is no noise.
double noise_about_line(const std::vector<double>& t, const std::vector<double>& x) {
  const double n = double(t.size());
  if (t.size() < 3) return 0.0;
  double mean_t = 0.0, mean_x = 0.0, tt = 0.0, tx = 0.0, xx = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) mean_t += t[i] / n, mean_x += x[i] / n;
  for (std::size_t i = 0; i < t.size(); ++i) {
    tt += (t[i] - mean_t) * (t[i] - mean_t);
    tx += (t[i] - mean_t) * (x[i] - mean_x);
    xx += (x[i] - mean_x) * (x[i] - mean_x);
  }
  const double rest = xx - (tt > 0.0 ? tx * tx / tt : 0.0);
  return std::sqrt(std::max(0.0, rest) / (n - 2.0));
}

void measure_noise(DeviceTestResult& result, double seconds) {
  std::vector<double> t;
  std::array<std::vector<double>, 3> x;
  for (const ProbedTick& tick : result.ticks) {
    if (!tick.fresh || tick.t >= seconds) continue;
    t.push_back(tick.t);
    for (int axis = 0; axis < 3; ++axis) x[std::size_t(axis)].push_back(tick.position[axis]);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double>& places = x[std::size_t(axis)];
    result.noise[axis] = noise_about_line(t, places);
    if (places.empty()) continue;
    const auto [low, high] = std::minmax_element(places.begin(), places.end());
    result.moved = std::max(result.moved, *high - *low);
  }
  result.was_still = result.noise.maxCoeff() <= kStillNoise && result.moved <= kStillWay;
}

/// A push: the tick in which it begins, and the device's place and speed before.
struct Push {
  std::size_t start = 0;
  double from = 0.0;   // m
  double speed = 0.0;  // m/s
};

Push push_at(const std::vector<ProbedTick>& ticks, std::size_t start) {
  constexpr double kLookBack = 0.03;  // s
  std::size_t first = start;
  while (first > 0 && ticks[start].t - ticks[first].t < kLookBack) --first;
  const double time = ticks[start].t - ticks[first].t;
  const double way = ticks[start].position.y() - ticks[first].position.y();
  return {start, ticks[start].position.y(), time > 0.0 ? way / time : 0.0};
}

/// The first time at which a push has moved the device by `way` (m, signed), between readings; NaN if it has
/// not soon.
double time_of_way(const std::vector<ProbedTick>& ticks, const Push& push, double way) {
  const double begin = ticks[push.start].t;
  const auto share_gone = [&](const ProbedTick& tick) {
    return (tick.position.y() - push.from - push.speed * (tick.t - begin)) / way;
  };
  std::size_t last = push.start;
  for (std::size_t i = push.start + 1; i < ticks.size() && ticks[i].t < begin + kPushSeconds + 0.1; ++i) {
    if (!ticks[i].fresh) continue;  // its place is that of an earlier time
    const double gone = share_gone(ticks[i]);
    const double before = share_gone(ticks[last]);
    if (gone >= 1.0) {
      const double share = gone > before ? std::clamp((1.0 - before) / (gone - before), 0.0, 1.0) : 1.0;
      return std::lerp(ticks[last].t, ticks[i].t, share);
    }
    last = i;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::optional<double> delay_of_pushes(const std::vector<ProbedTick>& ticks, double noise) {
  const double way = std::max(kLeastWay, 6.0 * noise);
  std::vector<double> delays;
  for (std::size_t i = 1; i < ticks.size(); ++i) {
    const double force = ticks[i].force.y();
    if (ticks[i - 1].force.y() != 0.0 || std::abs(force) < 0.05) continue;
    const Push push = push_at(ticks, i);
    const double t1 = time_of_way(ticks, push, std::copysign(way, force));
    const double t2 = time_of_way(ticks, push, std::copysign(4.0 * way, force));
    if (std::isfinite(t1) && std::isfinite(t2)) delays.push_back(2.0 * t1 - t2 - ticks[i].t);
  }
  if (delays.size() < kPushes / 2) return std::nullopt;
  return std::max(0.0, quantile(delays, 0.5));
}

ForceTest measure_force(const DeviceTestResult& result, double seconds) {
  ForceTest test;
  Vector3 rest = Vector3::Zero();
  for (const ProbedTick& tick : result.ticks) {
    if (tick.t < seconds) {
      rest = tick.position;
      continue;
    }
    test.strongest = std::max(test.strongest, tick.force.norm());
    if (tick.fresh) test.moved = std::max(test.moved, (tick.position - rest).norm());
  }
  if (result.was_still) test.delay = delay_of_pushes(result.ticks, result.noise.y());
  return test;
}

base::Error gives_nothing(const devices::PointerDevice& device) {
  const std::string why = device.condition();
  return {device.info().name + ": it gave no reading" +
          (why.empty() ? "; see that it is switched on and calibrated" : ": " + why)};
}

}  // namespace

base::Result<DeviceTestResult> test_device(devices::PointerDevice& device, const DeviceTestSettings& settings,
                                           const std::function<bool(double, double)>& goes_on) {
  const bool pushes = settings.force > 0.0 && device.info().max_force > 0.0;
  DeviceTestSettings possible = settings;
  possible.force = pushes ? std::min(settings.force, device.info().max_force) : 0.0;
  Probe probe(device, possible, settings.seconds + (pushes ? force_seconds() : 0.0));
  if (const auto ran = probe.run(goes_on); !ran) return tl::unexpected(ran.error());
  DeviceTestResult result;
  result.ticks = std::move(probe.ticks());
  result.lost = probe.lost();
  result.lost_at_end = probe.lost_at_end();
  measure_readings(result);
  if (result.readings == 0) return tl::unexpected(gives_nothing(device));
  measure_noise(result, settings.seconds);
  if (pushes) result.force = measure_force(result, settings.seconds);
  return result;
}

base::Result<DeviceRange> find_range(devices::PointerDevice& device, double rate_hz, double seconds,
                                     const std::function<bool(double, double)>& goes_on) {
  Probe probe(device, {.rate_hz = rate_hz, .seconds = seconds}, seconds);
  if (const auto ran = probe.run(goes_on); !ran) return tl::unexpected(ran.error());
  DeviceRange range;
  bool any = false;
  for (const ProbedTick& tick : probe.ticks()) {
    if (!tick.fresh) continue;
    range.low = any ? Vector3(range.low.cwiseMin(tick.position)) : tick.position;
    range.high = any ? Vector3(range.high.cwiseMax(tick.position)) : tick.position;
    any = true;
  }
  if (!any) return tl::unexpected(gives_nothing(device));
  return range;
}

}  // namespace icome::session
