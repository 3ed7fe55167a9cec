#include "haptics/shapes/smooth_element.h"

#include <algorithm>
#include <cmath>

#include "geometry/implicit/formula_allowance.h"

namespace icome::haptics {
namespace {

using geometry::SurfacePlace;

constexpr double kSamePlace = 1e-14;  // of coordinates
constexpr double kGroove = 1e5;       // gaps beyond a crease in which the other side of a groove rises

Vector3 into_surface(const Element& e, const Vector3& vector) {
  return {e.u.dot(vector), e.v.dot(vector), e.axis.dot(vector)};
}

Vector3 from_surface(const Element& e, const Vector3& vector) {
  return e.u * vector.x() + e.v * vector.y() + e.axis * vector.z();
}

/// Is it the foot asked for? The position may have moved by rounding.
bool answers(const SmoothProjection& known, const Element& e, const Vector3& in_surface) {
  return known.place.reached && known.time == e.time &&
         (known.of - in_surface).squaredNorm() <= kSamePlace * kSamePlace * in_surface.squaredNorm();
}

/// The projection, found from the nearer one of the known feet.
SurfacePlace projection(const Element& e, const Vector3& in_surface) {
  if (answers(e.here, e, in_surface)) return e.here.place;
  if (answers(e.ahead, e, in_surface)) return e.ahead.place;
  const double from_here = (e.here.place.point - in_surface).squaredNorm();
  const bool nearer_ahead = (e.ahead.of - in_surface).squaredNorm() < from_here;  // false where it is unknown
  return e.surface->nearest_local(nearer_ahead ? e.ahead.place : e.here.place, in_surface, e.time);
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

/// The first hit of a way on any piece of the surface but the foot's own.
std::optional<geometry::SurfaceHit> met_beside(const Element& e, const SurfacePlace& foot,
                                               const Vector3& start, const Vector3& way,
                                               const Tolerance& tolerance) {
  std::optional<geometry::SurfaceHit> first;
  e.surface->near(start, start + way, tolerance.gap, e.time, [&](std::uint32_t piece, const base::Bounds&) {
    if (e.surface->same(foot.piece, piece)) return true;
    const auto hit = e.surface->first_hit(piece, start, way, e.inverted, e.time, tolerance.rim());
    if (hit && (!first || hit->t < first->t)) first = hit;
    return true;
  });
  return first;
}

/// Offset from a foot at the rim of a sheet or at a crease, which does not hold a tip that is pulled beyond:
/// so far over it that covers() sees that. Up the other side of a groove if the pull leads there, else none.
Vector3 over_rim(const Element& e, const SurfacePlace& foot, const Vector3& in_surface,
                 const Tolerance& tolerance) {
  const Vector3 pull = in_surface - foot.point;
  const Vector3 along = pull - foot.normal.dot(pull) * foot.normal;
  if (!foot.reached || along.norm() <= tolerance.touching()) return Vector3::Zero();
  if (e.surface->covers(foot, in_surface, e.time, tolerance.rim())) return Vector3::Zero();
  const Vector3 start = foot.point + (e.inverted ? -tolerance.gap : tolerance.gap) * foot.normal;
  const Vector3 way = kGroove * tolerance.gap * along.normalized();
  const auto groove = met_beside(e, foot, start, way, tolerance);
  if (!groove) return tolerance.touching() * along.normalized();
  const Vector3& other = groove->place.normal;
  return (pull - other.dot(pull) * other).dot(along) > 0.0 ? way : Vector3::Zero();
}

/// Resting place of a tip that is pulled to `in_surface`: a gap above the given foot of that.
Vector3 above(const Element& e, const SurfacePlace& foot, const Vector3& in_surface,
              const Tolerance& tolerance) {
  return e.origin + from_surface(e, foot.point + over_rim(e, foot, in_surface, tolerance)) +
         tolerance.gap * felt_normal(e, foot);
}

}  // namespace

Footing smooth_footing(const Element& e, const Vector3& position) {
  const Vector3 local = into_surface(e, position - e.origin);
  return footing_at(e, projection(e, local), local);
}

bool smooth_covers(const Element& e, const Vector3& position, const Tolerance& tolerance) {
  const Vector3 local = into_surface(e, position - e.origin);
  return e.surface->covers(projection(e, local), local, e.time, tolerance.rim());
}

Vector3 smooth_settle(const Element& e, const Vector3& position, const Tolerance& tolerance) {
  const Vector3 local = into_surface(e, position - e.origin);
  return above(e, projection(e, local), local, tolerance);
}

SettledAhead settle_ahead(Element& e, const Vector3& position, const Tolerance& tolerance) {
  const Vector3 local = into_surface(e, position - e.origin);
  SurfacePlace place = projection(e, local);
  const Vector3 settled = above(e, place, local, tolerance);
  const bool sure = place.reached;
  place.reached = true;  // straight below, wherever the walk ended
  e.ahead = {into_surface(e, settled - e.origin), place, e.time};
  return {settled, sure};
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
    const auto hit = e.surface->first_hit(e.feature, from, way, from_behind, e.time, tolerance.rim());
    if (!hit) continue;
    const double fall = std::abs(hit->place.normal.dot(way));
    const double back = fall > 0.0 ? tolerance.gap / fall : hit->t;
    // Out of time, a hit tells only how far the way is surely free, however it grazes the surface there.
    const double least = geometry::FormulaAllowance::spent() ? 0.5 * hit->t : 0.0;
    const double rest = stretch * std::max(least, hit->t - back);
    if (rest > 1.0 || (first && rest >= *first)) continue;
    first = rest;
    e.inverted = from_behind;
    e.feature = hit->place.piece;
    e.here = {};
    e.here.place = hit->place;
    e.ahead = {};
  }
  return first;
}

void follow_projection(Element& e, const Vector3& position) {
  const Vector3 local = into_surface(e, position - e.origin);
  e.here = {local, projection(e, local), e.time};
  e.feature = e.here.place.piece;
}

bool has_swallowed(const Element& e, const Vector3& position) {
  return e.surface->knows_inside_quickly() && e.surface->inside(into_surface(e, position - e.origin), e.time);
}

Vector3 smooth_velocity(const Element& e, const Vector3& position) {
  const SurfacePlace place = projection(e, into_surface(e, position - e.origin));
  return from_surface(e, place.normal) * e.surface->normal_speed(place, e.time);
}

}  // namespace icome::haptics
