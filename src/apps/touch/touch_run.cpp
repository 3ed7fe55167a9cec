#include "apps/touch/touch_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "apps/interrupt.h"
#include "apps/stopwatch.h"
#include "apps/terminal.h"
#include "apps/touch/effect_options.h"
#include "devices/device_news.h"
#include "devices/simulated/simulated_device.h"
#include "haptics/servo/servo.h"
#include "realtime/locked_memory.h"
#include "realtime/loop.h"
#include "realtime/message_pipe.h"

namespace icome::apps {
namespace {

// Rows between two entries in the log: its work then disturbs the caches of few ticks.
constexpr std::size_t kBlockRows = 8192;

// The longest time that the log may fall behind the servo, s.
constexpr double kLongestDelay = 60.0;

constexpr auto kDiaryPeriod = std::chrono::milliseconds(10);

haptics::ServoSettings servo_settings(const TouchOptions& options) {
  haptics::ServoSettings settings;
  settings.rate_hz = options.rate_hz;
  settings.renderer = renderer_of(options);
  settings.scp.tip_radius = options.radius;
  settings.force_shading = options.smooth_shading;
  return settings;
}

/// The number of rows of a path within its first `seconds`.
std::size_t rows_within(const std::vector<double>& times, const std::optional<double>& seconds) {
  if (!seconds) return times.size();
  const double last = times.front() + *seconds;
  return static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), last) - times.begin());
}

TickRow row_of(const haptics::TickReport& report, double t) {
  // A device that is away touches nothing, wherever it was last.
  const bool touches = report.contact.touching && report.status != devices::DeviceStatus::Lost;
  const std::int32_t object = touches ? static_cast<std::int32_t>(report.object.index) : kNothingTouched;
  return {t, report.tip, report.contact.scp, report.force, object, report.time, report.own_ns()};
}

/// The loop's side and the log's side of a run on the clock.
class ClockedRun {
 public:
  ClockedRun(haptics::Servo& servo, const TouchOptions& options, double seconds)
      : servo_(servo),
        rate_hz_(options.rate_hz),
        last_index_(static_cast<std::uint64_t>(std::max(1.0, std::round(seconds * options.rate_hz))) - 1),
        rows_(static_cast<std::size_t>(std::min(seconds, kLongestDelay) * options.rate_hz) + 1) {}

  /// One tick; false after the last. Real-time safe.
  bool tick(const realtime::TickInfo& info) {
    const haptics::TickReport& report = servo_.tick(info.dt);
    const bool is_lost = report.status == devices::DeviceStatus::Lost;
    if (is_lost) ++lost_ticks_;
    device_lost_.store(is_lost, std::memory_order_relaxed);
    if (!rows_.try_push(row_of(report, static_cast<double>(info.index) / rate_hz_))) ++lost_rows_;
    return info.index < last_index_;
  }

  /// Logs the rows that have come so far, until the user ends the run or `most` (s) has gone by: rows may
  /// come faster than they are judged. `seconds`: of the whole run.
  void drain(TickLog& log, StatusLine& status, double seconds,
             double most = std::numeric_limits<double>::infinity()) {
    const Stopwatch watch;
    while (!interrupted() && watch.seconds() < most) {
      status.progress("Touching", std::round(time_ * 10.0) / 10.0, seconds, "s");
      const auto row = rows_.try_pop();
      if (!row) return;
      log.add(*row);
      time_ = row->t;
    }
  }

  /// Was the device away in the newest tick? Any thread.
  bool device_lost() const { return device_lost_.load(std::memory_order_relaxed); }
  // Once the loop has ended.
  std::uint64_t lost_rows() const { return lost_rows_; }
  std::uint64_t lost_ticks() const { return lost_ticks_; }

 private:
  haptics::Servo& servo_;
  double rate_hz_;
  std::uint64_t last_index_;
  realtime::MessagePipe<TickRow> rows_;
  std::uint64_t lost_rows_ = 0;   // written by the loop
  std::uint64_t lost_ticks_ = 0;  // likewise
  std::atomic<bool> device_lost_ = false;
  double time_ = 0.0;  // s, of the last row logged
};

RunOutcome outcome_of(const realtime::LoopRunner& loop) {
  const realtime::LoopSummary summary = loop.recorder().summary();
  RunOutcome outcome;
  outcome.overruns = summary.overruns;
  outcome.skipped = summary.skipped;
  outcome.lateness = summary.lateness;
  outcome.notice = loop.report().notice;
  return outcome;
}

/// Publishes to the servo where things are at a row of a path; returns when to do so again, s.
double publish_from(const MovingScene& moving, haptics::Servo& servo, const std::vector<double>& times,
                    std::size_t row) {
  const double following = row + 1 < times.size() ? times[row + 1] : times[row];
  const double next = std::max(times[row] + MovingScene::kPeriod, following);
  moving.publish(servo, times[row] - times.front(), next - times.front());
  return moving.moves() ? next : std::numeric_limits<double>::infinity();
}

