#include "geometry/curve/cubic_bezier.h"

#include <algorithm>
#include <cmath>

namespace icome::geometry {
namespace {

/// The coefficients of the power form: at(t) = c[0] + c[1] t + c[2] t^2 + c[3] t^3.
std::array<Vector2, 4> power_form(const std::array<Vector2, 4>& p) {
  return {p[0], 3.0 * (p[1] - p[0]), 3.0 * (p[2] - 2.0 * p[1] + p[0]), p[3] - p[0] + 3.0 * (p[1] - p[2])};
}

/// The direction of the first of `others` that differs from `from`.
Vector2 first_way(const Vector2& from, const std::array<Vector2, 3>& others) {
  for (const Vector2& other : others) {
    const Vector2 way = other - from;
    const double length = way.stableNorm();
    if (length > 0.0) return way / length;
  }
  return Vector2::Zero();
}

// Gauss and Legendre, 8 places: nodes and weights for [-1, 1], half of them.
constexpr std::array<double, 4> kGaussNodes = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                               0.9602898564975363};
constexpr std::array<double, 4> kGaussWeights = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                                 0.1012285362903763};

double gauss_length(const CubicBezier& curve, double from, double to) {
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  double sum = 0.0;
  for (std::size_t i = 0; i < kGaussNodes.size(); ++i) {
    sum += kGaussWeights[i] * (curve.derivative(middle - half * kGaussNodes[i]).norm() +
                               curve.derivative(middle + half * kGaussNodes[i]).norm());
  }
  return half * sum;
}

constexpr int kLengthHalvings = 12;  // a cusp would be halved for ever

double length_between(const CubicBezier& curve, double from, double to, double whole, int depth) {
  const double middle = 0.5 * (from + to);
  const double left = gauss_length(curve, from, middle);
  const double right = gauss_length(curve, middle, to);
  if (depth == kLengthHalvings || std::abs(left + right - whole) <= 1e-10 * whole) return left + right;
  return length_between(curve, from, middle, left, depth + 1) +
         length_between(curve, middle, to, right, depth + 1);
}

}  // namespace

CubicBezier CubicBezier::line(const Vector2& from, const Vector2& to) {
  return {{from, from + (to - from) / 3.0, to + (from - to) / 3.0, to}};
}

Vector2 CubicBezier::at(double t) const {
  const double u = 1.0 - t;
  return u * u * u * points[0] + 3.0 * t * u * u * points[1] + 3.0 * t * t * u * points[2] +
         t * t * t * points[3];
}

Vector2 CubicBezier::derivative(double t) const {
  const double u = 1.0 - t;
  return 3.0 * (u * u * (points[1] - points[0]) + 2.0 * t * u * (points[2] - points[1]) +
                t * t * (points[3] - points[2]));
}

Vector2 CubicBezier::second_derivative(double t) const {
  return 6.0 * ((1.0 - t) * (points[2] - 2.0 * points[1] + points[0]) +
                t * (points[3] - 2.0 * points[2] + points[1]));
}

Vector2 CubicBezier::start_direction() const {
  return first_way(points[0], {points[1], points[2], points[3]});
}

Vector2 CubicBezier::end_direction() const {
  return -first_way(points[3], {points[2], points[1], points[0]});
}

std::pair<CubicBezier, CubicBezier> CubicBezier::split(double t) const {
  const auto mix = [t](const Vector2& a, const Vector2& b) -> Vector2 { return a + t * (b - a); };
  const Vector2 a = mix(points[0], points[1]);
  const Vector2 b = mix(points[1], points[2]);
  const Vector2 c = mix(points[2], points[3]);
  const Vector2 ab = mix(a, b);
  const Vector2 bc = mix(b, c);
  const Vector2 middle = mix(ab, bc);
  return {{{points[0], a, ab, middle}}, {{middle, bc, c, points[3]}}};
}

CubicBezier CubicBezier::part(double from, double to) const {
  if (from <= 0.0) return to >= 1.0 ? *this : split(to).first;
  const CubicBezier rest = split(from).second;
  return to >= 1.0 ? rest : rest.split((to - from) / (1.0 - from)).first;
}

CubicBezier CubicBezier::reversed() const { return {{points[3], points[2], points[1], points[0]}}; }

CubicBezier CubicBezier::transformed(const Eigen::Affine2d& to_other) const {
  return {{to_other * points[0], to_other * points[1], to_other * points[2], to_other * points[3]}};
}

Bounds2 CubicBezier::hull_bounds() const {
  Bounds2 box(points[0]);
  for (std::size_t i = 1; i < points.size(); ++i) box.extend(points[i]);
  return box;
}

Bounds2 CubicBezier::bounds() const {
  Bounds2 box(points[0]);
  box.extend(points[3]);
  const auto c = power_form(points);
  for (int axis = 0; axis < 2; ++axis) {
    // Where the derivative is zero: 3 c3 t^2 + 2 c2 t + c1, by the form that does not cancel.
    const double a = 3.0 * c[3][axis];
    const double half_b = c[2][axis];
    const double root = std::sqrt(std::max(0.0, half_b * half_b - a * c[1][axis]));
    const double q = -(half_b + std::copysign(root, half_b));
    for (const double t : {q / a, c[1][axis] / q})
      if (t > 0.0 && t < 1.0) box.extend(at(t));
  }
  return box;
}

double CubicBezier::length(double t) const {
  return length_between(*this, 0.0, t, gauss_length(*this, 0.0, t), 0);
}

}  // namespace icome::geometry
