#pragma once

namespace icome::sketch {

/// Gives the pressure that a pen draws with for the one that it is pressed with: a curve that never goes
/// back, through three points. A plain value; all numbers are from 0 to 1.
struct PressureCurve {
  double lightest = 0.0;  ///< for no pressure
  double middle = 0.5;    ///< for half of it; between the two others
  double hardest = 1.0;   ///< for all of it; not below `lightest`

  /// For a pressure, which is taken into 0 to 1.
  double operator()(double pressure) const;
};

}  // namespace icome::sketch
