#include "geometry/loop/loop_tile_sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/loop/loop_sample.h"

namespace icome::geometry {
namespace {

constexpr int kMostFootSteps = 30;
constexpr int kMostFootHalvings = 12;
constexpr double kTileFootDone = 1e-11;  // of the surface's size: distances are then exact by far
constexpr int kMostTileAdvances = 200;
constexpr double kSharpestBend = 0.95;  // bend times distance up to which the curvature bounds how they fall
constexpr double kBarelyOnSide = 1e-9;  // cosine: a ball beside a rim touches it from the front and the back
constexpr double kGoingIn = 1e-12;      // cosine between way and normal: along the surface counts as inwards

/// A place by barycentric coordinates of a tile's second and third corner.
struct TileSpot {
  double a, b;
};

/// Half the squared distance to a point over a tile's coordinates, to second order.
struct DistanceModel {
  Vector3 place, away;
  double half_square;
  Vector2 slope;
  Eigen::Matrix2d bend;
};

class ProjectionSearch {
 public:
  ProjectionSearch(LoopCursor& cursor, const LoopTile& tile, const Vector3& point)
      : cursor_(cursor), tile_(tile), point_(point) {
    change_ << tile.corners[1] - tile.corners[0], tile.corners[2] - tile.corners[0];
  }

  DistanceModel look(const TileSpot& at) {
    const Vector2 uv = tile_.at(at.a, at.b);
    DistanceModel m;
    if (!cursor_.go(tile_.piece, std::max(0.0, uv.x()), std::max(0.0, uv.y()))) {
      m.place = cursor_.fan().apex;
      m.away = point_ - m.place;
      m.half_square = 0.5 * m.away.squaredNorm();
      m.slope.setZero();
      m.bend.setIdentity();
      return m;
    }
    const QuarticJet2 jet = evaluate2(cursor_.cell().shape, cursor_.s(), cursor_.t());
    const Vector3 value = vector3(jet.value);
    m.place = cursor_.cell().origin + value;
    m.away = (point_ - cursor_.cell().origin) - value;
    m.half_square = 0.5 * m.away.squaredNorm();
    const Vector4 away = vector4(m.away);
    const double scale = cursor_.cell().scale;
    const Eigen::Matrix2d change = scale * change_;
    m.slope = -change.transpose() * Vector2(away.dot(jet.ds), away.dot(jet.dt));
    Eigen::Matrix2d metric, bend;
    metric << jet.ds.squaredNorm(), jet.ds.dot(jet.dt), jet.ds.dot(jet.dt), jet.dt.squaredNorm();
    bend << away.dot(jet.dss), away.dot(jet.dst), away.dot(jet.dst), away.dot(jet.dtt);
    metric = change.transpose() * metric * change;
    m.bend = metric - change.transpose() * bend * change;
    // If the distance is not convex, its metric leads downhill as well.
    if (!(m.bend.determinant() > 1e-3 * metric.determinant()) || !(m.bend.trace() > 0.0)) m.bend = metric;
    return m;
  }

  /// The minimum of the model within the tile.
  static TileSpot least(const DistanceModel& m, const TileSpot& from) {
    const double det = m.bend.determinant();
    if (det > 0.0) {
      const Vector2 step = -m.bend.inverse() * m.slope;
      const TileSpot free{from.a + step.x(), from.b + step.y()};
      if (free.a >= 0.0 && free.b >= 0.0 && free.a + free.b <= 1.0) return free;
    }
    TileSpot best = from;
    double lowest = std::numeric_limits<double>::infinity();
    constexpr std::array<std::array<double, 4>, 3> kEdges = {{{0, 0, 1, 0}, {1, 0, -1, 1}, {0, 1, 0, -1}}};
    for (const auto& [a, b, along_a, along_b] : kEdges) {
      const Vector2 begin(a - from.a, b - from.b), along(along_a, along_b);
      const Vector2 slope = m.slope + m.bend * begin;
      const double bend = along.dot(m.bend * along);
      const double way = bend > 0.0 ? std::clamp(-along.dot(slope) / bend, 0.0, 1.0) : 0.0;
      const Vector2 step = begin + way * along;
      const double there = m.slope.dot(step) + 0.5 * step.dot(m.bend * step);
      if (there >= lowest) continue;
      lowest = there;
      best = {a + way * along_a, b + way * along_b};
    }
    return best;
  }

