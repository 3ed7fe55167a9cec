#include "sketch/feel/felt_stroke.h"

#include <algorithm>
#include <cmath>

#include "devices/simulated/simulated_device.h"
#include "haptics/servo/servo.h"

namespace icome::sketch {
namespace {

using base::Vector2;
using base::Vector3;

constexpr double kAbove = 0.005;         // m, from where the hand comes down
constexpr double kComingDown = 0.6;      // s: the limiter lets forces grow for half a second
constexpr double kLiftingUp = 0.2;       // s
constexpr double kLeastPressure = 0.02;  // a pen that presses less draws nothing

/// The place that the hand aims for at each time. In the device's frame the paper is the plane z = 0, seen
/// from +z, with the middle of the stroke at the origin and y up.
class Aim {
 public:
  /// `give`: m for each N by which the hand and the paper give way together.
  Aim(const PenStroke& stroke, const Vector2& middle, double give)
      : stroke_(stroke), middle_(middle), give_(give) {}

  double seconds() const { return kComingDown + drawing_seconds() + kLiftingUp; }

  Vector3 at(double time) const {
    const double drawn = std::clamp(time - kComingDown, 0.0, drawing_seconds());
    const PenSample sample = sample_at(stroke_.front().time + drawn);
    const double down = std::clamp(std::min(time / kComingDown, (seconds() - time) / kLiftingUp), 0.0, 1.0);
    // The hand's spring presses as it aims below the paper.
    const double below = sample.pressure * kFullPressure * give_;
    const double smooth = down * down * (3.0 - 2.0 * down);
    return {sample.place.x() - middle_.x(), middle_.y() - sample.place.y(),
            kAbove - smooth * (kAbove + below)};
  }

  Vector2 on_paper(const Vector3& tip) const { return {tip.x() + middle_.x(), middle_.y() - tip.y()}; }
  double drawing_seconds() const { return stroke_.back().time - stroke_.front().time; }

 private:
  PenSample sample_at(double time) const {
    const auto after = std::upper_bound(stroke_.begin(), stroke_.end(), time,
                                        [](double t, const PenSample& sample) { return t < sample.time; });
    if (after == stroke_.begin()) return stroke_.front();
    if (after == stroke_.end()) return stroke_.back();
    const PenSample& from = *(after - 1);
    const double part = (time - from.time) / (after->time - from.time);
    return {time, from.place + part * (after->place - from.place),
            from.pressure + part * (after->pressure - from.pressure)};
  }

  const PenStroke& stroke_;
  Vector2 middle_;
  double give_;
};

void add_tick(FeltStroke& felt, const PenTick& tick) {
  if (!felt.ticks.empty()) {
    const PenTick& last = felt.ticks.back();
    felt.greatest_step = std::max(felt.greatest_step, (tick.force - last.force).norm());
    // The force of the last tick was held until this one.
    felt.work += last.force.dot(tick.tip - last.tip);
  }
  felt.greatest = std::max(felt.greatest, tick.force.norm());
  felt.ticks.push_back(tick);
}

double mean_rubbing(const std::vector<PenTick>& ticks) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const PenTick& tick : ticks) {
    if (tick.pressure < kLeastPressure) continue;
    sum += tick.force.head<2>().norm();
    ++count;
  }
  return count > 0 ? sum / double(count) : 0.0;
}

}  // namespace

FeltStroke felt_stroke(const PenStroke& stroke, const Paper& paper, const SimulatedPen& pen) {
  devices::SimulatedSettings settings;
  settings.info = pen.device;
  settings.rate = pen.rate_hz;
  Eigen::AlignedBox2d box;
  for (const PenSample& sample : stroke) box.extend(sample.place);
  const Aim aim(stroke, box.center(),
                give_of(settings.hand.stiffness, settings.info, paper, 1.0 / settings.rate));
  settings.start = aim.at(0.0);
  settings.trajectory = [&aim](double time) { return aim.at(time); };
  devices::SimulatedDevice device(settings);
  haptics::ServoSettings servo_settings;
  servo_settings.rate_hz = pen.rate_hz;
  haptics::Servo servo(device, servo_settings);
  servo.publish(scene_of(paper, pen.eraser));
  const double dt = 1.0 / pen.rate_hz;
  const auto ticks = std::size_t(std::ceil(aim.seconds() * pen.rate_hz));
  FeltStroke felt;
  felt.ticks.reserve(ticks);
  for (std::size_t i = 0; i < ticks; ++i) {
    const haptics::TickReport& report = servo.tick(dt);
    PenTick tick;
    tick.time = double(i) * dt;
    tick.tip = report.tip;
    tick.velocity = device.true_velocity();
    tick.force = report.force;
    if (report.contact.touching) tick.pressure = std::clamp(report.force.z() / kFullPressure, 0.0, 1.0);
    add_tick(felt, tick);
    const bool drawing = tick.time >= kComingDown && tick.time <= kComingDown + aim.drawing_seconds();
    if (drawing && tick.pressure >= kLeastPressure)
      felt.drawn.push_back({tick.time - kComingDown, aim.on_paper(report.contact.scp), tick.pressure});
  }
  felt.rubbing = mean_rubbing(felt.ticks);
  return felt;
}

}  // namespace icome::sketch
