#pragma once

namespace icome::cutout {

/// The pixel in whose square a coordinate lies, above -0.5. A call of std::lround would cost more than what
/// is done with it.
inline int nearest_pixel(double place) {
  const double from_border = place + 0.5;  // pixels are squares about their centres
  return int(from_border);
}

}  // namespace icome::cutout
