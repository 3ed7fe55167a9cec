#include "geometry/loop/loop_contact.h"

#include <algorithm>
#include <cmath>

#include "geometry/loop/loop_crossing.h"

namespace icome::geometry {
namespace {

// The slope (sine) below which a crossing may be one in either direction: grazing.
constexpr double kGrazing = 1e-6;
// A point on the surface that moves along it to within rounding counts as moving in.
constexpr double kMovingIn = 1e-12;

Vector3 slab_axis_of(const LoopPatches& patches, std::uint32_t piece) {
  const auto& axis = patches.slab(piece).axis;
  return {axis[0], axis[1], axis[2]};
}

/// The tolerance of lengths; never quite 0.
double slack_of(const LoopPatches& patches, double slack) { return std::max(slack, 1e-15 * patches.size()); }

struct Near {
  bool path = false;   // may the path meet the piece?
  bool start = false;  // may the piece be within slack of the start?
};

Near near_piece(const LoopPatches& patches, std::uint32_t piece, const Vector3& start, const Vector3& step,
                double slack) {
  const LoopPatches::Slab& slab = patches.slab(piece);
  const Vector3 axis = slab_axis_of(patches, piece);
  const double room = 2.0 * slack;
  const double from = axis.dot(start - patches.centre()), to = from + axis.dot(step);
  Near near;
  if (std::min(from, to) > slab.hi + room || std::max(from, to) < slab.lo - room) return near;
  const FloatBox box = patches.tree().leaf_box(piece);
  near.path = near.start = true;
  for (int i = 0; i < 3; ++i) {
    const double a = start[i], b = a + step[i];
    if (std::min(a, b) > box.hi[i] + room || std::max(a, b) < box.lo[i] - room) return {};
    near.start = near.start && a <= box.hi[i] + room && a >= box.lo[i] - room;
  }
  near.start = near.start && from <= slab.hi + room && from >= slab.lo - room;
  return near;
}

/// The piece's place within `slack` of the point, if there is one.
std::optional<LoopSpot> spot_under(const LoopPatches& patches, std::uint32_t piece, const Vector3& point,
                                   double slack) {
  const Vector3 axis = slab_axis_of(patches, piece).normalized();
  const LoopRay ray(point - 2.0 * slack * axis, 4.0 * slack * axis, slack, axis.unitOrthogonal());
  std::optional<LoopSpot> found;
  double best = slack * (1.0 + 1e-6);
  LoopCrossings(patches, ray, [&](const LoopCrossing& crossing) {
    const double away = std::abs(crossing.at - 2.0 * slack) * std::abs(crossing.slope);
    if (away <= best) {
      best = away;
      found = crossing.spot;
    }
    return ray.length;
  }).find(piece);
  return found;
}

}  // namespace

Bounds loop_box(const LoopPatches& patches, std::uint32_t piece) {
  const FloatBox box = patches.tree().leaf_box(piece);
  return {Vector3(box.lo[0], box.lo[1], box.lo[2]), Vector3(box.hi[0], box.hi[1], box.hi[2])};
}

SurfacePlace loop_place(LoopCursor& cursor, const LoopPatches& patches, const LoopSpot& spot) {
  const LoopPoint at = loop_point(cursor, patches, spot.piece, spot.u, spot.v);
  return {at.point, at.normal, spot.piece, spot.u, spot.v};
}

std::optional<SurfaceHit> loop_hit(const LoopPatches& patches, std::uint32_t piece, const Vector3& start,
                                   const Vector3& step, bool from_behind, double slack_in) {
  const double slack = slack_of(patches, slack_in);
  const Near near = near_piece(patches, piece, start, step, slack);
  const double length = step.norm();
  if (!near.path || !(length > 0.0) || !start.allFinite() || !std::isfinite(length)) return {};
  const double side = from_behind ? -1.0 : 1.0;
  LoopCursor cursor(patches);
  if (near.start) {
    if (const auto spot = spot_under(patches, piece, start, slack)) {
      const SurfacePlace place = loop_place(cursor, patches, *spot);
      if (side * place.normal.dot(step) <= kMovingIn * length) return SurfaceHit{0.0, place};
    }
  }
  const LoopRay ray(start, step, slack, slab_axis_of(patches, piece));
  std::optional<LoopCrossing> first;
  LoopCrossings(patches, ray, [&](const LoopCrossing& crossing) {
    const bool goes_in = side * crossing.slope < (crossing.sure ? 0.0 : kGrazing);
    if (goes_in && (!first || crossing.at < first->at)) first = crossing;
    return first ? first->at : ray.length;
  }).find(piece);
  if (!first) return {};
  return SurfaceHit{std::clamp(first->at / length, 0.0, 1.0), loop_place(cursor, patches, first->spot)};
}

namespace {

/// Is `above` beyond boundary edge 0 or 2 of a piece, seen from a place on it?
bool beyond_edge(const LoopPoint& at, int edge, const Vector3& above, double slack) {
  const Vector3 tangent = edge == 0 ? at.du : Vector3(-at.dv);  // counter-clockwise
  const Vector3 out = tangent.cross(at.normal).stableNormalized();
  return (above - at.point).dot(out) > slack;
}

/// Is `above` beyond one of the fan's two edges at a piece's vertex on a boundary or crease?
bool beyond_vertex(const LoopPatches& patches, std::uint32_t piece, const Vector3& above, double slack) {
  LoopCursor cursor(patches);
  for (const bool counter_clockwise : {false, true}) {
    std::uint32_t last = piece;
    for (std::uint32_t next = piece; next != LoopPatches::kNone;) {
      last = next;
      next = next_at_vertex(patches, next, counter_clockwise);
      if (next == piece) return false;  // all round
    }
    const LoopPoint at = loop_point(cursor, patches, last, 0.0, 0.0);
    if (beyond_edge(at, counter_clockwise ? 2 : 0, above, slack)) return true;
  }
  return false;
}

}  // namespace

bool loop_covers(const LoopPatches& patches, const SurfacePlace& place, const Vector3& above,
                 double slack_in) {
  const LoopSpot spot = clamped({place.piece, place.u, place.v});
  if (spot.piece % 4 == 3) return true;
  const bool may_end_0 = ends_at(patches, spot.piece, 0), may_end_2 = ends_at(patches, spot.piece, 2);
  const double slack = slack_of(patches, slack_in);
  LoopCursor cursor(patches);
  // A piece is hardly ever smaller than this share of its boxes.
  const double near = std::min(1.0, 100.0 * slack / loop_box(patches, spot.piece).diagonal().norm());
  if (spot.u + spot.v <= near && !(may_end_0 && may_end_2) &&
      beyond_vertex(patches, spot.piece, above, slack)) {
    return false;
  }
  if (!may_end_0 && !may_end_2) return true;
  if ((!may_end_0 || spot.v > near) && (!may_end_2 || spot.u > near)) return true;
  const LoopPoint at = loop_point(cursor, patches, spot.piece, spot.u, spot.v);
  if (may_end_0 && spot.v * at.dv.norm() <= 2.0 * slack && beyond_edge(at, 0, above, slack)) return false;
  return !(may_end_2 && spot.u * at.du.norm() <= 2.0 * slack && beyond_edge(at, 2, above, slack));
}

}  // namespace icome::geometry
