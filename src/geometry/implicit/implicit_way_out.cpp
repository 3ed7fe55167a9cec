#include "geometry/implicit/implicit_way_out.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/implicit/implicit_crossing.h"
#include "geometry/implicit/implicit_walk.h"

namespace icome::geometry {
namespace {

constexpr int kRays = 26;
constexpr int kFollowed = 6;      // so many of the nearest hits
constexpr double kSlack = 1e-11;  // of the size: contact arithmetic's usual slack

/// A place at which a ray leaves the solid.
struct Hit {
  Vector3 point;
  double distance;
};

/// Gathers places of the surface, and keeps the nearest.
class NearestWayOut {
 public:
  NearestWayOut(const ImplicitPieces& pieces, const Bounds& box, const Vector3& point, double time)
      : pieces_(pieces), box_(box), point_(point), time_(time), size_(box.diagonal().norm()) {}

  /// Offers a place of the surface, and the nearest place of the piece that it lies on.
  void follow(const Vector3& hit) {
    const auto border = pieces_.border_at(hit, time_, kSlack * size_);
    const auto piece = border ? border : pieces_.piece_at(hit, time_);
    if (!piece) return;
    const ImplicitWalk walk = this->walk(*piece);
    const Vector3 out = (hit - point_).stableNormalized();
    offer({hit, walk.normal(hit).value_or(out)}, *piece);
    offer_projection(walk.descend(hit, point_), *piece);
  }

  /// Offers the nearest place of the piece whose function the formula equals at the point.
  void look_straight_up() {
    const auto piece = pieces_.piece_at(point_, time_);
    if (!piece) return;
    const ImplicitWalk walk = this->walk(*piece);
    if (const auto settled = walk.settle(point_, size_)) {
      offer_projection(walk.descend(settled->point, point_), *piece);
    }
  }

  std::optional<ImplicitWayOut> nearest() const {
    if (!std::isfinite(distance_)) return std::nullopt;
    return nearest_;
  }

 private:
  ImplicitWalk walk(std::size_t piece) const { return {pieces_.formula(piece), time_, size_}; }

  void offer_projection(const ImplicitWalk::Place& place, std::size_t piece) {
    if (pieces_.covers(piece, place.point, place.normal, time_, kSlack * size_)) offer(place, piece);
  }

  void offer(const ImplicitWalk::Place& place, std::size_t piece) {
    if (!box_.contains(place.point)) return;
    const double distance = (place.point - point_).norm();
    if (!(distance < distance_)) return;
    distance_ = distance;
    nearest_ = {{place.point, place.normal}, piece};
  }

  const ImplicitPieces& pieces_;
  const Bounds& box_;
  const Vector3& point_;
  const double time_;
  const double size_;
  ImplicitWayOut nearest_ = {{Vector3::Zero(), Vector3::Zero()}, 0};
  double distance_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::optional<ImplicitWayOut> implicit_way_out(const ImplicitPieces& pieces, const Bounds& box,
                                               const Vector3& point, double time) {
  const double size = box.diagonal().norm();
  std::array<Hit, kRays> hits;
  int count = 0;
  double horizon = size;
  for (int i = 0; i < 27; ++i) {
    if (i == 13) continue;  // the direction (0, 0, 0)
    const Vector3 way = Vector3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1).normalized() * horizon;
    const auto s = first_crossing(pieces.whole(), {point, way, 0.0, 1.0, time, kSlack * size, true, false});
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
  NearestWayOut search(pieces, box, point, time);
  search.look_straight_up();
  for (auto hit = hits.begin(); hit != followed; ++hit) search.follow(hit->point);
  return search.nearest();
}

}  // namespace icome::geometry
