#pragma once
#include <vector>

#include "sketch/fit/running_fit.h"
#include "sketch/fit/stroke_fit.h"

namespace icome::sketch {

/// A stroke while it is drawn, for the eye: segments that stay as they are, the one that is being drawn, and
/// where the pen will be. What is drawn in the end is fit_stroke() of the samples.
class RunningStroke {
 public:
  /// Preconditions: samples are finite, settings.error > 0.
  RunningStroke(const PenSample& first, const FitSettings& settings);

  void add(const PenSample& sample);

  const PenStroke& samples() const { return samples_; }
  /// The number of segments that will not change any more.
  std::size_t finished() const { return fit_.finished().size(); }
  /// One of them with its width. Takes as long as the segment has samples.
  Curve segment(std::size_t number) const { return with_width(fit_.finished()[number]); }
  /// The segment that ends at the last sample, likewise.
  Curve current() const { return with_width(fit_.current()); }

  /// The place of the pen in `ahead` s if it goes on as it did lately; where it is, if that cannot be told.
  Vector2 predicted(double ahead) const;

 private:
  Curve with_width(const RunningFit::Finished& part) const;
  double width_at(double along) const;

  FitSettings settings_;
  RunningFit fit_;
  PenStroke samples_;
  std::vector<double> along_;  // of each sample: the way to it, in units of the error
};

}  // namespace icome::sketch
