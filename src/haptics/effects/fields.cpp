#include "haptics/effects/fields.h"

#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace icome::haptics {

Vector3 ConstantForce::force(const EffectInput& /*input*/) { return force_; }

ForceField::ForceField(Function function) : function_(std::move(function)) { assert(function_); }

Vector3 ForceField::force(const EffectInput& input) { return function_(input.position, input.time); }

GravityWell::GravityWell(const Vector3& centre, double radius, double stiffness)
    : centre_(centre), radius_(radius), stiffness_(stiffness) {
  assert(radius > 0.0 && stiffness >= 0.0);
}

double GravityWell::stiffness_of(double radius, double force) {
  // F(R/sqrt(5)) = k R/sqrt(5) (4/5)^2.
  return force * 25.0 * std::sqrt(5.0) / (16.0 * radius);
}

Vector3 GravityWell::force(const EffectInput& input) {
  const Vector3 offset = centre_ - input.position;
  const double left = 1.0 - offset.squaredNorm() / (radius_ * radius_);
  if (left <= 0.0) return Vector3::Zero();
  const double stiffness = stable_stiffness(input.device_mass, input.dt, stiffness_) * left * left;
  return stiffness * (offset - leak_seconds(input.dt) * input.velocity);
}

Recess::Recess(const RecessSettings& settings) : settings_(settings) {
  assert(settings.axis.squaredNorm() > 0.0);
  assert(settings.floor_radius >= 0.0 && settings.rim_radius > settings.floor_radius);
  settings_.axis.normalize();
}

double Recess::slope_stiffness() const {
  return settings_.peak_force * std::numbers::pi / (settings_.rim_radius - settings_.floor_radius);
}

Vector3 Recess::force(const EffectInput& input) {
  const Vector3 offset = settings_.centre - input.position;
  const Vector3 inwards = offset - offset.dot(settings_.axis) * settings_.axis;
  const double r = inwards.norm();
  if (settings_.peak_force <= 0.0 || r <= settings_.floor_radius || r >= settings_.rim_radius)
    return Vector3::Zero();
  const double across = (r - settings_.floor_radius) / (settings_.rim_radius - settings_.floor_radius);
  const double wave = std::sin(std::numbers::pi * across);
  const double stiffness = stable_stiffness(input.device_mass, input.dt, slope_stiffness());
  const double peak = settings_.peak_force * stiffness / slope_stiffness();
  const Vector3 across_axis = input.velocity - input.velocity.dot(settings_.axis) * settings_.axis;
  return inwards * (peak * wave * wave / r) - leak_seconds(input.dt) * stiffness * wave * across_axis;
}

}  // namespace icome::haptics
