#include "geometry/loop/loop_offset.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/loop/loop_contact.h"
#include "geometry/loop/loop_projection.h"
#include "geometry/loop/loop_sample.h"
#include "geometry/loop/loop_surface.h"
#include "geometry/straight_way_out.h"

namespace icome::geometry {
namespace {

constexpr double kMostRoll = 0.3;       // rad, of one walk round an edge or a fold
constexpr int kMostRollHalvings = 6;    // of such a walk
constexpr double kLeastRoom = 0.02;     // of the ball's curvature: less room than this is a fold
constexpr double kAlongNormal = 1e-6;   // the largest sine between normal and goal at a foot
constexpr double kOverlapNoise = 1e-9;  // of the bounds: a ball that overlaps by less is at the surface
constexpr int kMostPushesOut = 8;       // from one place to the next
constexpr double kNeighbourTurn = 0.8;  // cosine between the axes of tiles that are one smooth sheet

/// The part of a pull that leads round a ball whose centre lies towards `out`, no longer than a walk.
Vector3 step_round_ball(const Vector3& out, const Vector3& pull, double radius) {
  const Vector3 along = pull - out.dot(pull) * out;
  const double length = along.norm(), most = kMostRoll * radius;
  return length > most ? Vector3(along * (most / length)) : along;
}

/// Does the surface end or bend sharply at the spot?
bool at_sharp_border(const LoopPatches& patches, const LoopSpot& spot) {
  if (spot.v == 0.0 && ends_at(patches, spot.piece, 0)) return true;
  if (spot.u == 0.0 && ends_at(patches, spot.piece, 2)) return true;
  if (spot.u > 0.0 || spot.v > 0.0 || patches.regular(spot.piece)) return false;
  const FanRule rule = patches.rule(spot.piece);
  return rule != FanRule::Smooth && rule != FanRule::Crease;
}

/// The largest curvature (1/m) of the surface towards `out` at a spot; 0 at an extraordinary vertex.
double curvature_towards(LoopCursor& cursor, const LoopSpot& spot, const Vector3& out) {
  if (!cursor.go(spot.piece, spot.u, spot.v)) return 0.0;
  const QuarticJet2 jet = evaluate2(cursor.cell().shape, cursor.s(), cursor.t());
  const Vector4 normal = vector4(out);
  const double e = jet.ds.squaredNorm(), f = jet.ds.dot(jet.dt), g = jet.dt.squaredNorm();
  const double l = normal.dot(jet.dss), m = normal.dot(jet.dst), n = normal.dot(jet.dtt);
  const double area = e * g - f * f;
  if (!(area > 0.0)) return std::numeric_limits<double>::infinity();
  const double mean = 0.5 * (l * g - 2.0 * m * f + n * e) / area;
  const double product = (l * n - m * m) / area;
  return mean + std::sqrt(std::max(0.0, mean * mean - product));
}

}  // namespace

base::Result<std::shared_ptr<const LoopOffset>> LoopOffset::create(std::shared_ptr<const LoopSurface> surface,
                                                                   double radius) {
  auto tiles = LoopTiles::create(surface->patches(), radius);
  if (!tiles) return tl::unexpected(tiles.error());
  return std::shared_ptr<const LoopOffset>(new LoopOffset(std::move(surface), std::move(*tiles), radius));
}

LoopOffset::LoopOffset(std::shared_ptr<const LoopSurface> surface, LoopTiles tiles, double radius)
    : surface_(std::move(surface)), tiles_(std::move(tiles)), radius_(radius) {}

Bounds LoopOffset::bounds() const {
  const Bounds box = surface_->bounds();
  return {box.min() - Vector3::Constant(radius_), box.max() + Vector3::Constant(radius_)};
}

void LoopOffset::near(const Vector3& a, const Vector3& b, double reach, double /*time*/,
                      PieceVisitor visit) const {
  tiles_.tree().near(SegmentQuery(a, b, radius_ + reach, true), [&](std::uint32_t which) {
    const LoopTile& tile = tiles_[which];
    Bounds box;
    for (const LoopSide side : {LoopSide::Front, LoopSide::Back}) {
      if (!tile.folded_at(side) && way_near_tile(tile, side, radius_, a, b - a, reach))
        box.extend(centres_on_tile(tile, side, radius_));
    }
    return box.isEmpty() || visit(which, box);
  });
}

std::optional<SurfaceHit> LoopOffset::first_hit(std::uint32_t piece, const Vector3& start,
                                                const Vector3& step, bool from_behind, double /*time*/,
                                                double slack) const {
  const LoopSide side = from_behind ? LoopSide::Back : LoopSide::Front;
  const LoopPatches& patches = surface_->patches();
  const auto touch = first_touch(patches, tiles_[tile_of(piece)], side, {radius_, slack}, start, step);
  if (!touch) return std::nullopt;
  const TileProjection& foot = touch->foot;
  const Contact contact{foot.spot, foot.place, foot.away.stableNormalized()};
  SurfacePlace place = centre_of(contact, side);
  place.piece = tile_of(piece) + (from_behind ? tiles_.count() : 0);
  return SurfaceHit{touch->t, place};
}

SurfacePlace LoopOffset::centre_of(const Contact& contact, LoopSide side) const {
  const bool front = side == LoopSide::Front;
  SurfacePlace place;
  place.point = contact.place + radius_ * contact.out;
  place.normal = front ? contact.out : Vector3(-contact.out);
  place.piece =
      tiles_.find(contact.spot.piece, contact.spot.u, contact.spot.v) + (front ? 0 : tiles_.count());
  place.u = contact.spot.u;
  place.v = contact.spot.v;
  return place;
}

LoopOffset::Contact LoopOffset::contact_of(const SurfacePlace& from) const {
  LoopCursor cursor(surface_->patches());
  const LoopSpot spot = clamped({tiles_[tile_of(from.piece)].piece, from.u, from.v});
  const LoopPoint at = loop_point(cursor, surface_->patches(), spot.piece, spot.u, spot.v);
  const Vector3 away = from.point - at.point;
  const bool clear = away.norm() > 1e-3 * radius_;
  const double sign = side_of(from.piece) == LoopSide::Front ? 1.0 : -1.0;
  return {spot, at.point, clear ? Vector3(away.normalized()) : Vector3(sign * at.normal)};
}

/// Can the ball touch the spot from that side at all? It cannot in a fold.
bool LoopOffset::holds(const LoopSpot& spot, const Vector3& out, LoopSide side) const {
  const LoopTile& tile = tiles_[tiles_.find(spot.piece, spot.u, spot.v)];
  if (tile.folded_at(side)) return false;
  if (tile.tame) return true;
  LoopCursor cursor(surface_->patches());
  return curvature_towards(cursor, spot, out) * radius_ < 1.0 - kLeastRoom;
}

/// The contact below (or above) a goal to which the surface leads from a spot, if there is one.
std::optional<LoopOffset::Contact> LoopOffset::contact_towards(const LoopSpot& from, const Vector3& goal,
                                                               LoopSide side) const {
  const LoopPatches& patches = surface_->patches();
  LoopCursor cursor(patches);
  const LoopSpot spot = loop_projection(patches, cursor, from, goal);
  const LoopPoint at = loop_point(cursor, patches, spot.piece, spot.u, spot.v);
  const Vector3 away = goal - at.point, up = side == LoopSide::Front ? at.normal : Vector3(-at.normal);
  const double beside = (away - up.dot(away) * up).norm();
  Contact contact{spot, at.point, up};
  if (beside > kAlongNormal * away.norm() + kOverlapNoise * patches.size()) {
    if (!at_sharp_border(patches, spot)) return std::nullopt;
    contact.out = away.normalized();
    return contact;
  }
  if (!holds(spot, up, side)) return std::nullopt;
  return contact;
}

// Goes there at once where the surface is smooth on the way; else round the ball a part of the way, to the
// contact nearest there.
SurfacePlace LoopOffset::nearest_local(const SurfacePlace& from, const Vector3& goal, double /*time*/) const {
  const LoopSide side = side_of(from.piece);
  const Contact here = contact_of(from);
  const auto there = contact_towards(here.spot, goal, side);
  if (there && there->out.dot(here.out) >= std::cos(kMostRoll)) return centre_of(*there, side);
  const Vector3 centre = here.place + radius_ * here.out;
  Vector3 step = step_round_ball(here.out, goal - centre, radius_);
  SurfacePlace place = centre_of(here, side);
  place.reached = step.norm() <= kOverlapNoise * surface_->patches().size();
  for (int i = 0; i < kMostRollHalvings && !place.reached; ++i, step *= 0.5) {
    const auto next = contact_towards(here.spot, centre + step, side);
    if (!next || next->out.dot(here.out) < std::cos(2.0 * kMostRoll)) continue;
    place = centre_of(*next, side);
    place.reached = false;
    break;
  }
  return place;
}

// Nothing is trimmed: a ball cannot overlap a tile, whatever other tiles it touches.
bool LoopOffset::covers(const SurfacePlace& /*place*/, const Vector3& /*above*/, double /*time*/,
                        double /*slack*/) const {
  return true;
}

bool LoopOffset::same(std::uint32_t one, std::uint32_t other) const {
  const std::uint32_t first = tile_of(one), second = tile_of(other);
  if (first == second) return true;
  const LoopTile &a = tiles_[first], &b = tiles_[second];
  if (!a.tame || !b.tame || a.axis.dot(b.axis) < kNeighbourTurn) return false;
  return (a.centre - b.centre).norm() <= a.wide + b.wide && surface_->patches().adjoin(a.piece, b.piece);
}

bool LoopOffset::inside(const Vector3& point, double /*time*/) const {
  const double reach = radius_ - kOverlapNoise * surface_->patches().size();
  const Bounds box = bounds();
  if (!box.contains(point)) return false;
  const SurfacePlace nearest = loop_nearest(surface_->patches(), point);
  const Vector3 away = point - nearest.point;
  if (surface_->closed()) return away.norm() < reach || surface_->inside(point);
  return away.norm() < reach && nearest.normal.dot(away) >= 0.0;
}

std::optional<SurfacePlace> LoopOffset::way_out(const Vector3& point, double time) const {
  if (!inside(point, time)) return std::nullopt;
  if (const auto pushed = pushed_out(point)) return pushed;
  return straight_way_out(point, bounds(), radius_, 20.0 * kOverlapNoise * surface_->patches().size(),
                          [&](const Vector3& centre) { return inside(centre, time); });
}

/// Moves the centre out of the nearest place, again and again; nothing where that does not free it.
std::optional<SurfacePlace> LoopOffset::pushed_out(const Vector3& point) const {
  const double clear = 2.0 * kOverlapNoise * surface_->patches().size();
  Vector3 at = point;
  for (int i = 0; i < kMostPushesOut; ++i) {
    const SurfacePlace nearest = loop_nearest(surface_->patches(), at);
    const Vector3 away = at - nearest.point;
    const bool within = surface_->inside(at) || away.norm() <= clear;
    const Vector3 out = within ? nearest.normal : Vector3(away.normalized());
    at = nearest.point + (radius_ + clear) * out;
    if (!inside(at)) return SurfacePlace{at, out};
  }
  return std::nullopt;
}

std::size_t LoopOffset::bytes() const { return sizeof(*this) + surface_->bytes() + tiles_.bytes(); }

}  // namespace icome::geometry
