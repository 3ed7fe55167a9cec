#include "session/felt/haptic_loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/clock.h"

namespace icome::session {
namespace {

constexpr double kForceSamples = 200.0;       // a second
constexpr std::size_t kForceRoom = 200 * 30;  // half a minute without main
constexpr double kTraceRoom = 4.0;            // s of ticks without main

PointerView view_of(const haptics::TickReport& report, std::uint64_t losses, std::int64_t time) {
  PointerView view;
  view.time = time;
  view.status = report.status;
  view.tip = report.tip;
  view.orientation = report.orientation;
  view.device_from_stylus = report.device_from_stylus;
  view.buttons = report.buttons;
  view.touching = report.contact.touching;
  view.scp = view.touching ? report.contact.scp : report.tip;
  view.force = report.force;
  if (view.touching) {
    view.touched = report.object;
    view.asked_stiffness = report.asked_stiffness;
    view.stiffness = report.stiffness;
  }
  view.losses = losses;
  return view;
}

}  // namespace

HapticLoop::HapticLoop(std::vector<std::unique_ptr<devices::PointerDevice>> devices,
                       const haptics::ServoSettings& settings, DisplayFeed& display)
    : rate_hz_(settings.rate_hz),
      display_(display),
      forces_(kForceRoom),
      ticks_a_sample_(std::max(1, int(std::lround(settings.rate_hz / kForceSamples)))),
      trace_(std::size_t(std::ceil(settings.rate_hz * kTraceRoom))) {
  for (auto& device : devices) {
    auto hand = std::make_unique<Hand>();
    hand->servo = std::make_unique<haptics::Servo>(*device, settings);
    hand->device = std::move(device);
    hand->stage_from_device = settings.world_from_device;
    hands_.push_back(std::move(hand));
  }
}

base::Result<void> HapticLoop::start(bool realtime_priority) {
  realtime::LoopSettings settings;
  settings.rate_hz = rate_hz_;
  settings.realtime_priority = realtime_priority;
  // Locking all memory that a desktop with its designs has mapped would starve other programs.
  settings.lock_memory = false;
  auto loop =
      realtime::LoopRunner::create(settings, [this](const realtime::TickInfo& info) { return tick(info); });
  if (!loop) return tl::unexpected(loop.error());
  loop_ = std::move(*loop);
  return {};
}

void HapticLoop::stop() {
  if (!loop_ || !loop_->running()) return;
  loop_->stop();
  for (const auto& hand : hands_) hand->device->write(base::Vector3::Zero());
}

bool HapticLoop::tick(const realtime::TickInfo& info) {
  const std::int64_t time = base::steady_nanoseconds();
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    Hand& hand = *hands_[i];
    const haptics::TickReport& report = hand.servo->tick(info.dt);
    const bool lost = report.status == devices::DeviceStatus::Lost;
    if (lost && hand.status != devices::DeviceStatus::Lost) ++hand.losses;
    hand.status = report.status;
    PointerView view = view_of(report, hand.losses, time);
    view.spared = hand.servo->limiter().acted(haptics::LimiterAct::Continuous);
    hand.to_main.publish(view);
    display_.publish(i, view);
    if (i != 0) continue;
    sample_force(report, time);
    if (traces_.load(std::memory_order_relaxed) && !trace_.try_push(view))
      lost_ticks_.fetch_add(1, std::memory_order_relaxed);
  }
  ticks_.store(ticks_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  return true;
}

void HapticLoop::sample_force(const haptics::TickReport& report, std::int64_t time) {
  sample_.time = time;
  sample_.force = std::max(sample_.force, float(report.force.norm()));
  sample_.touching = sample_.touching || report.contact.touching;
  if (++ticks_of_sample_ < ticks_a_sample_) return;
  forces_.try_push(sample_);  // when nobody has looked for long, the newest are lost
  sample_ = {};
  ticks_of_sample_ = 0;
}

void HapticLoop::update() {
  for (const auto& hand : hands_) hand->to_main.update();
}

void HapticLoop::carry(std::size_t pointer, const base::Pose& stage_from_device) {
  Hand& hand = *hands_[pointer];
  if (!stage_from_device.matrix().allFinite()) return;
  if (stage_from_device.matrix() == hand.stage_from_device.matrix()) return;
  hand.stage_from_device = stage_from_device;
  hand.servo->carry(stage_from_device);
}

void HapticLoop::grip(std::size_t pointer, const haptics::GripFeel& feel) {
  hands_[pointer]->servo->grip(feel);
}

void HapticLoop::give_forces(std::size_t pointer, bool given) { hands_[pointer]->servo->give_forces(given); }

std::vector<PointerView> HapticLoop::take_trace() {
  std::vector<PointerView> ticks;
  while (const auto tick = trace_.try_pop()) ticks.push_back(*tick);
  return ticks;
}

std::vector<ForceSample> HapticLoop::take_forces() {
  std::vector<ForceSample> samples;
  while (const auto sample = forces_.try_pop()) samples.push_back(*sample);
  return samples;
}

std::vector<haptics::Servo*> HapticLoop::servos() {
  std::vector<haptics::Servo*> servos;
  for (const auto& hand : hands_) servos.push_back(hand->servo.get());
  return servos;
}

}  // namespace icome::session
