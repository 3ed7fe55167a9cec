#include "haptics/effects/drag.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace icome::haptics {

Vector3 ViscousDamping::force(const EffectInput& input) {
  return -stable_damping(0.0, input.device_mass, input.dt, damping_) * input.velocity;
}

FrictionEffect::FrictionEffect(const FrictionSettings& settings) : settings_(settings) {
  assert(settings.stiffness > 0.0 && settings.dynamic_force >= 0.0);
  assert(settings.static_force >= settings.dynamic_force);
}

void FrictionEffect::continue_from(const Effect& before) {
  if (const auto* same = dynamic_cast<const FrictionEffect*>(&before)) memory_ = same->memory_;
}

Vector3 FrictionEffect::force(const EffectInput& input) {
  Memory& memory = *memory_;
  if (!memory.anchored) memory.anchor = input.position;
  memory.anchored = true;
  const double stiffness = stable_stiffness(input.device_mass, input.dt, settings_.stiffness);
  const Vector3 stretch = memory.anchor - input.position;
  const double length = stretch.norm();
  const double longest = (memory.sliding ? settings_.dynamic_force : settings_.static_force) / stiffness;
  memory.sliding = length > longest;
  if (!memory.sliding) {
    // The spring of a sticking tip needs its damper; it may stop the tip but never outdo dry friction.
    const double damping = stable_damping(stiffness, input.device_mass, input.dt, kAutomaticDamping);
    const Vector3 held = stiffness * stretch - damping * input.velocity;
    const double most = stiffness * longest;
    return held.norm() > most ? Vector3(held.normalized() * most) : held;
  }
  // The anchor is dragged along behind the tip, at the distance that gives the sliding force.
  const Vector3 dragged = stretch * (settings_.dynamic_force / stiffness / length);
  memory.anchor = input.position + dragged;
  return stiffness * dragged;
}

void Inertia::reframe(const base::Pose& new_from_old) {
  Memory& memory = *memory_;
  memory.last_velocity = new_from_old.linear() * memory.last_velocity;
  memory.acceleration = new_from_old.linear() * memory.acceleration;
}

void Inertia::continue_from(const Effect& before) {
  if (const auto* same = dynamic_cast<const Inertia*>(&before)) memory_ = same->memory_;
}

double Inertia::low_pass(double dt) const {
  return 1.0 - std::exp(-2.0 * std::numbers::pi * corner_hz_ * dt);
}

double Inertia::mass_needed(double device_mass, double dt) const {
  const double smooth = low_pass(dt);
  return std::min(device_mass, mass_ * smooth / (1.0 - smooth));  // from which on 1/(1 + M/m) >= smooth
}

Vector3 Inertia::force(const EffectInput& input) {
  Memory& memory = *memory_;
  if (!memory.started) {
    memory.started = true;
    memory.last_velocity = input.velocity;
    memory.acceleration.setZero();
  }
  const Vector3 measured = (input.velocity - memory.last_velocity) / input.dt;
  memory.last_velocity = input.velocity;
  const double stable = 1.0 / (1.0 + mass_ / input.device_mass);
  memory.acceleration += std::min(low_pass(input.dt), stable) * (measured - memory.acceleration);
  return -mass_ * memory.acceleration;
}

}  // namespace icome::haptics
