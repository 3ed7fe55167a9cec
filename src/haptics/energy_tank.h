#pragma once
#include "base/vector.h"

namespace icome::haptics {

using base::Vector3;

/// Keeps a force that follows no potential from giving energy: what it takes from the hand is stored, and
/// it gives no more than is there. An energy tank (Franken et al., 2011), whose store is found as by a
/// passivity observer (Hannaford and Ryu, 2002): a force is held over its tick, so that what it did is known
/// exactly in the next. It starts empty. One thread calls it.
class EnergyTank {
 public:
  /// The part of `force` (N) that may act over the coming tick: all of it where the tip, going on as in the
  /// last tick and as in the last few, gives it energy or the tank can pay, else less. (A slow tip, read by
  /// steps of an encoder, stands still in most ticks.) Real-time safe.
  Vector3 give(const Vector3& force);

  /// A tick is over in which the tip went `way` (m) and `share` of what was given has acted (a limiter may
  /// have made it less). Real-time safe.
  void settle(const Vector3& way, double share);

  /// What it may still give, J; below zero by what a tip that sped up within a tick has got too much, which
  /// is paid back before anything is given again.
  double stored() const { return stored_; }

 private:
  double stored_ = 0.0;               // J
  Vector3 acting_ = Vector3::Zero();  // N
  Vector3 way_ = Vector3::Zero();     // m, of the last tick
  Vector3 drift_ = Vector3::Zero();   // m a tick, of the last few
};

}  // namespace icome::haptics
