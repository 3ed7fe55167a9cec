#pragma once
#include "interaction/head/head_filter.h"
#include "interaction/head/head_transfer.h"

namespace icome::interaction {

/// Makes the movement of the view of what a head tracker measures: steadied (in the thesis by the mean of the
/// last five samples) and perhaps predicted, from where the head was at rest, through the transfer function
/// (thesis 5.7.1).
class HeadMotion {
 public:
  explicit HeadMotion(const HeadTransfer& transfer = HeadTransfer::of_thesis(),
                      const HeadFilterSettings& filter = {})
      : transfer_(transfer), filter_(filter) {}

  /// Sets the pose of the head at rest. Without a call the first pose is taken for it.
  void set_rest(const base::Pose& tracker_from_rest);
  /// Takes a sample at `time`, s, which does not go back, and gives the movement of the view.
  base::Pose moved(const base::Pose& tracker_from_head, double time);
  /// The head as the filter has it, without the transfer function: for a view in which the eye is where the
  /// head is. Precondition: there is a sample.
  base::Pose steady_from_rest() const;
  /// The steadied head of now is at rest from now on; nothing where there is no sample.
  void recentre();
  /// Forgets the samples, not where the rest is: what comes next is not near what came last.
  void forget_samples() { filter_.forget(); }

  const HeadTransfer& transfer() const { return transfer_; }
  void set_transfer(const HeadTransfer& transfer) { transfer_ = transfer; }
  const HeadFilterSettings& filter() const { return filter_.settings(); }
  /// Another way of steadying; the samples so far are forgotten.
  void set_filter(const HeadFilterSettings& filter) { filter_ = HeadFilter(filter); }

 private:
  HeadTransfer transfer_;
  HeadFilter filter_;
  bool has_rest_ = false;
  base::Pose tracker_from_rest_ = base::Pose::Identity();
};

}  // namespace icome::interaction
