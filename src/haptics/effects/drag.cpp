#include "haptics/effects/drag.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace icome::haptics {

Vector3 ViscousDamping::force(const EffectInput& input) {
  return -stable_damping(0.0, input.device_mass, input.dt, damping_) * input.velocity;
}

std::string ViscousDamping::capped(double device_mass, double dt) const {
  const double felt = stable_damping(0.0, device_mass, dt, damping_);
  if (felt >= damping_) return {};
  return fmt::format("damping {:g} N s/m is felt as {:g} N s/m", damping_, felt);
}

FrictionEffect::FrictionEffect(const FrictionSettings& settings) : settings_(settings) {
  assert(settings.stiffness > 0.0 && settings.dynamic_force >= 0.0);
  assert(settings.static_force >= settings.dynamic_force);
}

Vector3 FrictionEffect::force(const EffectInput& input) {
  if (!anchored_) anchor_ = input.position;
  anchored_ = true;
  const double stiffness = stable_stiffness(input.device_mass, input.dt, settings_.stiffness);
  const Vector3 stretch = anchor_ - input.position;
  const double length = stretch.norm();
  const double longest = (sliding_ ? settings_.dynamic_force : settings_.static_force) / stiffness;
  sliding_ = length > longest;
  if (!sliding_) {
    // The spring of a sticking tip needs its damper; it may stop the tip but never outdo dry friction.
    const double damping = stable_damping(stiffness, input.device_mass, input.dt, kAutomaticDamping);
    const Vector3 held = stiffness * stretch - damping * input.velocity;
    const double most = stiffness * longest;
    return held.norm() > most ? Vector3(held.normalized() * most) : held;
  }
  // The anchor is dragged along behind the tip, at the distance that gives the sliding force.
  const Vector3 dragged = stretch * (settings_.dynamic_force / stiffness / length);
  anchor_ = input.position + dragged;
  return stiffness * dragged;
}

Vector3 Inertia::force(const EffectInput& input) {
  if (!started_) {
    started_ = true;
    last_velocity_ = input.velocity;
    acceleration_.setZero();
  }
  const Vector3 measured = (input.velocity - last_velocity_) / input.dt;
  last_velocity_ = input.velocity;
  const double smooth = 1.0 - std::exp(-2.0 * std::numbers::pi * corner_hz_ * input.dt);
  const double stable = 1.0 / (1.0 + mass_ / input.device_mass);
  acceleration_ += std::min(smooth, stable) * (measured - acceleration_);
  return -mass_ * acceleration_;
}

}  // namespace icome::haptics