devices::SimulatedSettings simulated_settings(const Exploration& exploration,
                                              const devices::DeviceInfo& device, double rate_hz) {
  devices::SimulatedSettings settings;
  settings.info = device;
  settings.rate = rate_hz;
  settings.start = exploration.target(0.0) - exploration.centre();
  settings.trajectory = [&exploration](double t) -> base::Vector3 {
    return exploration.target(t) - exploration.centre();
  };
  return settings;
}

}  // namespace

RunOutcome replay(devices::PathPlayer& player, const std::shared_ptr<const haptics::HapticScene>& scene,
                  const std::vector<TouchModel>& models, const TouchOptions& options, TickLog& log,
                  StatusLine& status) {
  haptics::Servo servo(player, servo_settings(options));
  const MovingScene moving(models, options, scene);
  RunOutcome outcome;
  const std::vector<double>& times = player.times();
  const std::size_t rows = rows_within(times, options.seconds);
  log.reserve(rows);
  std::vector<TickRow> block;
  block.reserve(std::min(kBlockRows, rows));
  const double period = 1.0 / options.rate_hz;
  realtime::lock_memory();  // as a loop on the clock does, so that ticks cost here what they cost there
  const Stopwatch watch;
  double due = times.front();  // s, the time of the next publication
  for (std::size_t row = 0; row < rows && !outcome.interrupted;) {
    const std::size_t end = std::min(rows, row + kBlockRows);
    for (; row < end; ++row) {
      if (times[row] >= due) due = publish_from(moving, servo, times, row);
      const haptics::TickReport& report = servo.tick(row == 0 ? period : times[row] - times[row - 1]);
      block.push_back(row_of(report, times[row]));
    }
    for (const TickRow& it : block) {
      if (interrupted()) break;
      log.add(it);
      if (static_cast<double>(it.own_ns) * 1e-9 > period) ++outcome.overruns;
      status.progress("Replaying", static_cast<double>(log.ticks()), static_cast<double>(rows), "rows");
    }
    block.clear();
    outcome.interrupted = log.ticks() < row || (interrupted() && row < rows);
  }
  outcome.wall_seconds = watch.seconds();
  outcome.capped = capped_feel(models, options, servo);
  status.clear();
  return outcome;
}

base::Result<RunOutcome> touch_on_clock(devices::PointerDevice& device, const base::Vector3& centre,
                                        double seconds,
                                        const std::shared_ptr<const haptics::HapticScene>& scene,
                                        const std::vector<TouchModel>& models, const TouchOptions& options,
                                        TickLog& log, StatusLine& status) {
  haptics::ServoSettings settings = servo_settings(options);
  settings.world_from_device.translation() = centre;
  haptics::Servo servo(device, settings);
  const MovingScene moving(models, options, scene);
  moving.publish(servo, 0.0, MovingScene::kPeriod);
  ClockedRun run(servo, options, seconds);
  const Stopwatch watch;
  realtime::LoopSettings loop_settings;
  loop_settings.rate_hz = options.rate_hz;
  const auto loop = realtime::LoopRunner::create(
      loop_settings, [&run](const realtime::TickInfo& info) { return run.tick(info); });
  if (!loop) return tl::unexpected(loop.error());
  const Stopwatch started;
  devices::DeviceNews news(device.info().name);
  while ((*loop)->running() && !interrupted()) {
    std::this_thread::sleep_for(kDiaryPeriod);
    const double now = started.seconds();
    if (moving.moves()) moving.publish(servo, now, now + MovingScene::kPeriod);
    run.drain(log, status, seconds, MovingScene::kPeriod);
    for (const auto& item : news.look(run.device_lost(), device.condition())) {
      status.clear();
      tell(item.text);
    }
  }
  (*loop)->stop();
  device.write(base::Vector3::Zero());
  run.drain(log, status, seconds);
  status.clear();
  RunOutcome outcome = outcome_of(**loop);
  outcome.interrupted = interrupted();
  outcome.lost_rows = run.lost_rows();
  outcome.lost_ticks = run.lost_ticks();
  outcome.device_lost = run.device_lost();
  outcome.wall_seconds = watch.seconds();
  outcome.capped = capped_feel(models, options, servo);
  return outcome;
}

base::Result<RunOutcome> explore(const Exploration& exploration, const devices::DeviceInfo& device,
                                 const std::shared_ptr<const haptics::HapticScene>& scene,
                                 const std::vector<TouchModel>& models, const TouchOptions& options,
                                 TickLog& log, StatusLine& status) {
  devices::SimulatedDevice hand(simulated_settings(exploration, device, options.rate_hz));
  return touch_on_clock(hand, exploration.centre(), options.seconds.value_or(kDefaultSeconds), scene, models,
                        options, log, status);
}

}  // namespace icome::apps
