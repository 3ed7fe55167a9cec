#pragma once
#include <array>
#include <cstddef>
#include <span>

#include "interaction/head/head_transfer.h"

namespace icome::interaction {

/// The rotation with the least sum of squared chordal distances to these, which need not be near each other.
/// Precondition: at least one; unit length.
base::Quaternion mean_rotation(std::span<const base::Quaternion> rotations);

/// Makes the movement of the view of what a head tracker measures: the mean of the last five samples, from
/// where the head was at rest, through the transfer function (thesis 5.7.1).
class HeadMotion {
 public:
  explicit HeadMotion(const HeadTransfer& transfer = HeadTransfer::of_thesis()) : transfer_(transfer) {}

  /// Sets the pose of the head at rest. Without a call the first pose is taken for it.
  void set_rest(const base::Pose& tracker_from_rest);
  /// Takes a sample, and gives the movement of the view.
  base::Pose moved(const base::Pose& tracker_from_head);
  /// The newest sample as it is. Precondition: there is one.
  base::Pose newest_from_rest() const;
  /// The mean of the samples of now is at rest from now on; nothing where there are none.
  void recentre();
  /// Forgets the samples, not where the rest is: what comes next is not near what came last.
  void forget_samples() { count_ = 0; }

  const HeadTransfer& transfer() const { return transfer_; }
  void set_transfer(const HeadTransfer& transfer) { transfer_ = transfer; }

 private:
  static constexpr std::size_t kSamples = 5;
  base::Pose mean() const;

  HeadTransfer transfer_;
  std::array<base::Vector3, kSamples> places_;  // a ring
  std::array<base::Quaternion, kSamples> turns_;
  std::size_t count_ = 0;  // taken so far
  bool has_rest_ = false;
  base::Pose tracker_from_rest_ = base::Pose::Identity();
};

}  // namespace icome::interaction
