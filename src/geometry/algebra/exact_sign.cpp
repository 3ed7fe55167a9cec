#include "geometry/algebra/exact_sign.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace icome::geometry {
namespace {

using base::Vector3;
using Eigen::Vector2d;

constexpr double kUnit = 0.5 * std::numeric_limits<double>::epsilon();
constexpr double kTurnError = (3.0 + 16.0 * kUnit) * kUnit;  // of the products' sizes: Shewchuk's bounds
constexpr double kVolumeError = (7.0 + 56.0 * kUnit) * kUnit;

int sign_of(double value) { return (value > 0.0) - (value < 0.0); }

/// A sum without rounding: parts that do not overlap, the largest last (Shewchuk's expansions).
class ExactSum {
 public:
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  void add_product(double a, double b, double c) {
    const double product = a * b;
    add_product(std::fma(a, b, -product), c);
    add_product(product, c);
  }
  int sign() const { return count_ == 0 ? 0 : sign_of(parts_[count_ - 1]); }

 private:
  void add(double part) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const double sum = part + parts_[i];
      const double other = sum - part;
      const double rest = (part - (sum - other)) + (parts_[i] - other);
      if (rest != 0.0) parts_[kept++] = rest;
      part = sum;
    }
    if (part != 0.0) parts_[kept++] = part;
    count_ = kept;
  }

  std::array<double, 96> parts_{};  // 24 products of three, four parts each
  std::size_t count_ = 0;
};

void add_cross(ExactSum& sum, const Vector2d& u, const Vector2d& v) {
  sum.add_product(u.x(), v.y());
  sum.add_product(-u.y(), v.x());
}

void add_volume(ExactSum& sum, double sign, const Vector3& u, const Vector3& v, const Vector3& w) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    sum.add_product(sign * u[i], v[j], w[k]);
    sum.add_product(-sign * u[i], v[k], w[j]);
  }
}

}  // namespace

int turn_sign(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const double left = (a.x() - c.x()) * (b.y() - c.y());
  const double right = (a.y() - c.y()) * (b.x() - c.x());
  if (std::abs(left - right) > kTurnError * (std::abs(left) + std::abs(right))) return sign_of(left - right);
  ExactSum sum;
  add_cross(sum, a, b);
  add_cross(sum, b, c);
  add_cross(sum, c, a);
  return sum.sign();
}

int side_sign(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const Vector3 u = a - d, v = b - d, w = c - d;
  const Vector3 cross = u.cross(v);
  const Vector3 sizes(std::abs(u.y() * v.z()) + std::abs(u.z() * v.y()),
                      std::abs(u.z() * v.x()) + std::abs(u.x() * v.z()),
                      std::abs(u.x() * v.y()) + std::abs(u.y() * v.x()));
  // The volume is below zero when a, b and c run counter-clockwise as seen from d.
  const double volume = cross.dot(w);
  if (std::abs(volume) > kVolumeError * sizes.dot(w.cwiseAbs())) return -sign_of(volume);
  ExactSum sum;
  add_volume(sum, 1.0, b, c, d);
  add_volume(sum, -1.0, a, c, d);
  add_volume(sum, 1.0, a, b, d);
  add_volume(sum, -1.0, a, b, c);
  return sum.sign();
}

}  // namespace icome::geometry
