#pragma once
#include <optional>

#include "base/vector.h"

namespace icome::haptics {

using base::Vector3;

/// Keeps a force that follows no potential from giving energy: energy taken from the hand is stored, and no
/// more than that is given. An energy tank (Franken et al., 2011), whose store is found as by a passivity
/// observer (Hannaford and Ryu, 2002): a force is held over its tick, so that its work is known exactly in
/// the next. It starts empty, and holds kMost at most: a larger store, given at once after long taking,
/// would be felt as active (Ferraguti, Secchi and Fantuzzi, 2013). One thread calls it.
class EnergyTank {
 public:
  /// Twice the work of a hand that slides with 5 N over half a facet of 25 mm of a ball of 50 mm.
  static constexpr double kMost = 0.02;  // J

  /// The part of `force` (N) that may act over the coming tick: all of it where the tip, going on as in the
  /// last tick and as in the last few, gives it energy or the tank can pay, else less. (A slow tip, read by
  /// steps of an encoder, stands still in most ticks.) Real-time safe.
  Vector3 give(const Vector3& force);

  /// `share` of the given force acts in this tick (a limiter may have reduced it). Real-time safe.
  void acts(double share);

  /// Accounts for the tip's motion `way` (m) since the last call. If that took several ticks, because the
  /// device gave no new state in between, it counts as if the share that is worst for the tank had acted all
  /// the way. Real-time safe.
  void settle(const Vector3& way);

  /// Energy that it may still give, J; negative after a tip that sped up within a tick has got too much,
  /// which is paid back before anything is given again.
  double stored() const { return stored_; }

 private:
  double stored_ = 0.0;                     // J
  Vector3 acting_ = Vector3::Zero();        // N
  std::optional<double> least_share_ = {};  // of acting_ that acted since the last settle()
  double most_share_ = 0.0;
  Vector3 way_ = Vector3::Zero();    // m, of the last tick
  Vector3 drift_ = Vector3::Zero();  // m a tick, of the last few
};

}  // namespace icome::haptics
