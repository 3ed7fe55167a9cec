#include "haptics/contact_witness.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/triangle_tree.h"

namespace icome::haptics {
namespace {

using base::Bounds;
using base::Vector3;
using geometry::Corners;

/// Where a segment crosses a triangle, and from which side.
struct Crossing {
  double t;
  bool from_front;
  double margin;  // how clearly it passes through the triangle and not by its rim: least barycentric part
};

/// The triple product of u, v and w. Exchanging u and v changes exactly the sign: two triangles agree on
/// which side of their edge a segment passes, and none slips between them.
double side_of(const Vector3& u, const Vector3& v, const Vector3& w) {
  return (u.y() * v.z() - u.z() * v.y()) * w.x() + (u.z() * v.x() - u.x() * v.z()) * w.y() +
         (u.x() * v.y() - u.y() * v.x()) * w.z();
}

/// By the sides on which the segment passes the three edges; edges count as part of the triangle.
std::optional<Crossing> cross(const Corners& corners, const Vector3& start, const Vector3& step) {
  const Vector3 a = corners[0] - start;
  const Vector3 b = corners[1] - start;
  const Vector3 c = corners[2] - start;
  const double at_a = side_of(b, c, step);
  const double at_b = side_of(c, a, step);
  const double at_c = side_of(a, b, step);
  const auto [least, most] = std::minmax({at_a, at_b, at_c});
  const double sum = at_a + at_b + at_c;
  if ((least < 0.0 && most > 0.0) || sum == 0.0) return std::nullopt;
  const double t = (at_a * a + at_b * b + at_c * c).dot(step) / (sum * step.squaredNorm());
  if (!(t >= 0.0 && t <= 1.0)) return std::nullopt;
  return Crossing{t, sum < 0.0, std::min(std::abs(least), std::abs(most)) / std::abs(sum)};
}

class MeshWitness final : public Witness {
 public:
  explicit MeshWitness(const JudgedObject& object)
      : tree_(*std::get<0>(object.surface)), closed_(object.closed), two_sided_(object.two_sided) {}

  std::optional<Block> blocked(const Vector3& a, const Vector3& b) const override {
    double first = 2.0;
    std::uint32_t met = 0;
    const Vector3 step = b - a;
    tree_.near(a, b, 0.0, [&](std::uint32_t slot) {
      const std::optional<Crossing> crossing = cross(tree_.corners(slot), a, step);
      if (!crossing || !(two_sided_ || crossing->from_front) || crossing->t >= first) return true;
      first = crossing->t;
      met = slot;
      return true;
    });
    if (first > 1.0) return std::nullopt;
    const Corners& corners = tree_.corners(met);
    const Vector3 front = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    return Block{first, front.dot(step) < 0.0 ? front : Vector3(-front)};
  }

  double distance(const Vector3& point, double limit) const override {
    const auto hit = tree_.nearest(point, limit);
    return hit ? hit->parameter : limit;
  }

  double overlap(const Vector3& point, double radius) const override {
    if (closed_ || two_sided_) return radius - distance(point, radius);
    double deepest = 0.0;  // behind an open front-touched sheet the tip is free
    tree_.near(point, point, radius, [&](std::uint32_t slot) {
      const Corners& corners = tree_.corners(slot);
      const Vector3 nearest = geometry::nearest_point(corners, point);
      const Vector3 front = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
      if (front.dot(point - nearest) > 0.0) deepest = std::max(deepest, radius - (point - nearest).norm());
      return true;
    });
    return deepest;
  }

  bool inside(const Vector3& point) const override {
    return closed_ && !two_sided_ && tree_.bounds().contains(point) && winding(point) > 0;
  }

