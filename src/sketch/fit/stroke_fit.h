#pragma once
#include <cstdint>

#include "base/result.h"
#include "sketch/drawn.h"
#include "sketch/fit/pen_sample.h"

namespace icome::sketch {

/// The way in which curves are fitted to strokes.
enum class FitMethod : std::uint8_t {
  Exact,   ///< as near as the bound says, certified, with few segments and corners
  Thesis,  ///< thesis 4.2 to 4.7: t by length, samples shared by neighbours, the mean square within the bound
};

/// The line that a pen leaves by its pressure.
struct PenTip {
  double thinnest = 0.0002;  ///< m, without pressure; 0 to 0.01
  double widest = 0.001;     ///< m, at full pressure; 0 to 0.1

  double width(double pressure) const { return thinnest + pressure * (widest - thinnest); }
};

struct FitSettings {
  FitMethod method = FitMethod::Exact;
  double error = 0.0001;         ///< m, how far the curve may be from the samples; 1e-5 to 1e-2
  double width_error = 0.00005;  ///< m, how far the width may be from that of a sample
  unsigned shared = 3;  ///< samples that neighbours share on either side of a joint (Thesis); 0 to 50
  bool refit = true;    ///< fewer segments when the pen is lifted (Exact)
  PenTip tip;
};

struct FittedStroke {
  Curve curve;
  double error = 0.0;  ///< m, the greatest distance of curve and samples, both ways, is not above this
  std::size_t samples = 0;
  std::size_t corners = 0;  ///< places where the curve breaks
};

/// Fails, the end of a sentence, where a stroke is so long beside the error that a fit would take minutes.
base::Result<void> check_fit(const PenStroke& stroke, double error);

/// The curve of a stroke (thesis 4.5.2). One sample gives a dot: a segment that is a point.
/// Preconditions: one sample or more, finite; error > 0.
FittedStroke fit_stroke(const PenStroke& stroke, const FitSettings& settings);

}  // namespace icome::sketch
