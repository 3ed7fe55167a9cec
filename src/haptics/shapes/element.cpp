#include "haptics/shapes/element.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "haptics/shapes/smooth_element.h"

namespace icome::haptics {
namespace {

using Kind = Element::Kind;

constexpr double kCloseBy = 0.995;  // cosine between normals (0.1 rad): the chord is as good as the arc
// As kCloseBy, round a shell, where not even the chord's dip may meet the other side: 1e-5 rad.
constexpr double kVeryCloseBy = 1.0 - 5e-11;
constexpr double kArcStep = 0.1;  // rad, on pieces whose tangent plane is not free
constexpr double kDeepest = 4.0;  // dips, that a tip may be in the edge of a mesh when it comes round another
constexpr int kMaxTraceSteps = 100;
constexpr int kBisections = 48;

/// Some unit vector at right angles to `axis`.
Vector3 perpendicular(const Vector3& axis) { return axis.unitOrthogonal(); }

/// The part of `offset` at right angles to the unit `axis`.
Vector3 radial(const Vector3& offset, const Vector3& axis) { return offset - axis * axis.dot(offset); }

/// The point of the element's skeleton (axis, centre, circle) that its round surface surrounds.
Vector3 skeleton_point(const Element& e, const Vector3& position) {
  switch (e.kind) {
    case Kind::Rod:
      return e.origin + e.axis * e.axis.dot(position - e.origin);
    case Kind::Capsule:
      return e.origin + e.axis * std::clamp(e.axis.dot(position - e.origin), 0.0, e.a);
    case Kind::Ring: {
      const Vector3 out = radial(position - e.origin, e.axis);
      const double length = out.norm();
      return e.origin + e.a * (length > 0.0 ? Vector3(out / length) : perpendicular(e.axis));
    }
    default:
      return e.origin;
  }
}

/// A normal for the places where the skeleton itself is touched and distance gives no direction.
Vector3 skeleton_normal(const Element& e) {
  if (e.guarded && !e.w.isZero(0.0)) return e.w;
  return e.kind == Kind::Ring ? e.axis : perpendicular(e.axis);
}

/// A position in the half-plane through it and the axis of a cone, where the cone is a line.
struct ConePlace {
  Vector3 out;         // unit, away from the axis
  double radial;       // m from the axis
  double axial;        // m from the origin along the axis
  double radial_part;  // of the outward normal
};

ConePlace cone_place(const Element& e, const Vector3& position) {
  const Vector3 offset = position - e.origin;
  const Vector3 out = radial(offset, e.axis);
  const double length = out.norm();
  return {length > 0.0 ? Vector3(out / length) : perpendicular(e.axis), length, e.axis.dot(offset),
          std::sqrt(1.0 - e.c * e.c)};
}

double outward_height(const Element& e, const Vector3& position) {
  if (e.flat()) return e.axis.dot(position - e.origin) - e.radius;
  if (e.kind == Kind::ConeSide) {
    const ConePlace place = cone_place(e, position);
    return (place.radial - e.a) * place.radial_part + place.axial * e.c - e.radius;
  }
  return (position - skeleton_point(e, position)).norm() - e.radius;
}

Vector3 outward_normal(const Element& e, const Vector3& position) {
  if (e.flat()) return e.axis;
  if (e.kind == Kind::ConeSide) {
    const ConePlace place = cone_place(e, position);
    return place.out * place.radial_part + e.axis * e.c;
  }
  const Vector3 offset = position - skeleton_point(e, position);
  const double length = offset.norm();
  return length > 0.0 ? Vector3(offset / length) : skeleton_normal(e);
}

/// Rods and balls of a mesh hold the tip only in their own region of space: away from the face that hands
/// them out and, where the mesh is an open sheet touched from its front, in front of that.
bool guard_allows(const Element& e, const Vector3& away, const Tolerance& tolerance) {
  if (!e.guarded) return true;
  if (away.dot(e.u) > tolerance.rim() || away.dot(e.v) > tolerance.rim()) return false;
  return e.two_sided || away.dot(e.w) >= -tolerance.rim();
}

bool covers_cone(const Element& e, const Vector3& position, double rim) {
  const ConePlace place = cone_place(e, position);
  // Along the slant: the normal's parts, turned a quarter.
  const double along = (e.a - place.radial) * e.c + place.axial * place.radial_part;
  return along >= -rim && along <= e.b + rim;
}

/// Does a two-sided flat piece, as it is given, face away from `position`?
bool faces_away(const Element& e, const Vector3& position) {
  return e.two_sided && e.flat() && e.axis.dot(position - e.origin) < 0.0;
}

/// The first t in [0, 1] at which the distance to an axis-free quadric centre falls to `reach`:
/// |offset + t step| = reach, entering (or, from within, leaving).
std::optional<double> quadric_crossing(const Vector3& offset, const Vector3& step, double reach,
                                       bool leaving) {
  const double a = step.squaredNorm();
  const double b = offset.dot(step);
  const double c = offset.squaredNorm() - reach * reach;
  if (!leaving && b >= 0.0 && c > 0.0) return std::nullopt;  // from outside, further away
  const double discriminant = b * b - a * c;
  if (a <= 0.0 || discriminant < 0.0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  // The form without cancellation of each root. A path that heads for the surface and starts on it, up
  // to rounding, meets it at once.
  double t = leaving ? (root - b) / a : (-b - root) / a;
  if (leaving && b > 0.0) t = std::max(0.0, -c / (b + root));
  if (!leaving && b < 0.0) t = std::max(0.0, c / (root - b));
  return t >= 0.0 && t <= 1.0 ? std::optional(t) : std::nullopt;
}

/// Bound on how sharply the height bends towards the surface along a path near `position`: the radius
/// (m) of the tightest concave curve of the piece there; infinite where the piece is convex.
double concave_radius(const Element& e, const Vector3& position) {
  double radius = std::numeric_limits<double>::infinity();
  if (e.kind == Kind::Ring) radius = radial(position - e.origin, e.axis).norm();  // the hole
  if (!e.inverted) return radius;
  const double around = e.kind == Kind::ConeSide ? cone_place(e, position).radial
                                                 : (position - skeleton_point(e, position)).norm();
  return std::min(radius, around);
}

/// The first t at which the height falls to the gap. Each step goes as far as a bound on the height
/// allows: it falls no faster than its slope and the piece's curvature say, so no root is passed. On
/// convex pieces this is Newton's method from outside.
std::optional<double> traced_crossing(const Element& e, const Vector3& start, const Vector3& step,
                                      double gap) {
  const double length = step.norm();
  double t = 0.0;
  for (int i = 0; i < kMaxTraceSteps && t <= 1.0; ++i) {
    const Vector3 position = start + t * step;
    const double slope = normal(e, position).dot(step);
    const double clear = height(e, position) - 0.5 * gap;
    if (clear <= 0.5 * gap && slope < 0.0) return t;
    const double concave = concave_radius(e, position);
    if (!std::isfinite(concave)) {
      if (slope >= 0.0) return std::nullopt;
      t -= clear / slope;
      continue;
    }
    // Half the radius leaves room for the curvature to change on the way.
    const double bend = 2.0 * length * length / std::max(concave, gap);
    const double ahead = std::max(0.0, clear);
    const double bounded = (slope + std::sqrt(slope * slope + 2.0 * bend * ahead)) / bend;
    t += std::max(
        {std::min(bounded, 0.5 * concave / length), ahead / length, slope >= 0.0 ? gap / length : 0.0});
  }
  return t <= 1.0 ? std::optional(t) : std::nullopt;  // out of steps: to stop short is safe
}

std::optional<double> curved_crossing(const Element& e, const Vector3& start, const Vector3& step,
                                      double gap) {
  const Vector3 offset = start - e.origin;
  switch (e.kind) {
    case Kind::Ball:
      return quadric_crossing(offset, step, e.inverted ? e.radius - gap : e.radius + gap, e.inverted);
    case Kind::Rod:
      return quadric_crossing(radial(offset, e.axis), radial(step, e.axis),
                              e.inverted ? e.radius - gap : e.radius + gap, e.inverted);
    default:
      return traced_crossing(e, start, step, gap);
  }
}

/// Does a sphere tip at `position`, just over the piece, overlap it with its centre on the free side?
bool comes_over(const Element& e, const Vector3& position, const Tolerance& tolerance) {
  const double h = height(e, position);
  return h < tolerance.gap && h + e.tip >= -tolerance.behind() && covers(e, position, tolerance);
}

/// The t at which the path, outside a flat piece at its start, comes over it.
std::optional<double> first_hit(const Element& e, const Vector3& start, const Vector3& step,
                                const Tolerance& tolerance) {
  const Vector3 offset = start - e.origin;
  if (e.kind == Kind::Disc) {
    const auto t = quadric_crossing(radial(offset, e.axis), radial(step, e.axis), e.a, false);
    return t && comes_over(e, start + *t * step, tolerance) ? t : std::nullopt;
  }
  double t = 0.0;
  const auto cross = [&](const Vector3& inward, double edge) {
    const double outside = edge - inward.dot(offset);
    if (outside > 0.0) t = std::max(t, inward.dot(step) > 0.0 ? outside / inward.dot(step) : 2.0);
  };
  if (e.kind == Kind::Triangle) {
    cross(e.u, e.a);
    cross(e.v, e.b);
    cross(e.w, e.c);
  } else if (e.kind == Kind::Parallelogram) {
    cross(e.u, -e.a);
    cross(-e.u, -e.a);
    cross(e.v, -e.b);
    cross(-e.v, -e.b);
  }
  return t <= 1.0 && comes_over(e, start + t * step, tolerance) ? std::optional(t) : std::nullopt;
}

std::optional<double> sweep_flat(const Element& e, const Vector3& start, const Vector3& step,
                                 const Tolerance& tolerance) {
  const double h0 = e.axis.dot(start - e.origin) - e.radius;
  const double fall = e.axis.dot(step);
  const double h1 = h0 + fall;
  if (h1 >= 0.5 * tolerance.gap || h0 + e.tip < -tolerance.behind()) return std::nullopt;
  // A sphere tip comes round a convex edge, below the face's plane until it is over the face.
  if (e.tip > 0.0 && h0 < 0.5 * tolerance.gap && !covers(e, start, tolerance))
    return first_hit(e, start, step, tolerance);
  if (fall >= 0.0) return std::nullopt;
  const double rest = std::clamp((tolerance.gap - h0) / fall, 0.0, 1.0);
  if (covers(e, start + rest * step, tolerance)) return rest;
  // Just past an edge the resting plane has a crack that the piece itself does not have.
  if (h1 >= 0.0) return std::nullopt;
  const double through = std::clamp(-h0 / fall, 0.0, 1.0);
  return covers(e, start + through * step, tolerance) ? std::optional(rest) : std::nullopt;
}

/// The t at which the path comes over a curved piece that lies under its end, not its start; by bisection.
std::optional<double> curved_hit(const Element& e, const Vector3& start, const Vector3& step,
                                 const Tolerance& tolerance) {
  const Vector3 end = start + step;
  if (height(e, end) >= 0.5 * tolerance.gap || covers(e, start, tolerance) || !covers(e, end, tolerance)) {
    return std::nullopt;
  }
  double outside = 0.0;
  double inside = 1.0;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (outside + inside);
    (covers(e, start + middle * step, tolerance) ? inside : outside) = middle;
  }
  return comes_over(e, start + inside * step, tolerance) ? std::optional(inside) : std::nullopt;
}

/// Half-spaces that bound the region over a piece; finds when a path comes into all of them.
class Confines {
 public:
  explicit Confines(double rim) : rim_(rim) {}

