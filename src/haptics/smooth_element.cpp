#include "haptics/smooth_element.h"

#include <algorithm>
#include <cmath>

namespace icome::haptics {
namespace {

using geometry::SurfacePlace;

Vector3 into_surface(const Element& e, const Vector3& vector) {
  return {e.u.dot(vector), e.v.dot(vector), e.axis.dot(vector)};
}

Vector3 from_surface(const Element& e, const Vector3& vector) {
  return e.u * vector.x() + e.v * vector.y() + e.axis * vector.z();
}

SurfacePlace hinted(const Element& e) { return {e.hint, Vector3::Zero(), e.feature, e.hint_u, e.hint_v}; }

void take_hint(Element& e, const SurfacePlace& place) {
  e.feature = place.piece;
  e.hint = place.point;
  e.hint_u = place.u;
  e.hint_v = place.v;
}

SurfacePlace foot(const Element& e, const Vector3& in_surface) {
  return e.surface->foot(hinted(e), in_surface, e.time);
}

/// The normal towards the side that is felt.
Vector3 felt_normal(const Element& e, const SurfacePlace& place) {
  const Vector3 outward = from_surface(e, place.normal);
  return e.inverted ? Vector3(-outward) : outward;
}

Footing footing_at(const Element& e, const SurfacePlace& place, const Vector3& in_surface) {
  const double outward = place.normal.dot(in_surface - place.point);
  return {e.inverted ? -outward : outward, felt_normal(e, place), place.reached};
}

/// A foot at the rim of a sheet or at a crease does not hold who is pulled beyond: so far over it that
/// covers() sees that.
Vector3 over_rim(const Element& e, const SurfacePlace& foot, const Vector3& in_surface,
                 const Tolerance& tolerance) {
  const Vector3 pull = in_surface - foot.point;
  const Vector3 along = pull - foot.normal.dot(pull) * foot.normal;
  if (!foot.reached || along.norm() <= tolerance.touching()) return Vector3::Zero();
  if (e.surface->covers(foot, in_surface, e.time, tolerance.rim())) return Vector3::Zero();
  return tolerance.touching() * along.normalized();
}

}  // namespace

Footing smooth_footing(const Element& e, const Vector3& position) {
  const Vector3 local = into_surface(e, position - e.origin);
  return footing_at(e, foot(e, local), local);
}

bool smooth_covers(const Element& e, const Vector3& position, const Tolerance& tolerance) {
  const Vector3 local = into_surface(e, position - e.origin);
  return e.surface->covers(foot(e, local), local, e.time, tolerance.rim());
}

Vector3 smooth_settle(const Element& e, const Vector3& position, const Tolerance& tolerance) {
  const Vector3 local = into_surface(e, position - e.origin);
  const SurfacePlace place = foot(e, local);
  return e.origin + from_surface(e, place.point + over_rim(e, place, local, tolerance)) +
         tolerance.gap * felt_normal(e, place);
}

std::optional<double> smooth_sweep(Element& e, const Vector3& start, const Vector3& step,
                                   const Tolerance& tolerance) {
  const double length = step.norm();
  if (length <= 0.0) return std::nullopt;
  // The tip rests a gap before the surface: look a little beyond the end.
  const double stretch = 1.0 + 4.0 * tolerance.gap / length;
  const Vector3 from = into_surface(e, start - e.origin);
  const Vector3 way = stretch * into_surface(e, step);
  std::optional<double> first;
  for (const bool from_behind : {false, true}) {
    if (from_behind && !e.two_sided) break;
    const auto entry = e.surface->entry(e.feature, from, way, from_behind, e.time, tolerance.rim());
    if (!entry) continue;
    const double fall = std::abs(entry->place.normal.dot(way));
    const double back = fall > 0.0 ? tolerance.gap / fall : entry->t;
    const double rest = stretch * std::max(0.0, entry->t - back);
    if (rest > 1.0 || (first && rest >= *first)) continue;
    first = rest;
    e.inverted = from_behind;
    take_hint(e, entry->place);
  }
  return first;
}

Footing follow_foot(Element& e, const Vector3& position) {
  const Vector3 local = into_surface(e, position - e.origin);
  const SurfacePlace place = foot(e, local);
  take_hint(e, place);
  return footing_at(e, place, local);
}

Vector3 smooth_velocity(const Element& e, const Vector3& position) {
  const SurfacePlace place = foot(e, into_surface(e, position - e.origin));
  return from_surface(e, place.normal) * e.surface->normal_speed(place, e.time);
}

}  // namespace icome::haptics
