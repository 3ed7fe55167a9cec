#pragma once
#include <optional>

#include "base/vector.h"

namespace icome::haptics {

using base::Vector3;

/// Keeps a force that follows no potential from giving energy: what it takes from the hand is stored, and
/// it gives no more than is there. An energy tank (Franken et al., 2011), whose store is found as by a
/// passivity observer (Hannaford and Ryu, 2002): a force is held over its tick, so that what it did is known
/// exactly in the next. It starts empty, and holds kMost at most: what it could give at once after it has
/// taken for long would be felt as active (Ferraguti, Secchi and Fantuzzi, 2013). One thread calls it.
class EnergyTank {
 public:
  /// Twice what a hand gives that slides with 5 N over half a facet of 25 mm of a ball of 50 mm.
  static constexpr double kMost = 0.02;  // J

  /// The part of `force` (N) that may act over the coming tick: all of it where the tip, going on as in the
  /// last tick and as in the last few, gives it energy or the tank can pay, else less. (A slow tip, read by
  /// steps of an encoder, stands still in most ticks.) Real-time safe.
  Vector3 give(const Vector3& force);

  /// `share` of what was given acts in this tick (a limiter may have made it less). Real-time safe.
  void acts(double share);

  /// The tip went `way` (m) since the last call. Where that took several ticks, as the device had nothing to
  /// say in between, it counts as if the part that is worst for the tank had acted all the way. Real-time
  /// safe.
  void settle(const Vector3& way);

  /// What it may still give, J; below zero by what a tip that sped up within a tick has got too much, which
  /// is paid back before anything is given again.
  double stored() const { return stored_; }

 private:
  double stored_ = 0.0;                     // J
  Vector3 acting_ = Vector3::Zero();        // N
  std::optional<double> least_share_ = {};  // of it, of the ticks since the last settle()
  double most_share_ = 0.0;
  Vector3 way_ = Vector3::Zero();    // m, of the last tick
  Vector3 drift_ = Vector3::Zero();  // m a tick, of the last few
};

}  // namespace icome::haptics
