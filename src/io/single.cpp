#include "io/single.h"

#include <array>
#include <charconv>
#include <cmath>

#include "base/parse_number.h"

namespace icome::io {

double from_single(float value) {
  // Whole numbers are very common, and exact as they are.
  constexpr float kWhole = 1 << 24;
  if (!std::isfinite(value) || (std::fabs(value) < kWhole && std::trunc(value) == value)) return value;
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return base::number_at_front<double>({text.data(), end}).value;
}

double from_short_single(float value) {
  // As many decimal places as leave at most one such number that rounds to a given float.
  struct Magnitude {
    float below;
    double places;
  };
  constexpr std::array<Magnitude, 4> kMagnitudes{
      {{16.0F, 1e6}, {128.0F, 1e5}, {1024.0F, 1e4}, {16384.0F, 1e3}}};
  for (const auto& [below, places] : kMagnitudes) {
    if (!(std::fabs(value) < below)) continue;
    const double candidate = std::round(double(value) * places) / places;
    return float(candidate) == value ? candidate : double(value);
  }
  return value;
}

}  // namespace icome::io
