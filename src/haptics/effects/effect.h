#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "base/vector.h"

namespace icome::haptics {

using base::Vector3;

/// What an effect may look at in one tick; world frame.
struct EffectInput {
  double time = 0.0;                   // s since the servo started
  double dt = 0.001;                   // s, this tick's length
  Vector3 position = Vector3::Zero();  // m, of the tip
  Vector3 velocity = Vector3::Zero();  // m/s, of the tip
  Vector3 scp = Vector3::Zero();       // m, surface contact point; the tip when nothing is touched
  bool touching = false;
  double device_mass = 0.1;  // kg, apparent at the tip (DeviceInfo::effective_mass)
};

/// A force on the tip that comes from no surface. Derive to add one, as with GHOST (thesis 4.3.1).
/// The servo calls it; what it needs is given at construction.
class Effect {
 public:
  virtual ~Effect() = default;
  /// The force (N) of this tick; called once a tick, in order. Real-time safe.
  virtual Vector3 force(const EffectInput& input) = 0;
  /// Forgets what it has felt so far: the tip jumped, or the effect was off. Real-time safe.
  virtual void reset() {}
  /// What a device of `device_mass` (kg) with a tick of `dt` (s) cannot render stably as it was asked for:
  /// "stiffness 5000 N/m is felt as 1000 N/m". Empty where all is given.
  virtual std::string capped(double /*device_mass*/, double /*dt*/) const { return {}; }
};

/// The sum of effects, which it owns. It is an effect itself, so sets nest.
class EffectSet final : public Effect {
 public:
  /// Adds an effect and returns its index, 0 for the first. Takes memory: before the servo starts.
  std::size_t add(std::unique_ptr<Effect> effect);

  std::size_t size() const { return members_.size(); }
  /// Switches effect `index` < size(); one that is switched on starts afresh. New effects are on.
  /// Real-time safe.
  void set_enabled(std::size_t index, bool enabled);
  bool enabled(std::size_t index) const { return members_[index].enabled; }

  Vector3 force(const EffectInput& input) override;
  void reset() override;
  /// Of its members, those that are on, one after the other.
  std::string capped(double device_mass, double dt) const override;

 private:
  struct Member {
    std::unique_ptr<Effect> effect;  // never null
    bool enabled = true;
  };
  std::vector<Member> members_;
};

}  // namespace icome::haptics
