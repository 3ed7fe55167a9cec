// The inside test and the nearest place of a Loop surface.
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/loop/loop_contact.h"
#include "geometry/loop/loop_crossing.h"
#include "geometry/loop/loop_projection.h"

namespace icome::geometry {
namespace {

constexpr int kMostDirections = 24;
// Crossings nearer than this to a piece's edge, in its parameters, may be counted twice or not at all.
constexpr double kNearEdge = 1e-9;
constexpr std::size_t kMostCrossingsKept = 256;  // kept of one ray at once

/// Counts the crossings of a ray that ends beyond the whole surface.
class Winding {
 public:
  Winding(const LoopPatches& patches, const Vector3& point, const Vector3& direction)
      : patches_(patches),
        point_(point),
        step_(direction * (2.0 * (patches.size() + (point - patches.bounds().center()).norm()))) {}

  /// The winding number; nothing when this direction leaves doubts.
  std::optional<int> count() {
    patches_.tree().near(SegmentQuery(point_, point_ + step_, 0.0), [&](std::uint32_t piece) {
      look(piece);
      return sure_;
    });
    if (!sure_) return {};
    return winding_;
  }

 private:
  void look(std::uint32_t piece) {
    const LoopPatches::Slab& slab = patches_.slab(piece);
    const LoopRay ray(point_, step_, 0.0, Vector3(slab.axis[0], slab.axis[1], slab.axis[2]));
    std::size_t found = 0;
    LoopCrossings(patches_, ray, [&](const LoopCrossing& crossing) {
      add(crossing, found);
      return ray.length;
    }).find(piece);
  }

  void add(const LoopCrossing& crossing, std::size_t& found) {
    const LoopSpot& spot = crossing.spot;
    if (crossing.at < 0.0) return;
    if (!crossing.sure || std::min({spot.u, spot.v, 1.0 - spot.u - spot.v}) < kNearEdge) sure_ = false;
    for (std::size_t i = 0; i < found; ++i) {
      if (std::abs(spots_[i].u - spot.u) + std::abs(spots_[i].v - spot.v) < kNearEdge) return;
    }
    if (found == kMostCrossingsKept) {
      sure_ = false;
      return;
    }
    spots_[found++] = spot;
    winding_ += crossing.slope > 0.0 ? 1 : -1;
  }

  const LoopPatches& patches_;
  const Vector3 point_, step_;
  std::array<LoopSpot, kMostCrossingsKept> spots_;
  bool sure_ = true;
  int winding_ = 0;
};

/// Directions all over the sphere along which no model is built.
Vector3 odd_direction(int i) {
  const double z = std::fmod(0.381966 + 0.7548776662466927 * i, 1.0) * 2.0 - 1.0;
  const double angle = 6.283185307179586 * std::fmod(0.1234 + 0.5698402909980532 * i, 1.0);
  const double rho = std::sqrt(1.0 - z * z);
  return {rho * std::cos(angle), rho * std::sin(angle), z};
}

}  // namespace

bool loop_inside(const LoopPatches& patches, const Vector3& point) {
  if (!patches.closed() || !patches.bounds().contains(point)) return false;
  for (int i = 0; i < kMostDirections; ++i) {
    if (const auto winding = Winding(patches, point, odd_direction(i)).count()) return *winding > 0;
  }
  // Every ray grazes or meets an edge: the point is on the surface, or the surface is a mere sheet there.
  LoopCursor cursor(patches);
  const SurfacePlace place = loop_nearest(patches, point);
  return place.normal.dot(point - place.point) < 0.0;
}

SurfacePlace loop_nearest(const LoopPatches& patches, const Vector3& point) {
  constexpr std::array<std::array<double, 2>, 4> kStarts = {
      {{1.0 / 3.0, 1.0 / 3.0}, {0.1, 0.1}, {0.8, 0.1}, {0.1, 0.8}}};
  LoopCursor cursor(patches), walker(patches);
  LoopSpot best;
  double limit = std::numeric_limits<double>::infinity();
  const auto distance = [&](LoopCursor& at, const LoopSpot& spot) {
    if (!at.go(spot.piece, spot.u, spot.v)) return (point - at.fan().apex).squaredNorm();
    const Vector4 value = evaluate(at.cell().shape, at.s(), at.t()).value;
    return (point - at.cell().origin - vector3(value)).squaredNorm();
  };
  patches.tree().nearest(point, limit, [&](std::uint32_t piece) {
    const LoopPatches::Slab& slab = patches.slab(piece);
    const double height = Vector3(slab.axis[0], slab.axis[1], slab.axis[2]).dot(point - patches.centre());
    const double apart = std::max({height - slab.hi, slab.lo - height, 0.0}) * (1.0 - 1e-6);
    if (apart * apart >= limit) return limit;
    LoopSpot start;
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [u, v] : kStarts) {
      const double here = distance(cursor, {piece, u, v});
      if (here < nearest) {
        nearest = here;
        start = {piece, u, v};
      }
    }
    const LoopSpot foot = loop_projection(patches, walker, start, point);
    const double here = distance(walker, foot);
    if (here < limit) {
      limit = here;
      best = foot;
    }
    return limit;
  });
  return loop_place(cursor, patches, best);
}

}  // namespace icome::geometry
