#include "geometry/primitive/primitive_crossing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/algebra/polynomial.h"

namespace icome::geometry {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

/// The part of a line that lies in a convex solid; empty when last < first.
struct InnerPart {
  double first = -kEndless, last = kEndless;

  bool empty() const { return !(first <= last); }
};

constexpr InnerPart kNoPart{kEndless, -kEndless};

InnerPart shared_part(const InnerPart& a, const InnerPart& b) {
  return {std::max(a.first, b.first), std::min(a.last, b.last)};
}

/// The union of two parts of one convex solid, which together are one part.
InnerPart joined(const InnerPart& a, const InnerPart& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.first, b.first), std::max(a.last, b.last)};
}

/// The part on which the value start + t * step is in [low, high].
InnerPart within_slab(double start, double step, double low, double high) {
  if (step == 0.0) return start >= low && start <= high ? InnerPart{} : kNoPart;
  const double s = (low - start) / step, t = (high - start) / step;
  return {std::min(s, t), std::max(s, t)};
}

/// The part on which a t^2 + 2 b t + c <= 0, within a part in which that is one piece.
InnerPart below_zero(double a, double b, double c, const InnerPart& part) {
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0) return a < 0.0 ? part : kNoPart;
  // This form avoids the cancellation of the usual formula.
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  if (q == 0.0 && a == 0.0) return c <= 0.0 ? part : kNoPart;
  const double one = a == 0.0 ? std::copysign(kEndless, -q * c) : q / a;
  const double other = q == 0.0 ? 0.0 : c / q;
  const double low = std::min(one, other), high = std::max(one, other);
  if (a > 0.0) return shared_part(part, {low, high});
  if (a == 0.0) return shared_part(part, b > 0.0 ? InnerPart{-kEndless, other} : InnerPart{other, kEndless});
  const InnerPart before = shared_part(part, {-kEndless, low}), after = shared_part(part, {high, kEndless});
  // The other one is the far nappe of a cone, or the tip's rounding.
  return before.last - before.first > after.last - after.first ? before : after;
}

/// A line through the frame of a primitive, with t = 0 at its place nearest to the origin, so that starts far
/// away cost no digits.
class Line {
 public:
  Line(const Vector3& start, const Vector3& step)
      : nearest_(-start.dot(step) / step.squaredNorm()), start_(start + nearest_ * step), step_(step) {}

  double nearest() const { return nearest_; }  // in the caller's t
  const Vector3& start() const { return start_; }
  const Vector3& step() const { return step_; }

  InnerPart operator()(const Plane&) const { return within_slab(start_.z(), step_.z(), -kEndless, 0.0); }
  InnerPart operator()(const Box& box) const {
    InnerPart part;
    for (int axis = 0; axis < 3; ++axis)
      part = shared_part(part, within_slab(start_[axis], step_[axis], -box.half[axis], box.half[axis]));
    return part;
  }
  InnerPart operator()(const Sphere& sphere) const { return ball(sphere.radius, 0.0); }
  InnerPart operator()(const Cylinder& cylinder) const { return rod(cylinder.radius, cylinder.height); }
  InnerPart operator()(const Cone& cone) const {
    const double middle = 0.5 * (cone.bottom_radius + cone.top_radius);
    const double slope = (cone.top_radius - cone.bottom_radius) / cone.height;
    const double r0 = middle + slope * start_.z(), r1 = slope * step_.z();
    return below_zero(flat(step_, step_) - r1 * r1, flat(start_, step_) - r0 * r1,
                      flat(start_, start_) - r0 * r0, ends(cone.height));
  }
  InnerPart operator()(const Capsule& capsule) const {
    const double end = 0.5 * capsule.height;
    return joined(joined(ball(capsule.radius, end), ball(capsule.radius, -end)),
                  rod(capsule.radius, capsule.height));
  }
  InnerPart operator()(const Torus&) const { return kNoPart; }  // is not convex: see ring_crossing

  InnerPart ball(double radius, double z) const {
    const Vector3 from = start_ - z * Vector3::UnitZ();
    return below_zero(step_.squaredNorm(), from.dot(step_), from.squaredNorm() - radius * radius, {});
  }

 private:
  static double flat(const Vector3& a, const Vector3& b) { return a.head<2>().dot(b.head<2>()); }
  InnerPart ends(double height) const {
    return within_slab(start_.z(), step_.z(), -0.5 * height, 0.5 * height);
  }
  InnerPart rod(double radius, double height) const {
    return below_zero(flat(step_, step_), flat(start_, step_), flat(start_, start_) - radius * radius,
                      ends(height));
  }

  double nearest_;
  Vector3 start_, step_;
};

std::optional<double> ring_crossing(const Torus& torus, const Vector3& start, const Vector3& step) {
  const double outer = torus.major_radius + torus.minor_radius;
  const Line line(start, step);
  const InnerPart around = line.ball(1.01 * outer, 0.0);  // no root lies on an end
  const double first = std::max(0.0, around.first + line.nearest());
  const double last = std::min(1.0, around.last + line.nearest());
  if (!(first <= last)) return std::nullopt;
  // (|p|^2 + a^2 - b^2)^2 = 4 a^2 (x^2 + y^2), in a ring that reaches to 1.
  const double a = torus.major_radius / outer, b = torus.minor_radius / outer;
  const Vector3 from = (start + first * step) / outer, way = (last - first) * step / outer;
  const double s0 = from.squaredNorm() + (a - b) * (a + b), s1 = 2.0 * from.dot(way), s2 = way.squaredNorm();
  const double four = 4.0 * a * a;
  const auto flat = [](const Vector3& u, const Vector3& v) { return u.head<2>().dot(v.head<2>()); };
  const std::array<double, 5> c{s0 * s0 - four * flat(from, from),
                                2.0 * s0 * s1 - 2.0 * four * flat(from, way),
                                s1 * s1 + 2.0 * s0 * s2 - four * flat(way, way), 2.0 * s1 * s2, s2 * s2};
  const RealRoots roots = real_roots(c, 0.0, 1.0);
  if (roots.count == 0) return std::nullopt;
  return first + (last - first) * roots.t[0];
}

}  // namespace

std::optional<double> first_crossing(const Primitive& primitive, const Vector3& start, const Vector3& step) {
  if (!start.allFinite() || !step.allFinite() || !(step.squaredNorm() > 0.0)) return std::nullopt;
  if (const auto* torus = std::get_if<Torus>(&primitive)) return ring_crossing(*torus, start, step);
  const Line line(start, step);
  const InnerPart inner = std::visit(line, primitive);
  if (inner.empty()) return std::nullopt;
  for (const double t : {inner.first + line.nearest(), inner.last + line.nearest()}) {
    if (t >= 0.0 && t <= 1.0) return t;
  }
  return std::nullopt;
}

}  // namespace icome::geometry
