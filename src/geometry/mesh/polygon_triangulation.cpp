#include "geometry/mesh/polygon_triangulation.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace icome::geometry {
namespace {

/// Twice the signed area of the triangle a, b, c; positive when counter-clockwise.
double cross(const Vector2& a, const Vector2& b, const Vector2& c) {
  const Vector2 u = b - a;
  const Vector2 v = c - a;
  return u.x() * v.y() - u.y() * v.x();
}

/// The polygon seen along its normal (Newell), counter-clockwise, by leaving out the coordinate that the
/// normal is closest to: exact, unlike a rotation into the plane.
std::vector<Vector2> flatten(std::span<const Vector3> corners) {
  Vector3 normal = Vector3::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i)
    normal += (corners[i] - corners[0]).cross(corners[(i + 1) % corners.size()] - corners[0]);
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  int first = (axis + 1) % 3;
  int second = (axis + 2) % 3;
  if (normal[axis] < 0.0) std::swap(first, second);
  std::vector<Vector2> flat;
  flat.reserve(corners.size());
  for (const Vector3& corner : corners) flat.emplace_back(corner[first], corner[second]);
  return flat;
}

/// The most times that all corners are judged anew: a few are enough for polygons that do not cross
/// themselves, and the limit bounds the time for those that do.
constexpr int kMaximumReviews = 32;

/// Cuts ears off a polygon, kept as a ring of the corners not yet cut. The worth of each corner as an ear
/// is cached. Cutting one changes that of its two neighbours, and may free a corner further away that it
/// blocked; those are searched for only when no ear is known, so that the whole takes O(n^2).
class EarClipper {
 public:
  explicit EarClipper(std::vector<Vector2> points) : points_(std::move(points)), left_(points_.size()) {
    ring_.resize(left_);
    for (std::uint32_t i = 0; i < left_; ++i) {
      ring_[i].previous = i == 0 ? static_cast<std::uint32_t>(left_) - 1 : i - 1;
      ring_[i].next = i + 1 == left_ ? 0 : i + 1;
    }
    for (std::uint32_t i = 0; i < left_; ++i) ring_[i].worth = worth(i);
  }

  void run(std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::uint32_t start = 0;
    while (left_ > 3) {
      std::uint32_t ear = best_ear(start);
      if (ring_[ear].worth < 0.0 && reviews_ < kMaximumReviews) {
        review(start);
        ear = best_ear(start);
      }
      start = cut(ear, triangles);
    }
    triangles.push_back({ring_[start].previous, start, ring_[start].next});
  }

 private:
  struct Corner {
    std::uint32_t previous;
    std::uint32_t next;
    double worth;
  };

  /// The quality of the triangle cut off at this corner: 2 * area / longest edge^2 for an ear. Corners
  /// that are no ear rank below every ear: straight ones at -1, convex ones with a corner inside at -2,
  /// reflex ones at -3. They are cut only when a polygon that crosses itself leaves no choice.
  double worth(std::uint32_t corner) const {
    const Vector2& a = points_[ring_[corner].previous];
    const Vector2& b = points_[corner];
    const Vector2& c = points_[ring_[corner].next];
    const double area = cross(a, b, c);
    if (!(area > 0.0)) return area < 0.0 ? -3.0 : -1.0;
    if (holds_a_corner(corner)) return -2.0;
    return area / std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  }

  void review(std::uint32_t start) {
    ++reviews_;
    std::uint32_t i = start;
    do {
      ring_[i].worth = worth(i);
      i = ring_[i].next;
    } while (i != start);
  }

  /// Does the polygon touch the tip of this ear once more, and enter the ear there?
  bool enters_at_tip(std::uint32_t twin, const Vector2& a, const Vector2& tip, const Vector2& c) const {
    for (const std::uint32_t i : {ring_[twin].previous, ring_[twin].next})
      if (cross(a, tip, points_[i]) > 0.0 && cross(tip, c, points_[i]) > 0.0) return true;
    return false;
  }

  /// Does any other corner lie in the triangle that cutting `corner` gives? Those on its border count.
  /// Corners at the same place as one of its own (the two ends of a bridge) do not, unless at the tip.
  bool holds_a_corner(std::uint32_t corner) const {
    const std::uint32_t first = ring_[corner].previous;
    const std::uint32_t last = ring_[corner].next;
    const Vector2& a = points_[first];
    const Vector2& b = points_[corner];
    const Vector2& c = points_[last];
    for (std::uint32_t i = ring_[last].next; i != first; i = ring_[i].next) {
      const Vector2& p = points_[i];
      if (p == b && enters_at_tip(i, a, b, c)) return true;
      if (p == a || p == b || p == c) continue;
      if (cross(a, b, p) >= 0.0 && cross(b, c, p) >= 0.0 && cross(c, a, p) >= 0.0) return true;
    }
    return false;
  }

  std::uint32_t best_ear(std::uint32_t start) const {
    std::uint32_t best = start;
    for (std::uint32_t i = ring_[start].next; i != start; i = ring_[i].next)
      if (ring_[i].worth > ring_[best].worth) best = i;
    return best;
  }

  /// Cuts the corner off; returns a corner that is left.
  std::uint32_t cut(std::uint32_t corner, std::vector<std::array<std::uint32_t, 3>>& triangles) {
    const std::uint32_t previous = ring_[corner].previous;
    const std::uint32_t next = ring_[corner].next;
    triangles.push_back({previous, corner, next});
    ring_[previous].next = next;
    ring_[next].previous = previous;
    --left_;
    ring_[previous].worth = worth(previous);
    ring_[next].worth = worth(next);
    return next;
  }

  std::vector<Vector2> points_;
  std::vector<Corner> ring_;
  std::size_t left_;
  int reviews_ = 0;
};

}  // namespace

void triangulate_polygon(std::span<const Vector3> corners,
                         std::vector<std::array<std::uint32_t, 3>>& triangles) {
  assert(corners.size() >= 3 && corners.size() <= kMaximumPolygonCorners);
  if (corners.size() == 3)
    triangles.push_back({0, 1, 2});
  else
    EarClipper(flatten(corners)).run(triangles);
}

}  // namespace icome::geometry
