#include "geometry/sweep/outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "geometry/mesh/polygon_triangulation.h"

namespace icome::geometry {
namespace {

using Triangle = TriangleMesh::Triangle;

/// Positive where a, b, c run counter-clockwise.
double side_of(const Vector2& a, const Vector2& b, const Vector2& c) {
  const Vector2 u = b - a;
  const Vector2 v = c - a;
  return u.x() * v.y() - u.y() * v.x();
}

/// Does the point lie on the segment from a to b, its ends included? Precondition: it lies on the line.
bool lies_between(const Vector2& a, const Vector2& b, const Vector2& point) {
  return (point - a).dot(point - b) <= 0.0;
}

/// Do two line segments share a point that is no end of the first?
bool blocks_bridge(const Vector2& a, const Vector2& b, const Vector2& from, const Vector2& to) {
  for (const Vector2& end : {from, to}) {
    if (end != a && end != b && side_of(a, b, end) == 0.0 && lies_between(a, b, end)) return true;
  }
  const double from_side = side_of(a, b, from), to_side = side_of(a, b, to);
  const double a_side = side_of(from, to, a), b_side = side_of(from, to, b);
  return from_side * to_side < 0.0 && a_side * b_side < 0.0;
}

std::vector<Vector2> all_corners(const Outline& outline) {
  std::vector<Vector2> corners = outline.rim;
  for (const auto& hole : outline.holes) corners.insert(corners.end(), hole.begin(), hole.end());
  return corners;
}

base::Result<void> check_rings(const Outline& outline) {
  std::size_t all = outline.rim.size() + 2 * outline.holes.size();
  bool has_area = outline.rim.size() >= 3;
  for (const auto& hole : outline.holes) {
    all += hole.size();
    has_area = has_area && hole.size() >= 3;
  }
  if (!has_area) return base::fail("an outline and its holes need 3 corners each; leave out the others");
  if (all > kMaximumPolygonCorners)
    return base::fail(fmt::format("an outline has {} corners with those of its holes; use {} at most", all,
                                  kMaximumPolygonCorners));
  const std::vector<Vector2> corners = all_corners(outline);
  if (!std::all_of(corners.begin(), corners.end(), [](const Vector2& it) { return it.allFinite(); }))
    return base::fail("the corners of an outline must be finite; give others");
  return {};
}

/// Makes one ring of the rim and the holes, hole after hole from the right.
class OutlineBridging {
 public:
  explicit OutlineBridging(const Outline& outline)
      : corners_(all_corners(outline)), ring_(outline.rim.size()) {
    std::iota(ring_.begin(), ring_.end(), 0U);
    auto first = std::uint32_t(outline.rim.size());
    for (const auto& hole : outline.holes) {
      Hole it{first, std::uint32_t(hole.size()), first};
      for (std::uint32_t i = first; i < first + hole.size(); ++i) {
        if (further_right(i, it.rightmost)) it.rightmost = i;
      }
      holes_.push_back(it);
      first += std::uint32_t(hole.size());
    }
    std::stable_sort(holes_.begin(), holes_.end(), [&](const Hole& one, const Hole& other) {
      return further_right(one.rightmost, other.rightmost);
    });
  }

  /// The ring, as numbers of corners; nothing where a hole cannot be joined.
  std::optional<std::vector<std::uint32_t>> run() {
    for (next_ = 0; next_ < holes_.size(); ++next_) {
      const auto place = bridge_to(holes_[next_].rightmost);
      if (!place) return std::nullopt;
      join(holes_[next_], *place);
    }
    return std::move(ring_);
  }

  const std::vector<Vector2>& corners() const { return corners_; }

 private:
  struct Hole {
    std::uint32_t first, size, rightmost;
  };

  bool further_right(std::uint32_t one, std::uint32_t other) const {
    const Vector2 &a = corners_[one], &b = corners_[other];
    return std::pair(a.x(), a.y()) > std::pair(b.x(), b.y());
  }

  const Vector2& at(std::size_t place) const { return corners_[ring_[place % ring_.size()]]; }

  /// The place in the ring of the nearest corner that a straight bridge from the hole can reach.
  std::optional<std::size_t> bridge_to(std::uint32_t from) const {
    const Vector2& start = corners_[from];
    std::vector<std::pair<double, std::size_t>> nearest;
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      if (at(i).x() >= start.x()) nearest.emplace_back((at(i) - start).squaredNorm(), i);
    }
    std::sort(nearest.begin(), nearest.end());
    for (const auto& [distance, place] : nearest) {
      if (opens_towards(place, start) && is_free(start, at(place))) return place;
    }
    return std::nullopt;
  }