  /// Adds the half-space in which a coordinate is not below zero, give or take the rim: the coordinate
  /// is `begin` at the start of the path, and changes by `change` over all of it.
  void add(double begin, double change) {
    if (begin >= -rim_) return;
    begins_within_ = false;
    if (begin + change < -rim_)
      missed_ = true;
    else
      begin_ = std::max(begin_, std::min(1.0, -begin / change));
  }

  bool begins_within() const { return begins_within_; }
  bool missed() const { return missed_; }
  double begin() const { return begin_; }

 private:
  double rim_;
  bool begins_within_ = true;
  bool missed_ = false;
  double begin_ = 0.0;
};

/// Sweep for the rods and balls of meshes, of which a sweep asks many and meets few: their half-spaces and a
/// squared distance rule most of them out.
std::optional<double> sweep_guarded(const Element& e, const Vector3& start, const Vector3& step,
                                    const Tolerance& tolerance) {
  const Vector3 offset = start - e.origin;
  Confines confines(tolerance.rim());
  Vector3 away = offset;
  Vector3 across = step;
  if (e.kind == Kind::Rod) {
    const double along = e.axis.dot(offset);
    const double advance = e.axis.dot(step);
    confines.add(along, advance);
    confines.add(e.a - along, -advance);
    away -= along * e.axis;
    across -= advance * e.axis;
  }
  confines.add(-e.u.dot(away), -e.u.dot(across));
  confines.add(-e.v.dot(away), -e.v.dot(across));
  if (!e.two_sided) confines.add(e.w.dot(away), e.w.dot(across));
  if (confines.missed()) return std::nullopt;
  const double reach = e.radius + tolerance.gap;
  const double approach = away.dot(across);
  const double outside = away.squaredNorm() - reach * reach;
  if (outside > 0.0 && (approach >= 0.0 || approach * approach < across.squaredNorm() * outside))
    return std::nullopt;
  std::optional<double> t = 0.0;
  if (outside > 0.0 || approach >= 0.0) t = quadric_crossing(away, across, reach, false);
  if (t && covers(e, start + *t * step, tolerance)) return t;
  const Vector3 end = start + step;
  if (confines.begins_within() || height(e, end) >= 0.5 * tolerance.gap || !covers(e, end, tolerance))
    return std::nullopt;
  // Beside its half-spaces the neighbouring pieces hold the tip out. One that is deep in the piece when it
  // comes into them came from behind those, in a part of the mesh that is turned inside out.
  t = confines.begin();
  const Vector3 place = start + *t * step;
  const bool from_behind = height(e, place) < -kDeepest * edge_dip(e.tip);
  return !from_behind && comes_over(e, place, tolerance) ? t : std::nullopt;
}

}  // namespace

double height(const Element& element, const Vector3& position) {
  if (element.smooth()) return smooth_footing(element, position).height;
  const double outward = outward_height(element, position);
  return element.inverted ? -outward : outward;
}

Vector3 normal(const Element& element, const Vector3& position) {
  if (element.smooth()) return smooth_footing(element, position).normal;
  const Vector3 outward = outward_normal(element, position);
  return element.inverted ? Vector3(-outward) : outward;
}

Footing footing(const Element& element, const Vector3& position) {
  if (element.smooth()) return smooth_footing(element, position);
  return {height(element, position), normal(element, position)};
}

bool covers(const Element& e, const Vector3& position, const Tolerance& tolerance) {
  const double rim = tolerance.rim();
  const Vector3 offset = position - e.origin;
  switch (e.kind) {
    case Kind::Plane:
    case Kind::Capsule:
    case Kind::Ring:
      return true;
    case Kind::Triangle:
      return e.u.dot(offset) >= e.a - rim && e.v.dot(offset) >= e.b - rim && e.w.dot(offset) >= e.c - rim;
    case Kind::Parallelogram:
      return std::abs(e.u.dot(offset)) <= e.a + rim && std::abs(e.v.dot(offset)) <= e.b + rim;
    case Kind::Disc:
      return radial(offset, e.axis).norm() <= e.a + rim;
    case Kind::Rod: {
      const double along = e.axis.dot(offset);
      return along >= -rim && along <= e.a + rim && guard_allows(e, offset - along * e.axis, tolerance);
    }
    case Kind::Ball:
      return guard_allows(e, offset, tolerance);
    case Kind::ConeSide:
      return covers_cone(e, position, rim);
    case Kind::Smooth:
      return smooth_covers(e, position, tolerance);
  }
  return false;
}

Rim nearest_rim(const Element& e, const Vector3& position) {
  const Vector3 offset = position - e.origin;
  Rim nearest;
  const auto edge = [&](const Vector3& inward, double least) {
    const double inside = inward.dot(offset) - least;
    if (inside < nearest.inside) nearest = {inside, -inward};
  };
  if (e.kind == Kind::Triangle) {
    edge(e.u, e.a);
    edge(e.v, e.b);
    edge(e.w, e.c);
  } else if (e.kind == Kind::Parallelogram) {
    edge(e.u, -e.a);
    edge(-e.u, -e.a);
    edge(e.v, -e.b);
    edge(-e.v, -e.b);
  } else if (e.kind == Kind::Disc) {
    const Vector3 out = radial(offset, e.axis);
    if (!out.isZero(0.0)) edge(-out.normalized(), -e.a);
  }
  return nearest;
}

Vector3 settle(const Element& element, const Vector3& position, const Tolerance& tolerance) {
  if (element.smooth()) return smooth_settle(element, position, tolerance);
  return position + normal(element, position) * (tolerance.gap - height(element, position));
}

Vector3 slide(const Element& element, const Vector3& from, const Vector3& goal, const Tolerance& tolerance) {
  const Vector3 nearest = settle(element, goal, tolerance);
  if (element.flat() || element.smooth()) return nearest;
  const Vector3 here = normal(element, from);
  const double cosine = normal(element, nearest).dot(here);
  if (cosine >= (element.two_sided && element.convex() ? kVeryCloseBy : kCloseBy)) return nearest;
  // Goes above the nearest point, which is reached from there by falling.
  if (element.convex() && cosine > 0.0) return from + radial(nearest - from, here);
  const Vector3 pull = radial(goal - from, here);
  const double length = pull.norm();
  if (length <= 0.0) return from;
  if (!element.convex()) {
    return settle(element, from + pull * std::min(1.0, kArcStep * element.radius / length), tolerance);
  }
  // Goes towards the other side of a round solid: a quarter of the way round.
  return from + pull * (element.radius / length);
}

Element facing(const Element& element, const Vector3& position) {
  Element result = element;
  if (faces_away(element, position)) result.axis = -element.axis;
  return result;
}

std::optional<double> sweep(const Element& e, const Vector3& start, const Vector3& step,
                            const Tolerance& tolerance) {
  if (faces_away(e, start)) return sweep_flat(facing(e, start), start, step, tolerance);
  if (e.flat()) return sweep_flat(e, start, step, tolerance);
  if (e.guarded) return sweep_guarded(e, start, step, tolerance);
  const double h0 = height(e, start);
  // The two sides of a curved shell are two pieces, a gap to either side of it.
  const double behind = e.two_sided ? tolerance.rim() : tolerance.behind();
  if (h0 + e.tip < -behind || h0 > step.norm() + tolerance.gap) return std::nullopt;
  std::optional<double> t = 0.0;
  if (h0 > tolerance.gap || normal(e, start).dot(step) >= 0.0)
    t = curved_crossing(e, start, step, tolerance.gap);
  if (t && covers(e, start + *t * step, tolerance)) return t;
  return e.tip > 0.0 ? curved_hit(e, start, step, tolerance) : std::nullopt;
}

bool same_surface(const Element& one, const Element& other) {
  if (one.kind != other.kind || one.object != other.object) return false;
  if (one.flat()) return one.feature == other.feature;
  if (one.smooth()) return one.surface->same(one.feature, other.feature);
  // The two sides of a curved shell are one surface: a tip that rests on one side does not meet the other.
  if (one.origin != other.origin || (one.inverted == other.inverted && one.radius != other.radius))
    return false;
  return one.kind == Kind::Ball || (one.axis == other.axis && one.a == other.a);
}

Element transformed(const Pose& to_from, const Element& element) {
  Element result = element;
  result.origin = to_from * element.origin;
  result.axis = to_from.linear() * element.axis;
  result.u = to_from.linear() * element.u;
  result.v = to_from.linear() * element.v;
  result.w = to_from.linear() * element.w;
  return result;
}

}  // namespace icome::haptics
