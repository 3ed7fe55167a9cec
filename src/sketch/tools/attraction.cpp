#include "sketch/tools/attraction.h"

#include <cmath>

namespace icome::sketch {

double attracted(double value, double step, double within) {
  const double multiple = step * std::round(value / step);
  const double off = value - multiple;
  if (std::abs(off) >= within) return value;
  return multiple + std::copysign(std::fmax(0.0, 2.0 * std::abs(off) - within), off);
}

}  // namespace icome::sketch
