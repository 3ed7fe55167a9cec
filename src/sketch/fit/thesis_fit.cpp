#include "sketch/fit/thesis_fit.h"

#include <algorithm>
#include <cmath>

namespace icome::sketch {

void ThesisFit::Sums::add(double length, const Vector2& point) {
  double power = 1.0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    u[k] += power;
    if (k < up.size()) up[k] += power * point;
    power *= length;
  }
  pp += point.squaredNorm();
}

void ThesisFit::add(const Vector2& point) {
  if (!points_.empty() && point == points_.back()) return;  // two samples on one place have no length between
  along_.push_back(points_.empty() ? 0.0 : along_.back() + (point - points_.back()).norm());
  points_.push_back(point);
  const std::size_t last = points_.size() - 1;
  // The sums count from P_s, which keeps them small.
  Sums with = sums_;
  with.add(along_[last] - along_[start_], point - points_[start_]);
  const std::size_t end = last >= shared_ ? last - shared_ : 0;
  if (end <= start_ + 2) {
    sums_ = with;
    return;
  }
  const Sums before = sums_;
  sums_ = with;
  if (fit_to(end).mean_square <= error_ * error_) return;
  sums_ = before;
  const std::size_t joint = std::max(start_ + 1, end - 1);
  finished_.push_back({fit_to(joint).curve, along_[start_], along_[joint]});
  start_ = joint;
  first_ = joint >= shared_ ? joint - shared_ : 0;
  sums_ = {};
  for (std::size_t i = first_; i <= last; ++i)
    sums_.add(along_[i] - along_[start_], points_[i] - points_[start_]);
}

ThesisFit::Finished ThesisFit::current() const {
  const std::size_t last = points_.size() - 1;
  return {fit_to(last).curve, along_[start_], along_[last]};
}

ThesisFit::Fit ThesisFit::fit_to(std::size_t end) const {
  const double length = along_[end] - along_[start_];
  const Vector2 b4 = points_[end] - points_[start_];  // B1 is the origin here
  if (!(length > 0.0)) return {CubicBezier::line(points_[start_], points_[end]), 0.0};
  // Sums of t^k and of t^k P, from those of lengths.
  std::array<double, kPowers> t{};
  std::array<Vector2, 4> p = sums_.up;
  double scale = 1.0;
  for (std::size_t k = 0; k < t.size(); ++k, scale /= length) {
    t[k] = sums_.u[k] * scale;
    if (k < p.size()) p[k] *= scale;
  }
  // With b2 = 3 t - 6 t^2 + 3 t^3, b3 = 3 t^2 - 3 t^3 and b4 = t^3 the sums of their products (4.7).
  const double a22 = 9.0 * (t[2] - 4.0 * t[3] + 6.0 * t[4] - 4.0 * t[5] + t[6]);
  const double a23 = 9.0 * (t[3] - 3.0 * t[4] + 3.0 * t[5] - t[6]);
  const double a33 = 9.0 * (t[4] - 2.0 * t[5] + t[6]);
  const double a24 = 3.0 * (t[4] - 2.0 * t[5] + t[6]);
  const double a34 = 3.0 * (t[5] - t[6]);
  const Vector2 c2 = 3.0 * (p[1] - 2.0 * p[2] + p[3]) - a24 * b4;
  const Vector2 c3 = 3.0 * (p[2] - p[3]) - a34 * b4;
  const double determinant = a22 * a33 - a23 * a23;
  Vector2 b2 = b4 / 3.0;
  Vector2 b3 = 2.0 / 3.0 * b4;
  if (determinant > 1e-12 * a22 * a33) {  // else too few samples lie between the ends to tell
    b2 = (a33 * c2 - a23 * c3) / determinant;
    b3 = (a22 * c3 - a23 * c2) / determinant;
  }
  const double squares = sums_.pp + b2.squaredNorm() * a22 + b3.squaredNorm() * a33 +
                         b4.squaredNorm() * t[6] +
                         2.0 * (b2.dot(b3) * a23 + b2.dot(b4) * a24 + b3.dot(b4) * a34) -
                         2.0 * (b2.dot(c2 + a24 * b4) + b3.dot(c3 + a34 * b4) + b4.dot(p[3]));
  const Vector2& origin = points_[start_];
  return {{{origin, origin + b2, origin + b3, points_[end]}}, std::max(0.0, squares) / sums_.u[0]};
}

}  // namespace icome::sketch
