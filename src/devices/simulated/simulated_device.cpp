#include "devices/simulated/simulated_device.h"

#include <cassert>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>
#include <utility>

namespace icome::devices {
namespace {

Vector3 rounded_to(const Vector3& position, double resolution) {
  if (resolution <= 0.0) return position;
  return resolution * (position / resolution).array().round().matrix();
}

// The exact solution of m x'' + b x' + k x = push over `seconds` with a constant push: the first two rows
// of the exponential of the system matrix, the push (as an acceleration) being a third state.
std::array<std::array<double, 3>, 2> exact_step(double mass, const SimulatedHand& hand, double seconds) {
  base::Matrix3 system;
  system << 0.0, 1.0, 0.0, -hand.stiffness / mass, -hand.damping / mass, 1.0, 0.0, 0.0, 0.0;
  const base::Matrix3 after = (system * seconds).exp();
  return {{{after(0, 0), after(0, 1), after(0, 2)}, {after(1, 0), after(1, 1), after(1, 2)}}};
}

}  // namespace

SimulatedDevice::SimulatedDevice(SimulatedSettings settings)
    : settings_(std::move(settings)),
      substep_(1.0 / (settings_.rate * settings_.substeps)),
      target_(settings_.start),
      turned_(Quaternion::Identity()),
      position_(settings_.start),
      encoder_(rounded_to(settings_.start, settings_.encoder_resolution)) {
  assert(settings_.rate > 0.0 && settings_.substeps > 0 && settings_.info.effective_mass > 0.0);
  assert(settings_.hand.mass >= 0.0 && settings_.hand.stiffness >= 0.0 && settings_.hand.damping >= 0.0);
  step_ = exact_step(settings_.info.effective_mass + settings_.hand.mass, settings_.hand, substep_);
}

DeviceStatus SimulatedDevice::read(PointerState& state) {
  const SimulatedFailure failure = failure_.load(std::memory_order_relaxed);
  if (failure == SimulatedFailure::Unplugged) force_ = Vector3::Zero();
  if (put_.update()) set_down(put_.read());
  advance();
  const Vector3 reading = rounded_to(position_, settings_.encoder_resolution);
  const Vector3 difference = (reading - encoder_) * settings_.rate;
  encoder_ = reading;
  if (failure == SimulatedFailure::Unplugged) return DeviceStatus::Lost;
  if (failure == SimulatedFailure::Stalled) return DeviceStatus::Stalled;
  state = PointerState{};
  state.position = reading;
  state.velocity = settings_.encoder_resolution > 0.0 ? difference : velocity_;
  turned_.update();
  state.orientation = turned_.read();
  state.buttons = buttons_.load(std::memory_order_relaxed);
  state.jumped = std::exchange(jumped_, false);
  state.parked = parked_;
  if (failure == SimulatedFailure::NotANumber) state.position.setConstant(std::nan(""));
  return DeviceStatus::Ok;
}

DeviceStatus SimulatedDevice::write(const Vector3& force) {
  if (failure_.load(std::memory_order_relaxed) == SimulatedFailure::Unplugged) return DeviceStatus::Lost;
  force_ = force.allFinite() ? force : Vector3::Zero();
  return DeviceStatus::Ok;
}

void SimulatedDevice::set_down(const Put& put) {
  position_ = put.position;
  parked_ = put.parked;
  velocity_ = force_ = Vector3::Zero();
  encoder_ = rounded_to(position_, settings_.encoder_resolution);
  jumped_ = true;
}

void SimulatedDevice::advance() {
  target_.update();
  const double start = time();
  const double mass = settings_.info.effective_mass + settings_.hand.mass;
  for (int i = 0; i < settings_.substeps; ++i) {
    const Vector3 push = (force_ + settings_.hand.stiffness * target_at(start + i * substep_)) / mass;
    const Vector3 moved = step_[0][0] * position_ + step_[0][1] * velocity_ + step_[0][2] * push;
    velocity_ = step_[1][0] * position_ + step_[1][1] * velocity_ + step_[1][2] * push;
    position_ = moved;
  }
  ++ticks_;
}

Vector3 SimulatedDevice::target_at(double time) const {
  return settings_.trajectory ? settings_.trajectory(time) : target_.read();
}

}  // namespace icome::devices
