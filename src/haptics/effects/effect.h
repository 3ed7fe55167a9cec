#pragma once
#include <string>

#include "haptics/effects/reach.h"

namespace icome::haptics {

/// What an effect may look at in one tick; world frame.
struct EffectInput {
  double time = 0.0;                   // s since the servo started
  double dt = 0.001;                   // s, this tick's length
  Vector3 position = Vector3::Zero();  // m, of the tip
  Vector3 velocity = Vector3::Zero();  // m/s, of the tip; past the effect's frame where that moves (rides())
  Vector3 scp = Vector3::Zero();       // m, surface contact point; the tip when nothing is touched
  bool touching = false;
  double device_mass =
      0.1;  // kg, apparent at the tip (DeviceInfo::effective_mass), or the effect's part of it
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
  /// Goes on with what another effect remembers, if it is of the same kind: its numbers have been changed
  /// while it was felt. Before this one is felt; the other is not felt any more then.
  virtual void continue_from(const Effect& /*before*/) {}
  /// Does it belong to the thing that carries its frame, so that it pulls along, holds back and sticks to
  /// what moves with that? Else the tip's own way is what counts, as for what the hand holds. Real-time safe.
  virtual bool rides() const { return true; }
  /// The frame of its input is another one from now on: what it remembers of places and ways is to be where
  /// it was in the world. Real-time safe.
  virtual void reframe(const base::Pose& /*new_from_old*/) {}
  /// The least mass (kg, at most `device_mass`) on which this is stable as it was asked for with a tick of
  /// `dt` (s): what it takes of a device that others act on, too (mass_shares.h). 0: it is always stable.
  virtual double mass_needed(double /*device_mass*/, double /*dt*/) const { return 0.0; }
  /// Where it acts; of what acts everywhere, where it is centred.
  virtual Reach reach() const { return {}; }
  /// What a device of `device_mass` (kg) with a tick of `dt` (s) cannot render stably as it was asked for:
  /// "stiffness 5000 N/m is felt as 1000 N/m". Empty where all is given.
  virtual std::string capped(double /*device_mass*/, double /*dt*/) const { return {}; }
};

}  // namespace icome::haptics
