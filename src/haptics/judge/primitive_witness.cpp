#include <algorithm>
#include <cmath>

#include "haptics/judge/contact_witness.h"
#include "haptics/judge/plain_solid.h"

namespace icome::haptics {
namespace {

using base::Vector3;

/// Measures by the primitive's distance, which changes no faster than its point moves.
class PrimitiveWitness final : public Witness {
 public:
  PrimitiveWitness(const JudgedObject& object, const Resolution& resolution)
      : primitive_(std::get<1>(object.surface)), two_sided_(object.two_sided), slack_(resolution.noise) {}

  std::optional<Block> blocked(const Vector3& a, const Vector3& b) const override {
    const double at_a = height(a);
    const double sign = two_sided_ && at_a < 0.0 ? -1.0 : 1.0;
    const std::optional<double> t = first_below(a, b, sign, two_sided_ || at_a >= -slack_);
    if (!t) return std::nullopt;
    return Block{*t, sign * uphill(a + *t * (b - a))};
  }

  double distance(const Vector3& point, double limit) const override {
    return std::min(limit, std::abs(height(point)));
  }

  double overlap(const Vector3& point, double radius) const override {
    return std::max(0.0, radius - (two_sided_ ? std::abs(height(point)) : height(point)));
  }

  bool solid() const override { return !two_sided_; }
  bool inside(const Vector3& point) const override { return solid() && height(point) < 0.0; }

 private:
  double height(const Vector3& point) const { return plain_distance(primitive_, point); }

  /// The direction in which the distance grows, by differences.
  Vector3 uphill(const Vector3& point) const {
    Vector3 slope;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 step = slack_ * Vector3::Unit(axis);
      slope[axis] = height(point + step) - height(point - step);
    }
    return slope.normalized();
  }

  /// The first t in [0, 1] at which `sign` times the distance falls below -slack. When it starts below (`out`
  /// is false), from where the way has come out.
  std::optional<double> first_below(const Vector3& a, const Vector3& b, double sign, bool out) const {
    const double length = (b - a).norm();
    if (length <= 0.0) return std::nullopt;
    for (double t = 0.0;;) {
      const double here = sign * height(a + t * (b - a));
      out = out || here >= 0.0;
      if (out && here < -slack_) return t;
      if (t >= 1.0) return std::nullopt;
      t = std::min(1.0, t + std::max(std::abs(here), slack_) / length);
    }
  }

  geometry::Primitive primitive_;
  bool two_sided_;
  double slack_;  // m
};

}  // namespace

std::unique_ptr<Witness> make_primitive_witness(const JudgedObject& object, const Resolution& resolution) {
  return std::make_unique<PrimitiveWitness>(object, resolution);
}

}  // namespace icome::haptics
