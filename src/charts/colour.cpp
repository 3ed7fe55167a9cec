#include "charts/colour.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/srgb.h"
#include "base/vector.h"

namespace icome::charts {
namespace {

using base::Matrix3;
using base::Vector3;

/// Linear sRGB to the cone responses of Oklab, and their cube roots to Oklab itself (Ottosson 2020).
Matrix3 cones_from_linear() {
  Matrix3 m;
  m << 0.4122214708, 0.5363325363, 0.0514459929,  //
      0.2119034982, 0.6806995451, 0.1073969566,   //
      0.0883024619, 0.2817188376, 0.6299787005;
  return m;
}

Matrix3 oklab_from_roots() {
  Matrix3 m;
  m << 0.2104542553, 0.7936177850, -0.0040720468,  //
      1.9779984951, -2.4285922050, 0.4505937099,   //
      0.0259040371, 0.7827717662, -0.8086757660;
  return m;
}

Vector3 linear_from_oklab(const Vector3& lab) {
  const Vector3 roots = oklab_from_roots().inverse() * lab;
  return cones_from_linear().inverse() * roots.array().cube().matrix();
}

bool in_gamut(const Vector3& linear) { return linear.minCoeff() >= 0.0 && linear.maxCoeff() <= 1.0; }

/// The colour of that lightness, hue (radians) and chroma, or with the most chroma that the screen shows.
Vector3 linear_of(double light, double chroma, double hue) {
  const auto at = [&](double c) { return linear_from_oklab({light, c * std::cos(hue), c * std::sin(hue)}); };
  double low = 0.0;
  double high = chroma;
  if (in_gamut(at(high))) return at(high);
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (low + high);
    (in_gamut(at(middle)) ? low : high) = middle;
  }
  return at(low);
}

}  // namespace

double lightness(const Colour& colour) {
  const Vector3 linear(base::linear_from_srgb(colour.red), base::linear_from_srgb(colour.green),
                       base::linear_from_srgb(colour.blue));
  const Vector3 cones = cones_from_linear() * linear;
  return (oklab_from_roots() * cones.unaryExpr([](double v) { return std::cbrt(v); })).x();
}

Colour magnitude_colour(double fraction) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const double t = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0.0;
  const double light = std::lerp(0.32, 0.86, t);
  const double hue = std::lerp(285.0, 360.0 + 95.0, t) * kDegree;
  const Vector3 linear = linear_of(light, 0.20, hue);
  return {base::srgb_from_linear(linear.x()), base::srgb_from_linear(linear.y()),
          base::srgb_from_linear(linear.z())};
}

}  // namespace icome::charts