  TileProjection run(TileSpot at, double done) {
    DistanceModel here = look(at);
    for (int i = 0; i < kMostFootSteps; ++i) {
      const TileSpot to = least(here, at);
      const Vector2 step(to.a - at.a, to.b - at.b);
      const double way = std::sqrt(std::max(0.0, step.dot(here.bend * step)));
      double share = 1.0;
      bool moved = false;
      for (int j = 0; j < kMostFootHalvings && !moved; ++j, share *= 0.5) {
        const TileSpot next{at.a + share * step.x(), at.b + share * step.y()};
        const DistanceModel there = look(next);
        moved = there.half_square < here.half_square;
        if (!moved) continue;
        at = next;
        here = there;
      }
      if (!moved || way <= done) break;
    }
    const Vector2 uv = tile_.at(at.a, at.b);
    return {clamped({tile_.piece, uv.x(), uv.y()}), here.place, here.away, std::sqrt(2.0 * here.half_square)};
  }

 private:
  LoopCursor& cursor_;
  const LoopTile& tile_;
  const Vector3& point_;
  Eigen::Matrix2d change_;  // of u and v with a and b
};

constexpr std::array<TileSpot, 4> kFootStarts = {{{1.0 / 3.0, 1.0 / 3.0}, {0, 0}, {1, 0}, {0, 1}}};

}  // namespace

TileProjection projection_on_tile(LoopCursor& cursor, const LoopPatches& patches, const LoopTile& tile,
                                  const Vector3& point) {
  ProjectionSearch search(cursor, tile, point);
  TileSpot start = kFootStarts[0];
  if (!tile.tame) {
    double least = std::numeric_limits<double>::infinity();
    for (const TileSpot& spot : kFootStarts) {
      const double there = search.look(spot).half_square;
      if (there >= least) continue;
      least = there;
      start = spot;
    }
  }
  return search.run(start, kTileFootDone * patches.size());
}

namespace {

/// The places of the centre as a cylinder about the tile's axis.
struct CentreCylinder {
  double wide, low, high;
};

CentreCylinder centre_cylinder(const LoopTile& tile, LoopSide side, double radius) {
  if (tile.sharp || tile.spread >= 1.0) return {tile.wide + radius, tile.low - radius, tile.high + radius};
  const double least_rise = radius * std::sqrt(1.0 - tile.spread * tile.spread);
  const double wide = tile.wide + radius * tile.spread;
  if (side == LoopSide::Front) return {wide, tile.low + least_rise, tile.high + radius};
  return {wide, tile.low - radius, tile.high - least_rise};
}

}  // namespace

std::optional<std::array<double, 2>> way_near_tile(const LoopTile& tile, LoopSide side, double radius,
                                                   const Vector3& start, const Vector3& step, double reach) {
  const CentreCylinder room = centre_cylinder(tile, side, radius);
  const Vector3 from = start - tile.centre;
  const double height = tile.axis.dot(from), rise = tile.axis.dot(step);
  double first = 0.0, last = 1.0;
  const double low = room.low - reach - height, high = room.high + reach - height;
  if (rise == 0.0) {
    if (low > 0.0 || high < 0.0) return std::nullopt;
  } else {
    first = std::max(first, std::min(low / rise, high / rise));
    last = std::min(last, std::max(low / rise, high / rise));
    if (!(first <= last)) return std::nullopt;
  }
  const Vector3 beside = from - height * tile.axis, way = step - rise * tile.axis;
  const double wide = room.wide + reach;
  const double a = way.squaredNorm(), b = beside.dot(way), c = beside.squaredNorm() - wide * wide;
  if (a <= 1e-30 * step.squaredNorm()) {
    if (c > 0.0) return std::nullopt;
    return std::array<double, 2>{first, last};
  }
  const double square = b * b - a * c;
  if (square < 0.0) return std::nullopt;
  const double root = std::sqrt(square);
  first = std::max(first, (-b - root) / a);
  last = std::min(last, (-b + root) / a);
  if (!(first <= last)) return std::nullopt;
  return std::array<double, 2>{first, last};
}

Bounds centres_on_tile(const LoopTile& tile, LoopSide side, double radius) {
  const CentreCylinder room = centre_cylinder(tile, side, radius);
  Bounds box;
  for (int i = 0; i < 3; ++i) {
    const double along = tile.axis[i];
    const double beside = room.wide * std::sqrt(std::max(0.0, 1.0 - along * along));
    const double one = along * room.low, other = along * room.high;
    box.min()[i] = tile.centre[i] + std::min(one, other) - beside;
    box.max()[i] = tile.centre[i] + std::max(one, other) + beside;
  }
  return box;
}

namespace {

/// The length (m) that a point can surely go before it is nearer to a tile than `radius`: its distance is now
/// `distance`, falling by `fall` for each metre. Half the squared distance falls like that of a convex set,
/// except for the amount by which the tile curves in.
double sure_way(const LoopTile& tile, LoopSide side, double distance, double fall, double radius) {
  const double plain = distance - radius;
  const double bent = tile.bend_at(side) * distance;
  if (!tile.tame || !(bent < kSharpestBend)) return plain;
  const double curve = bent / (1.0 - bent);
  const double half_room = 0.5 * (distance * distance - radius * radius);
  // half_room - distance * fall * s - curve * s^2 / 2 = 0
  const double slope = distance * fall;
  const double root = std::sqrt(slope * slope + 2.0 * curve * half_room);
  const double below = slope + root;
  return below > 0.0 ? std::max(plain, 2.0 * half_room / below) : std::numeric_limits<double>::infinity();
}

bool touches_from(LoopCursor& cursor, const LoopPatches& patches, LoopSide side, const TileProjection& foot) {
  const Vector3 normal = loop_point(cursor, patches, foot.spot.piece, foot.spot.u, foot.spot.v).normal;
  const double in_front = normal.dot(foot.away);
  const double barely = kBarelyOnSide * foot.distance;
  return side == LoopSide::Front ? in_front >= -barely : in_front <= barely;
}

}  // namespace

std::optional<TileTouch> first_touch(const LoopPatches& patches, const LoopTile& tile, LoopSide side,
                                     const LoopBall& ball, const Vector3& start, const Vector3& step) {
  const double length = step.norm();
  if (tile.folded_at(side) || !(length > 0.0) || !std::isfinite(length) || !start.allFinite()) return {};
  const double rounding = 1e-15 * (patches.size() + start.norm());
  const double near = std::max(0.1 * ball.slack, 4.0 * rounding), touching = std::max(ball.slack, near);
  const auto part = way_near_tile(tile, side, ball.radius, start, step, 8.0 * touching);
  if (!part) return {};
  LoopCursor cursor(patches);
  const Vector3 along = step / length;
  const double end = (*part)[1] * length;
  double way = (*part)[0] * length;
  bool at_start = way <= 0.0, overlaps = false;
  for (int i = 0; i < kMostTileAdvances; ++i) {
    const TileProjection foot = projection_on_tile(cursor, patches, tile, start + way * along);
    const double gap = foot.distance - ball.radius;
    const double fall = foot.distance > 0.0 ? -along.dot(foot.away) / foot.distance : 1.0;
    const bool goes_in = fall >= -kGoingIn;
    if (gap < -touching || (overlaps && gap < touching)) {
      overlaps = true;  // until clearly farther off
      way += std::max(-gap, touching);
    } else if (gap <= (at_start ? touching : near)) {
      if (goes_in && touches_from(cursor, patches, side, foot))
        return TileTouch{std::clamp(way / length, 0.0, 1.0), foot};
      overlaps = goes_in;  // from the other side
      way += touching;
    } else {
      overlaps = false;
      way += std::max(near, sure_way(tile, side, foot.distance, fall, ball.radius));
    }
    at_start = false;
    if (way > end) return {};
  }
  // Grazing for so long: the rest of the way counts as touching.
  const TileProjection foot = projection_on_tile(cursor, patches, tile, start + way * along);
  if (overlaps || !touches_from(cursor, patches, side, foot)) return {};
  return TileTouch{std::clamp(way / length, 0.0, 1.0), foot};
}

}  // namespace icome::geometry
