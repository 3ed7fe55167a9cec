#include "haptics/element.h"

#include <algorithm>
#include <cmath>

namespace icome::haptics {
namespace {

using Kind = Element::Kind;

constexpr double kCloseBy = 0.995;     // cosine between normals (0.1 rad): the chord is as good as the arc
constexpr double kArcStep = 0.1;       // rad, on pieces whose tangent plane is not free
constexpr int kMaxTraceSteps = 64;

/// Some unit vector at right angles to `axis`.
Vector3 perpendicular(const Vector3& axis) { return axis.unitOrthogonal(); }

/// The part of `offset` at right angles to the unit `axis`.
Vector3 radial(const Vector3& offset, const Vector3& axis) { return offset - axis * axis.dot(offset); }

/// The point of the element's skeleton (axis, centre, circle) that its round surface surrounds.
Vector3 skeleton_point(const Element& e, const Vector3& position) {
  switch (e.kind) {
    case Kind::Rod: return e.origin + e.axis * e.axis.dot(position - e.origin);
    case Kind::Capsule: return e.origin + e.axis * std::clamp(e.axis.dot(position - e.origin), 0.0, e.a);
    case Kind::Ring: {
      const Vector3 out = radial(position - e.origin, e.axis);
      const double length = out.norm();
      return e.origin + e.a * (length > 0.0 ? Vector3(out / length) : perpendicular(e.axis));
    }
    default: return e.origin;
  }
}

/// A normal for the places where the skeleton itself is touched and distance gives no direction.
Vector3 skeleton_normal(const Element& e) {
  if (e.guarded) return e.w;
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

/// Rods and balls of a mesh hold the tip only in their own region of space: away from the faces that
/// meet there and, unless the mesh is two-sided, in front of it.
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

/// The first t in [0, 1] at which the distance to an axis-free quadric centre falls to `reach`:
/// |offset + t step| = reach, entering (or, from within, leaving).
std::optional<double> quadric_crossing(const Vector3& offset, const Vector3& step, double reach, bool leaving) {
  const double a = step.squaredNorm();
  const double b = offset.dot(step);
  const double c = offset.squaredNorm() - reach * reach;
  const double discriminant = b * b - a * c;
  if (a <= 0.0 || discriminant < 0.0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  // The form without cancellation of each root.
  const double t = leaving ? (b > 0.0 ? -c / (b + root) : (root - b) / a)
                           : (b < 0.0 ? c / (root - b) : (-b - root) / a);
  return t >= 0.0 && t <= 1.0 ? std::optional(t) : std::nullopt;
}

/// Steps along by the height itself, which never passes a root since heights change no faster than
/// the tip moves. Stops where the height falls to the gap.
std::optional<double> traced_crossing(const Element& e, const Vector3& start, const Vector3& step, double gap) {
  const double length = step.norm();
  const double skim = 0.1 * kArcStep * (e.kind == Kind::ConeSide ? e.b : e.radius) / length;
  double t = 0.0;
  for (int i = 0; i < kMaxTraceSteps && t <= 1.0; ++i) {
    const Vector3 position = start + t * step;
    const double clear = height(e, position);
    if (clear <= gap) {
      if (normal(e, position).dot(step) < 0.0) return t;
      t += skim;  // off a surface that it is leaving
    } else {
      t += (clear - 0.5 * gap) / length;
    }
  }
  return std::nullopt;
}

std::optional<double> curved_crossing(const Element& e, const Vector3& start, const Vector3& step, double gap) {
  const Vector3 offset = start - e.origin;
  switch (e.kind) {
    case Kind::Ball:
      return quadric_crossing(offset, step, e.inverted ? e.radius - gap : e.radius + gap, e.inverted);
    case Kind::Rod:
      return quadric_crossing(radial(offset, e.axis), radial(step, e.axis),
                              e.inverted ? e.radius - gap : e.radius + gap, e.inverted);
    default: return traced_crossing(e, start, step, gap);
  }
}

std::optional<double> sweep_flat(const Element& e, const Vector3& start, const Vector3& step, double h0,
                                 const Tolerance& tolerance) {
  const double fall = e.axis.dot(step);
  const double h1 = h0 + fall;
  if (fall >= 0.0 || h1 >= 0.5 * tolerance.gap) return std::nullopt;
  const double rest = std::clamp((tolerance.gap - h0) / fall, 0.0, 1.0);
  if (covers(e, start + rest * step, tolerance)) return rest;
  // Just past an edge the resting plane has a crack that the piece itself does not have.
  if (h1 >= 0.0) return std::nullopt;
  const double through = std::clamp(-h0 / fall, 0.0, 1.0);
  return covers(e, start + through * step, tolerance) ? std::optional(rest) : std::nullopt;
}

}  // namespace

double height(const Element& element, const Vector3& position) {
  const double outward = outward_height(element, position);
  return element.inverted ? -outward : outward;
}

Vector3 normal(const Element& element, const Vector3& position) {
  const Vector3 outward = outward_normal(element, position);
  return element.inverted ? Vector3(-outward) : outward;
}

bool covers(const Element& e, const Vector3& position, const Tolerance& tolerance) {
  const double rim = tolerance.rim();
  const Vector3 offset = position - e.origin;
  switch (e.kind) {
    case Kind::Plane:
    case Kind::Capsule:
    case Kind::Ring: return true;
    case Kind::Triangle:
      return e.u.dot(offset) >= e.a - rim && e.v.dot(offset) >= e.b - rim && e.w.dot(offset) >= e.c - rim;
    case Kind::Parallelogram:
      return std::abs(e.u.dot(offset)) <= e.a + rim && std::abs(e.v.dot(offset)) <= e.b + rim;
    case Kind::Disc: return radial(offset, e.axis).norm() <= e.a + rim;
    case Kind::Rod: {
      const double along = e.axis.dot(offset);
      return along >= -rim && along <= e.a + rim && guard_allows(e, offset - along * e.axis, tolerance);
    }
    case Kind::Ball: return guard_allows(e, offset, tolerance);
    case Kind::ConeSide: return covers_cone(e, position, rim);
  }
  return false;
}

Vector3 settle(const Element& element, const Vector3& position, const Tolerance& tolerance) {
  return position + normal(element, position) * (tolerance.gap - height(element, position));
}

Vector3 slide(const Element& element, const Vector3& from, const Vector3& goal, const Tolerance& tolerance) {
  const Vector3 nearest = settle(element, goal, tolerance);
  if (element.flat()) return nearest;
  const Vector3 here = normal(element, from);
  if (normal(element, nearest).dot(here) >= kCloseBy) return nearest;
  const Vector3 pull = goal - from;
  const Vector3 tangential = pull - here * here.dot(pull);
  if (element.convex()) return from + tangential;
  const double length = tangential.norm();
  const double limit = kArcStep * element.radius;
  return settle(element, from + (length > limit ? Vector3(tangential * (limit / length)) : tangential), tolerance);
}

Element facing(const Element& element, const Vector3& position) {
  if (!element.two_sided || !element.flat() || element.axis.dot(position - element.origin) >= 0.0) return element;
  Element turned = element;
  turned.axis = -element.axis;
  return turned;
}

std::optional<double> sweep(const Element& e, const Vector3& start, const Vector3& step,
                            const Tolerance& tolerance) {
  const double h0 = height(e, start);
  if (h0 + e.tip < -tolerance.behind()) return std::nullopt;
  if (e.flat()) return sweep_flat(e, start, step, h0, tolerance);
  if (h0 > step.norm() + tolerance.gap) return std::nullopt;
  if (h0 <= tolerance.gap && normal(e, start).dot(step) < 0.0) {
    return covers(e, start, tolerance) ? std::optional(0.0) : std::nullopt;
  }
  const std::optional<double> t = curved_crossing(e, start, step, tolerance.gap);
  return t && covers(e, start + *t * step, tolerance) ? t : std::nullopt;
}

bool same_surface(const Element& one, const Element& other) {
  if (one.kind != other.kind || one.object != other.object || one.inverted != other.inverted) return false;
  if (one.flat()) return one.feature == other.feature;
  if (one.origin != other.origin || one.radius != other.radius) return false;
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