 private:
  /// How often the surface winds around the point: fronts passed on the way out count against backs, so
  /// that parts may overlap. A ray near an edge is ambiguous: another one is tried.
  int winding(const Vector3& point) const {
    constexpr std::array<std::array<double, 3>, 6> kDirections{{{0.532, 0.713, 0.457},
                                                                {-0.617, 0.281, 0.735},
                                                                {0.271, -0.829, 0.489},
                                                                {-0.443, -0.389, -0.808},
                                                                {0.903, -0.137, -0.407},
                                                                {-0.159, 0.921, -0.355}}};
    const double length = 2.0 * (tree_.bounds().sizes().norm() + (point - tree_.bounds().center()).norm());
    int count = 0;
    for (const auto& [x, y, z] : kDirections) {
      count = 0;
      bool clear = true;
      const Vector3 step = length * Vector3(x, y, z);
      tree_.near(point, point + step, 0.0, [&](std::uint32_t slot) {
        const std::optional<Crossing> crossing = cross(tree_.corners(slot), point, step);
        if (!crossing) return true;
        count += crossing->from_front ? -1 : 1;
        clear = clear && crossing->margin > 1e-9;
        return true;
      });
      if (clear) break;
    }
    return count;
  }

  geometry::TriangleTree tree_;
  bool closed_;
  bool two_sided_;
};

class PrimitiveWitness final : public Witness {
 public:
  explicit PrimitiveWitness(const JudgedObject& object)
      : primitive_(std::get<1>(object.surface)), two_sided_(object.two_sided) {
    const double size = bounds(object).sizes().norm();
    slack_ = kJudgeNoise * (std::isfinite(size) ? size : 1.0);
  }

  std::optional<Block> blocked(const Vector3& a, const Vector3& b) const override {
    const double at_a = geometry::signed_distance(primitive_, a);
    const double sign = two_sided_ && at_a < 0.0 ? -1.0 : 1.0;
    const std::optional<double> t = first_below(a, b, sign, two_sided_ || at_a >= -slack_);
    if (!t) return std::nullopt;
    return Block{*t, sign * geometry::scp_from_inside(primitive_, a + *t * (b - a)).normal};
  }

  double distance(const Vector3& point, double limit) const override {
    return std::min(limit, std::abs(geometry::signed_distance(primitive_, point)));
  }

  double overlap(const Vector3& point, double radius) const override {
    const double signed_distance = geometry::signed_distance(primitive_, point);
    return std::max(0.0, radius - (two_sided_ ? std::abs(signed_distance) : signed_distance));
  }

  bool inside(const Vector3& point) const override {
    return !two_sided_ && geometry::signed_distance(primitive_, point) < 0.0;
  }

 private:
  /// The first t in [0, 1] at which `sign` times the signed distance falls below -slack. A distance
  /// changes no faster than its point moves, which clears whole stretches at once. When it starts
  /// below (`out` is false), from where the way has come out.
  std::optional<double> first_below(const Vector3& a, const Vector3& b, double sign, bool out) const {
    const double length = (b - a).norm();
    if (length <= 0.0) return std::nullopt;
    for (double t = 0.0;;) {
      const double here = sign * geometry::signed_distance(primitive_, a + t * (b - a));
      out = out || here >= 0.0;
      if (out && here < -slack_) return t;
      if (t >= 1.0) return std::nullopt;
      t = std::min(1.0, t + std::max(std::abs(here), slack_) / length);
    }
  }

  geometry::Primitive primitive_;
  bool two_sided_;
  double slack_ = 0.0;  // m
};

}  // namespace

Bounds bounds(const JudgedObject& object) {
  if (const auto* primitive = std::get_if<geometry::Primitive>(&object.surface))
    return geometry::bounds(*primitive);
  if (const auto* solid = std::get_if<MembershipSolid>(&object.surface)) return solid->bounds;
  Bounds all;
  for (const Vector3& position : std::get<0>(object.surface)->positions) all.extend(position);
  return all;
}

std::unique_ptr<Witness> make_witness(const JudgedObject& object, const Resolution& resolution) {
  if (const auto* solid = std::get_if<MembershipSolid>(&object.surface)) {
    return make_membership_witness(*solid, resolution);
  }
  if (std::holds_alternative<geometry::Primitive>(object.surface)) {
    return std::make_unique<PrimitiveWitness>(object);
  }
  return std::make_unique<MeshWitness>(object);
}

}  // namespace icome::haptics
