#include "sketch/feel/felt_pen.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "devices/simulated/simulated_device.h"
#include "sketch/feel/tool_effect.h"

namespace icome::sketch {
namespace {

using base::Vector3;

constexpr double kMiddleAbove = 0.02;     // m: the middle of the workspace lies above the paper
constexpr double kUsedReach = 0.9;        // of the workspace's circle on the paper
constexpr double kSmallSheet = 0.03;      // m, half of the diagonal: smaller paper is enlarged to that
constexpr double kDownFrom = 0.02;        // pressure from which a pen is down
constexpr double kUpBelow = 0.01;         // and below which it is up again
constexpr double kLifted = 0.005;         // m, of a simulated hand above the paper
constexpr double kRoomSeconds = 4.0;      // of ticks without the main thread
constexpr std::uint64_t kToolEffect = 1;  // number of the effect, which goes on when the grip changes

/// The paper's frame from the device's: the device's y is up.
base::Pose paper_from_device() {
  base::Pose pose = base::Pose::Identity();
  pose.linear() << 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0;
  pose.translation() = Vector3(0.0, 0.0, kMiddleAbove);
  return pose;
}

haptics::ServoSettings servo_settings() {
  haptics::ServoSettings settings;
  settings.rate_hz = FeltPen::kRate;
  settings.world_from_device = paper_from_device();
  return settings;
}

double scale_for(const devices::DeviceInfo& device, const Vector2& sheet) {
  const double square = device.workspace_radius * device.workspace_radius - kMiddleAbove * kMiddleAbove;
  const double reach = kUsedReach * std::sqrt(std::max(square, 1e-6));
  const double half = 0.5 * sheet.norm();
  return half < kSmallSheet ? half / kSmallSheet : std::max(1.0, half / reach);
}

}  // namespace

FeltPen::FeltPen(std::unique_ptr<devices::PointerDevice> device, const Paper& paper, const Vector2& sheet)
    : device_(std::move(device)),
      servo_(*device_, servo_settings()),
      paper_(paper),
      sheet_(sheet),
      scale_(scale_for(device_->info(), sheet)),
      ticks_(std::size_t(kRate * kRoomSeconds)) {
  servo_.begin_softly();
  publish_paper();
  hold({});
}

FeltPen::~FeltPen() {
  if (loop_) loop_->stop();
  device_->write(Vector3::Zero());
}

base::Result<void> FeltPen::start() {
  realtime::LoopSettings settings;
  settings.rate_hz = kRate;
  settings.lock_memory = false;  // that of a whole desktop would starve other programs
  auto loop = realtime::LoopRunner::create(settings, [this](const realtime::TickInfo& info) {
    step(info.dt);
    return true;
  });
  if (!loop) return tl::unexpected(loop.error());
  loop_ = std::move(*loop);
  return {};
}

void FeltPen::step(double dt) {
  const haptics::TickReport& report = servo_.tick(dt);
  time_ += dt;
  is_lost_.store(report.status == devices::DeviceStatus::Lost, std::memory_order_relaxed);
  ticks_.try_push(
      Tick{time_, report.tip, report.contact.touching, report.contact.scp, report.force.z(), report.buttons});
}

std::string FeltPen::condition() const {
  std::string said = device_->condition();
  if (said.empty() && is_lost_.load(std::memory_order_relaxed))
    said = "The device is lost; it is asked again all the time.";
  return said;
}

double FeltPen::full_pressure() const {
  const devices::DeviceInfo& device = info();
  return device.max_force > 0.0 ? std::min(kFullPressure, device.continuous_force) : kFullPressure;
}

void FeltPen::publish_paper() { servo_.publish(scene_of(paper_, eraser_)); }

void FeltPen::lay(const Paper& paper) {
  paper_ = paper;
  publish_paper();
}

void FeltPen::resize(const Vector2& sheet) {
  sheet_ = sheet;
  scale_ = scale_for(info(), sheet);
}

void FeltPen::turn_around(bool eraser) {
  if (std::exchange(eraser_, eraser) != eraser) publish_paper();
}

void FeltPen::hold(const ToolGrip& grip) {
  ToolGrip felt = grip;
  felt.start = in_hand(grip.start);
  felt.centre = in_hand(grip.centre);
  felt.turned /= scale_;
  felt.scaled /= scale_;
  if (grip.end) felt.end = in_hand(*grip.end);
  felt.within /= scale_;
  felt.free.y() *= -1.0;
  if (felt == grip_) return;
  grip_ = felt;
  haptics::PlacedEffect effect;
  effect.id = kToolEffect;
  effect.make = std::make_shared<const haptics::MakeEffect>(
      [felt]() -> std::unique_ptr<haptics::Effect> { return std::make_unique<ToolEffect>(felt); });
  servo_.publish_effects({effect});
}

Vector2 FeltPen::in_hand(const Vector2& place) const {
  const Vector2 from_middle = (place - 0.5 * sheet_) / scale_;
  return {from_middle.x(), -from_middle.y()};
}

PenReading FeltPen::reading_of(const Tick& tick) {
  const Vector3& at = tick.touching ? tick.scp : tick.tip;
  PenReading reading;
  reading.time = tick.time;
  reading.place = 0.5 * sheet_ + scale_ * Vector2(at.x(), -at.y());
  reading.height = std::max(0.0, at.z());
  reading.buttons = tick.buttons;
  const double pressure = tick.touching ? std::clamp(tick.pressing / full_pressure(), 0.0, 1.0) : 0.0;
  is_down_ = pressure >= (is_down_ ? kUpBelow : kDownFrom);
  reading.pressure = is_down_ ? pressure : 0.0;
  return reading;
}

std::vector<PenReading> FeltPen::take() {
  std::vector<PenReading> readings;
  while (const auto tick = ticks_.try_pop()) readings.push_back(reading_of(*tick));
  return readings;
}

bool FeltPen::is_simulated() const {
  return dynamic_cast<const devices::SimulatedDevice*>(device_.get()) != nullptr;
}

void FeltPen::aim(const Vector2& place, double pressure) {
  auto* const simulated = dynamic_cast<devices::SimulatedDevice*>(device_.get());
  if (simulated == nullptr) return;
  const double give = give_of(simulated->hand().stiffness, info(), paper_, 1.0 / kRate);
  const Vector2 there = in_hand(place);
  const auto in_device = [&](double height) -> Vector3 {
    return paper_from_device().inverse() * Vector3(there.x(), there.y(), height);
  };
  // A hand that swings after a jump of the mouse would draw on its way.
  if (const bool was_pressing = std::exchange(is_pressing_, pressure > 0.0); is_pressing_ && !was_pressing)
    simulated->put(in_device(kLifted));
  const double height = pressure > 0.0 ? -pressure * full_pressure() * give : kLifted;
  simulated->set_target(in_device(height));
}

}  // namespace icome::sketch
