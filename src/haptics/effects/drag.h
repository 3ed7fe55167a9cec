#pragma once
#include <memory>

#include "haptics/effects/effect.h"
#include "haptics/effects/surface_force.h"

namespace icome::haptics {

/// Syrup: a force against the velocity. The constant is kept within what is stable for the device and
/// the tick (thesis 5.3.2: too large a damping constant is unstable).
class ViscousDamping final : public Effect {
 public:
  /// `damping` >= 0 in N s/m, usually 0.5 to 10.
  explicit ViscousDamping(double damping) : damping_(damping) {}
  Vector3 force(const EffectInput& input) override;
  double mass_needed(double device_mass, double dt) const override {
    return haptics::mass_needed(0.0, damping_, device_mass, dt);
  }
  std::string capped(double device_mass, double dt) const override {
    return capped_spring(device_mass, dt, 0.0, damping_);
  }

 private:
  double damping_;  // N s/m
};

/// Dry friction in free space, as on a table: the tip sticks until the force reaches `static_force`, then
/// slides against `dynamic_force`. An anchor on a short stiff spring follows the tip (Hayward and
/// Armstrong, 2000), so there is no chatter at rest and no drift. This is an effect; the friction of
/// surfaces comes with the surface contact point.
struct FrictionSettings {
  double static_force = 0.5;   // N, >= dynamic_force
  double dynamic_force = 0.4;  // N, >= 0
  double stiffness = 1000.0;   // N/m, of sticking; the tip yields static_force/stiffness before it slides
};

class FrictionEffect final : public Effect {
 public:
  explicit FrictionEffect(const FrictionSettings& settings);
  Vector3 force(const EffectInput& input) override;
  void reset() override { memory_->anchored = false; }
  void continue_from(const Effect& before) override;
  void reframe(const base::Pose& new_from_old) override { memory_->anchor = new_from_old * memory_->anchor; }
  double mass_needed(double device_mass, double dt) const override {
    return haptics::mass_needed(settings_.stiffness, kAutomaticDamping, device_mass, dt);
  }
  std::string capped(double device_mass, double dt) const override {
    return capped_spring(device_mass, dt, settings_.stiffness, kAutomaticDamping);
  }

 private:
  struct Memory {
    bool anchored = false;
    bool sliding = false;
    Vector3 anchor = Vector3::Zero();  // m
  };
  FrictionSettings settings_;
  std::shared_ptr<Memory> memory_ = std::make_shared<Memory>();  // shared by effects that continue each other
};

/// The tip feels heavier: a force against its acceleration, as of `mass` kg held in the hand (without
/// weight). Acceleration is the low-passed difference of velocities. As the force acts one tick after the
/// acceleration that it answers, the loop is
///   y[n] = (1 - a) y[n-1] - a (M/m) y[n-1],
/// stable for a (1 + M/m) < 2; the low-pass share a is kept at or below 1/(1 + M/m), where it does not
/// even ring. A heavier mass is thus felt a little later.
class Inertia final : public Effect {
 public:
  /// `mass` >= 0 in kg, usually 0.05 to 1; `corner_hz` of the low-pass, usually 20 to 100.
  explicit Inertia(double mass, double corner_hz = 50.0) : mass_(mass), corner_hz_(corner_hz) {}
  Vector3 force(const EffectInput& input) override;
  void reset() override { memory_->started = false; }
  void continue_from(const Effect& before) override;
  bool rides() const override { return false; }
  void reframe(const base::Pose& new_from_old) override;
  double mass_needed(double device_mass, double dt) const override;

 private:
  double low_pass(double dt) const;  // the share of the newest acceleration

  double mass_;       // kg
  double corner_hz_;  // Hz
  struct Memory {
    bool started = false;
    Vector3 last_velocity = Vector3::Zero();  // m/s
    Vector3 acceleration = Vector3::Zero();   // m/s^2, low-passed
  };
  std::shared_ptr<Memory> memory_ = std::make_shared<Memory>();  // shared by effects that continue each other
};

}  // namespace icome::haptics
