#include "geometry/implicit_way_out.h"

#include <algorithm>
#include <array>

#include "geometry/implicit_entry.h"
#include "geometry/implicit_walk.h"

namespace icome::geometry {
namespace {

constexpr int kRays = 26;
constexpr int kFollowed = 6;  // of the nearest hits

/// A place where a ray leaves the solid.
struct Hit {
  Vector3 point;
  double distance;
};

}  // namespace

std::optional<SurfacePoint> implicit_way_out(const Formula& formula, const Bounds& box, const Vector3& point,
                                             double time) {
  const double size = box.diagonal().norm();
  const ImplicitWalk walk(formula, time, size);
  std::array<Hit, kRays> hits;
  int count = 0;
  double horizon = size;
  for (int i = 0; i < 27; ++i) {
    if (i == 13) continue;  // the direction (0, 0, 0)
    const Vector3 way = Vector3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1).normalized() * horizon;
    // 1e-11 of the size: contact arithmetic's usual slack.
    const auto s = first_crossing(formula, {point, way, 0.0, 1.0, time, 1e-11 * size, true, false});
    if (!s) continue;
    const Vector3 end = point + *s * way;
    if (!box.contains(end)) continue;
    hits[static_cast<std::size_t>(count++)] = {end, *s * horizon};
    // A ray that is three times as long as the shortest one does not lead to the nearest place.
    horizon = std::min(horizon, 3.0 * *s * horizon);
  }
  const auto last = hits.begin() + count;
  const auto followed = hits.begin() + std::min(count, kFollowed);
  std::partial_sort(hits.begin(), followed, last,
                    [](const Hit& a, const Hit& b) { return a.distance < b.distance; });
  std::optional<SurfacePoint> nearest;
  const auto offer = [&](const ImplicitWalk::Place& place) {
    if (!box.contains(place.point)) return;
    const double distance = (place.point - point).squaredNorm();
    if (nearest && !(distance < (nearest->point - point).squaredNorm())) return;
    nearest = SurfacePoint{place.point, place.normal};
  };
  if (const auto settled = walk.settle(point, size)) offer(walk.descend(settled->point, point));
  for (auto hit = hits.begin(); hit != followed; ++hit) {
    offer({hit->point, walk.normal(hit->point).value_or((hit->point - point).stableNormalized())});
    offer(walk.descend(hit->point, point));
  }
  return nearest;
}

}  // namespace icome::geometry
