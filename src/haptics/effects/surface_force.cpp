#include "haptics/effects/surface_force.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace icome::haptics {
namespace {

constexpr double kLargestRelativeStiffness = 0.1;  // K dt^2/m
constexpr double kDampingShare = 0.25;             // of the upper end of the range, used at most

}  // namespace

DampingRange stable_damping_range(double stiffness, double effective_mass, double dt) {
  assert(stiffness >= 0.0 && effective_mass > 0.0 && dt > 0.0);
  const double k = stiffness * dt * dt / effective_mass;
  const double middle = 1.0 - 0.25 * k;
  const double discriminant = middle * middle - k;
  if (middle <= 0.0 || discriminant <= 0.0) return {};
  const double most = middle + std::sqrt(discriminant);
  const double unit = effective_mass / dt;
  return {k / most * unit, most * unit};
}

double stable_stiffness(double effective_mass, double dt, double requested) {
  assert(effective_mass > 0.0 && dt > 0.0);
  // The upper end of the range is at most 2 m/dt.
  const double payable = 2.0 * kDampingShare * effective_mass / (dt * leak_seconds(dt));
  return std::min({requested, kLargestRelativeStiffness * effective_mass / (dt * dt), payable});
}

double leak_seconds(double dt) { return std::max(kLeakTicks * dt, kLimiterLag); }

double stable_damping(double stiffness, double effective_mass, double dt, double requested) {
  const DampingRange range = stable_damping_range(stiffness, effective_mass, dt);
  const double wanted = requested < 0.0 ? std::sqrt(stiffness * effective_mass) : requested;
  const double paid = std::max(wanted, leak_seconds(dt) * stiffness);
  return std::min(paid, kDampingShare * range.most);
}

std::string capped_spring(double effective_mass, double dt, double stiffness, double damping) {
  const double felt = stable_stiffness(effective_mass, dt, stiffness);
  const double damped = stable_damping(felt, effective_mass, dt, damping);
  std::string text;
  if (felt < stiffness) text = fmt::format("stiffness {:g} N/m is felt as {:g} N/m", stiffness, felt);
  if (damped >= damping) return text;
  return text + fmt::format("{}damping {:g} N s/m{} as {:g} N s/m", text.empty() ? "" : ", ", damping,
                            text.empty() ? " is felt" : "", damped);
}

double mass_needed(double stiffness, double damping, double effective_mass, double dt) {
  const double felt = stable_stiffness(effective_mass, dt, stiffness);
  const double damped = stable_damping(felt, effective_mass, dt, damping);
  const double most = stable_damping_range(felt, effective_mass, dt).most * kDampingShare;  // >= damped
  return std::max(felt * dt * dt / kLargestRelativeStiffness, effective_mass * (damped / most));
}

void make_stable(Surface& surface, double nominal_stiffness, double effective_mass, double dt) {
  const double wanted = surface.stiffness > 0.0 ? surface.stiffness : nominal_stiffness;
  surface.stiffness = stable_stiffness(effective_mass, dt, wanted);
  surface.damping = stable_damping(surface.stiffness, effective_mass, dt, surface.damping);
}

Vector3 spring_damper_force(const Contact& contact, const Surface& surface) {
  const Vector3 spring = surface.stiffness * (contact.scp - contact.tip);
  const double pressed = spring.dot(contact.normal);
  const double leaving = (contact.tip_velocity - contact.scp_velocity).dot(contact.normal);
  const double whole_at = surface.stiffness * surface.damping_depth;
  const double damping = surface.damping * (pressed < whole_at ? pressed / whole_at : 1.0);
  // Pressed <= 0: the tip has come out, nothing to damp. Otherwise a damper may take the whole push away
  // from a tip that leaves fast, but not turn it into a pull.
  const double pushed = pressed > 0.0 ? std::max(0.0, pressed - damping * leaving) : 0.0;
  return spring + (pushed - pressed) * contact.normal;
}

Vector3 VelocityFilter::filter(const Vector3& velocity, double dt) {
  const double share = started_ ? 1.0 - std::exp(-2.0 * std::numbers::pi * corner_hz_ * dt) : 1.0;
  started_ = true;
  filtered_ += share * (velocity - filtered_);
  return filtered_;
}

}  // namespace icome::haptics
