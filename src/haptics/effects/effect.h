#pragma once
#include <string>

#include "haptics/effects/reach.h"

namespace icome::haptics {

/// The input of an effect in one tick; world frame, or the effect's own frame where it has one.
struct EffectInput {
  double time = 0.0;                   // s since the servo started
  double dt = 0.001;                   // s, this tick's length
  Vector3 position = Vector3::Zero();  // m, of the tip
  Vector3 velocity = Vector3::Zero();  // m/s, of the tip, relative to the effect's frame (rides())
  Vector3 scp = Vector3::Zero();       // m, surface contact point; the tip when nothing is touched
  bool touching = false;
  double device_mass =
      0.1;  // kg, apparent at the tip (DeviceInfo::effective_mass), or the effect's part of it
};

/// A force on the tip that comes from no surface. Derive to add one, as with GHOST (thesis 4.3.1).
/// The servo calls it; all its settings are given at construction.
class Effect {
 public:
  virtual ~Effect() = default;
  /// The force (N) of this tick; called once a tick, in order. Real-time safe.
  virtual Vector3 force(const EffectInput& input) = 0;
  /// Would a tick with the tip at that place (m, its own frame) give no force, and change nothing of what it
  /// remembers? Only then may it be passed over. Real-time safe.
  virtual bool is_idle_at(const Vector3& /*place*/) const { return false; }
  /// Forgets its history, because the tip jumped or the effect was off. Real-time safe.
  virtual void reset() {}
  /// Takes over the memory of another effect of the same kind, whose numbers have been changed while it
  /// was felt. Called before this one is felt; the other is not felt any more then.
  virtual void continue_from(const Effect& /*before*/) {}
  /// Does it belong to the thing that carries its frame, so that it pulls along, holds back and sticks to
  /// what moves with that? Otherwise the tip's own motion counts, as for a thing in the hand. Real-time safe.
  virtual bool rides() const { return true; }
  /// Changes the frame of its input from now on: remembered places and directions are transformed so that
  /// they stay where they were in the world. Real-time safe.
  virtual void reframe(const base::Pose& /*new_from_old*/) {}
  /// The least mass (kg, at most `device_mass`) on which this is stable with its requested settings and a
  /// tick of `dt` (s): its part of a device on which other forces act, too (mass_shares.h). 0: always stable.
  virtual double mass_needed(double /*device_mass*/, double /*dt*/) const { return 0.0; }
  /// Region in which it acts; its centre with an infinite radius if it acts everywhere.
  virtual Reach reach() const { return {}; }
  /// Names the settings that a device of `device_mass` (kg) with a tick of `dt` (s) cannot render stably
  /// in full: "stiffness 5000 N/m is felt as 1000 N/m". Empty where all are rendered as requested.
  virtual std::string capped(double /*device_mass*/, double /*dt*/) const { return {}; }
};

}  // namespace icome::haptics
