#include "files/single.h"

#include <array>
#include <charconv>
#include <cmath>

namespace icome::files {

double from_single(float value) {
  // Whole numbers are very common, and exact as they are.
  constexpr float kWhole = 1 << 24;
  if (!std::isfinite(value) || (std::fabs(value) < kWhole && std::trunc(value) == value)) return value;
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  double result = value;
  std::from_chars(text.data(), end, result);
  return result;
}

}  // namespace icome::files
