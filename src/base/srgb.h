#pragma once
#include <algorithm>
#include <array>
#include <cmath>

namespace icome::base {

/// Converts one channel of a colour from sRGB, as displays show it, to linear light intensity, and back
/// (IEC 61966-2-1). Intensities outside [0, 1], which no display shows, become the nearest that one does.
inline double linear_from_srgb(double channel) {
  return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}
inline double srgb_from_linear(double intensity) {
  const double clamped = std::clamp(intensity, 0.0, 1.0);
  return clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1.0 / 2.4) - 0.055;
}

/// Red, green, blue.
inline std::array<float, 3> linear_from_srgb(const std::array<float, 3>& colour) {
  const auto channel = [&](std::size_t i) { return float(linear_from_srgb(double(colour[i]))); };
  return {channel(0), channel(1), channel(2)};
}
inline std::array<float, 3> srgb_from_linear(const std::array<double, 3>& intensities) {
  const auto channel = [&](std::size_t i) { return float(srgb_from_linear(intensities[i])); };
  return {channel(0), channel(1), channel(2)};
}

}  // namespace icome::base