  /// Does the way from a corner of the ring to the point begin inside?
  bool opens_towards(std::size_t place, const Vector2& point) const {
    const Vector2 &corner = at(place), &before = at(place + ring_.size() - 1), &after = at(place + 1);
    if (side_of(before, corner, after) > 0.0)
      return side_of(corner, point, before) > 0.0 && side_of(point, corner, after) > 0.0;
    return !(side_of(corner, point, after) >= 0.0 && side_of(point, corner, before) >= 0.0);
  }

  bool is_free(const Vector2& start, const Vector2& end) const {
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      if (blocks_bridge(start, end, at(i), at(i + 1))) return false;
    }
    for (std::size_t h = next_; h < holes_.size(); ++h) {
      const Hole& hole = holes_[h];
      for (std::uint32_t i = 0; i < hole.size; ++i) {
        if (blocks_bridge(start, end, corners_[hole.first + i], corners_[hole.first + (i + 1) % hole.size]))
          return false;
      }
    }
    return true;
  }

  void join(const Hole& hole, std::size_t place) {
    std::vector<std::uint32_t> detour;
    for (std::uint32_t i = 0; i <= hole.size; ++i)
      detour.push_back(hole.first + (hole.rightmost - hole.first + i) % hole.size);
    detour.push_back(ring_[place]);
    ring_.insert(ring_.begin() + std::ptrdiff_t(place) + 1, detour.begin(), detour.end());
  }

  std::vector<Vector2> corners_;
  std::vector<std::uint32_t> ring_;
  std::vector<Hole> holes_;
  std::size_t next_ = 0;  // of the holes that are joined or left
};

void add_outline_walls(std::uint32_t first, std::uint32_t size, std::uint32_t back, TriangleMesh& mesh) {
  for (std::uint32_t i = 0; i < size; ++i) {
    const std::uint32_t a = first + i, b = first + (i + 1) % size;
    mesh.triangles.push_back({back + a, back + b, b});
    mesh.triangles.push_back({back + a, b, a});
  }
}

}  // namespace

base::Result<void> triangulate(const Outline& outline, std::vector<Triangle>& triangles) {
  if (const auto good = check_rings(outline); !good) return tl::unexpected(good.error());
  OutlineBridging bridging(outline);
  const auto ring = bridging.run();
  if (!ring) return base::fail("a hole of an outline is not within its rim; draw it so that it is");
  std::vector<Vector3> corners;
  corners.reserve(ring->size());
  for (const std::uint32_t corner : *ring)
    corners.emplace_back(bridging.corners()[corner].x(), bridging.corners()[corner].y(), 0.0);
  std::vector<Triangle> cut;
  triangulate_polygon(corners, cut);
  for (const auto& [a, b, c] : cut) triangles.push_back({(*ring)[a], (*ring)[b], (*ring)[c]});
  return {};
}

base::Result<TriangleMesh> solid_of_outlines(std::span<const Outline> outlines, double depth) {
  TriangleMesh mesh;
  for (const Outline& outline : outlines) {
    std::vector<Triangle> front;
    if (const auto cut = triangulate(outline, front); !cut) return tl::unexpected(cut.error());
    const std::vector<Vector2> corners = all_corners(outline);
    const auto first = std::uint32_t(mesh.positions.size()), back = std::uint32_t(corners.size());
    for (const Vector2& it : corners) mesh.positions.emplace_back(it.x(), it.y(), 0.5 * depth);
    for (const auto& [a, b, c] : front) mesh.triangles.push_back({first + a, first + b, first + c});
    if (depth == 0.0) continue;
    for (const Vector2& it : corners) mesh.positions.emplace_back(it.x(), it.y(), -0.5 * depth);
    const std::uint32_t behind = first + back;
    for (const auto& [a, b, c] : front) mesh.triangles.push_back({behind + a, behind + c, behind + b});
    std::uint32_t ring = first;
    add_outline_walls(ring, std::uint32_t(outline.rim.size()), back, mesh);
    ring += std::uint32_t(outline.rim.size());
    for (const auto& hole : outline.holes) {
      add_outline_walls(ring, std::uint32_t(hole.size()), back, mesh);
      ring += std::uint32_t(hole.size());
    }
  }
  return mesh;
}

}  // namespace icome::geometry
