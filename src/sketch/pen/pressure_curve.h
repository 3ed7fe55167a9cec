#pragma once

namespace icome::sketch {

/// How hard a pen draws for how hard it is pressed: a curve that never goes back, through three points. A
/// plain value; all numbers are from 0 to 1.
struct PressureCurve {
  double lightest = 0.0;  ///< for no pressure
  double middle = 0.5;    ///< for half of it; between the two others
  double hardest = 1.0;   ///< for all of it; not below `lightest`

  /// For a pressure, which is taken into 0 to 1.
  double operator()(double pressure) const;
};

}  // namespace icome::sketch
