#include "haptics/servo/force_limiter.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace icome::haptics {
namespace {

// Factor on a scaled vector, so that rounding cannot make it longer than asked for.
constexpr double kRoundingRoom = 1.0 - 4e-15;

// Share of the thermal budget that is kept to bring the limit down smoothly.
constexpr double kThermalKnee = 0.5;

constexpr double kFullForceSeconds = 0.002;  // s, of the default rate

double sensible_limit(double value) { return std::isfinite(value) ? std::max(0.0, value) : 0.0; }

// `force` with its direction and at most `longest` long; exact for every finite force, also where its
// square overflows.
Vector3 shortened(const Vector3& force, double longest) {
  if (longest <= 0.0) return Vector3::Zero();
  if (force.squaredNorm() <= longest * longest) return force;  // nearly always
  const double largest = force.cwiseAbs().maxCoeff();
  const Vector3 scaled = force / largest;
  const double length = scaled.norm();  // 1 to sqrt(3)
  if (largest <= longest / length) return force;
  return scaled * (longest / length * kRoundingRoom);
}

}  // namespace

ForceLimiter::ForceLimiter(const devices::DeviceInfo& device, const LimiterSettings& settings)
    : max_force_(sensible_limit(device.max_force) * kRoundingRoom),
      continuous_force_(std::min(sensible_limit(device.continuous_force), max_force_)),
      max_rate_(settings.max_rate > 0.0 ? settings.max_rate : max_force_ / kFullForceSeconds),
      settings_(settings) {
  assert(settings.ramp_seconds >= 0.0 && settings.thermal_seconds > 0.0);
  assert(settings.stall_ticks >= 1 && settings.longest_step > 0.0);
}

Vector3 ForceLimiter::limit(const Vector3& wanted, double dt, const LimiterInput& input) {
  acts_ = 0;
  if (faulty(wanted, dt, input)) {
    restart();
    last_ = Vector3::Zero();
    if (std::isfinite(dt) && dt > 0.0) warm(0.0, dt);
    return last_;
  }
  const double step = std::min(dt, settings_.longest_step);
  if (input.started_inside && !was_inside_) restart();
  was_inside_ = input.started_inside;

  const Vector3 clamped = shortened(wanted, max_force_);
  if (clamped != wanted) note(LimiterAct::Clamped);
  const Vector3 grown = ramped(clamped, step);
  const double allowed = allowed_force();
  const Vector3 sustained = shortened(grown, allowed);
  if (sustained != grown) note(LimiterAct::Continuous);

  // The last force is brought under the present limit first: from there a step towards another force
  // under the limit cannot leave it (balls are convex). The length of that change is taken off the step.
  const Vector3 from = shortened(last_, allowed);
  const double reach = std::max(0.0, max_rate_ * step - (last_ - from).norm());
  const Vector3 change = shortened(sustained - from, reach);
  if (change != sustained - from) note(LimiterAct::RateLimited);
  last_ = shortened(change == sustained - from ? sustained : Vector3(from + change), allowed);
  warm(last_.norm(), dt);
  return last_;
}

bool ForceLimiter::faulty(const Vector3& wanted, double dt, const LimiterInput& input) {
  stale_ticks_ = input.source_fresh ? 0 : std::min(stale_ticks_ + 1, settings_.stall_ticks);
  if (!wanted.allFinite() || !std::isfinite(dt) || dt <= 0.0) note(LimiterAct::NotFinite);
  if (stale_ticks_ >= settings_.stall_ticks) note(LimiterAct::Stalled);
  if (!input.device_ok) note(LimiterAct::DeviceLost);
  return acts_ != 0;
}

void ForceLimiter::note(LimiterAct act) {
  acts_ |= 1U << static_cast<unsigned>(act);
  ++counts_[static_cast<std::size_t>(act)];
}

Vector3 ForceLimiter::ramped(const Vector3& force, double step) {
  if (ramp_ >= 1.0) return force;
  ramp_ = settings_.ramp_seconds > 0.0 ? std::min(1.0, ramp_ + step / settings_.ramp_seconds) : 1.0;
  if (ramp_ < 1.0 && !force.isZero(0.0)) note(LimiterAct::RampedIn);
  return ramp_ * force;
}

void ForceLimiter::warm(double force, double dt) {
  const double limit = continuous_force_ * continuous_force_;
  // 1 - exp(-x) to x^3: ticks are thousands of times shorter than the motors take to warm.
  const double x = std::min(1.0, dt / settings_.thermal_seconds);
  const double share = x * (1.0 - x * (0.5 - x / 6.0));
  mean_square_ = std::min(limit, mean_square_ + share * (force * force - mean_square_));
}

double ForceLimiter::heat() const {
  if (continuous_force_ <= 0.0) return 1.0;
  return mean_square_ / (continuous_force_ * continuous_force_);
}

double ForceLimiter::allowed_force() const {
  // |force|^2 may be f_c^2 plus a part of the peak's surplus that shrinks with the room left below the
  // rating. In equilibrium h = |force|^2, which only h = f_c^2 solves: h creeps up to it from below.
  const double room = std::clamp((1.0 - heat()) / kThermalKnee, 0.0, 1.0);
  const double continuous = continuous_force_ * continuous_force_;
  const double surplus = max_force_ * max_force_ - continuous;
  return std::min(max_force_, std::sqrt(continuous + surplus * room));
}

void ForceLimiter::restart() { ramp_ = 0.0; }

}  // namespace icome::haptics
