#include "geometry/sweep/outline_extrusion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "geometry/mesh/mesh_repair.h"

namespace icome::geometry {
namespace {

using base::Result;
using Triangle = TriangleMesh::Triangle;

/// The share by which the area of a cap may differ from that of its outline.
constexpr double kSameArea = 1e-9;

double ring_area(const std::vector<Vector2>& ring) {
  double doubled = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2 a = ring[i] - ring[0];
    const Vector2 b = ring[(i + 1) % ring.size()] - ring[0];
    doubled += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * doubled;
}

/// The outline with the corners that its sweeps have: see checked_profile().
Result<Outline> checked_outline(const Outline& outline) {
  Outline checked;
  const auto rim = checked_profile({outline.rim});
  if (!rim) return tl::unexpected(rim.error());
  checked.rim = rim->points;
  for (std::size_t i = 0; i < outline.holes.size(); ++i) {
    const auto hole = checked_profile({outline.holes[i]});
    if (!hole) return base::fail(fmt::format("hole {}: {}", i + 1, hole.error().message));
    checked.holes.push_back(hole->points);
    std::ranges::reverse(checked.holes.back());
  }
  return checked;
}

/// The flat piece of the plane; its vertices are the corners of the rim, then those of the holes.
Result<TriangleMesh> cap_of(const Outline& outline) {
  TriangleMesh cap;
  double area = ring_area(outline.rim);
  for (const Vector2& it : outline.rim) cap.positions.emplace_back(it.x(), it.y(), 0.0);
  for (const auto& hole : outline.holes) {
    area += ring_area(hole);
    for (const Vector2& it : hole) cap.positions.emplace_back(it.x(), it.y(), 0.0);
  }
  if (const auto cut = triangulate(outline, cap.triangles); !cut) return tl::unexpected(cut.error());
  double covered = 0.0;
  for (const auto& [a, b, c] : cap.triangles) {
    const Vector3 normal = (cap.positions[b] - cap.positions[a]).cross(cap.positions[c] - cap.positions[a]);
    covered += 0.5 * std::abs(normal.z());
  }
  if (!(std::abs(covered - area) <= kSameArea * ring_area(outline.rim)))
    return base::fail("the holes of the profile cross or touch its rim or one another; keep them apart");
  TriangleMesh repaired = cap;
  repair(repaired);
  const bool is_whole =
      repaired.positions.size() == cap.positions.size() && repaired.triangles.size() == cap.triangles.size();
  return is_whole ? repaired : cap;
}

/// Finds vertices of walls by their places, which the caps share to the last bit.
class WallVertices {
 public:
  /// `latest`: of several vertices at one place the last one counts, else the first.
  WallVertices(const TriangleMesh& walls, bool latest) {
    for (std::uint32_t i = 0; i < walls.positions.size(); ++i) {
      const auto [at, is_new] = numbers_.emplace(key(walls.positions[i]), i);
      if (latest && !is_new) at->second = i;
    }
  }

  std::optional<std::uint32_t> at(const Vector3& place) const {
    const auto found = numbers_.find(key(place));
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  using Key = std::tuple<double, double, double>;
  static Key key(const Vector3& place) { return {place.x(), place.y(), place.z()}; }

  std::map<Key, std::uint32_t> numbers_;
};

/// Does a triangle run from one vertex to the other along its edge?
bool has_edge(const std::vector<Triangle>& triangles, std::uint32_t from, std::uint32_t to) {
  return std::ranges::any_of(triangles, [&](const Triangle& it) {
    for (std::size_t k = 0; k < 3; ++k)
      if (it[k] == from && it[(k + 1) % 3] == to) return true;
    return false;
  });
}

/// Do the walls run around the rim of an end as its corners do? Its edges on the axis of a turn have no
/// walls.
bool runs_along(const TriangleMesh& walls, std::span<const std::uint32_t> rim) {
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const std::uint32_t from = rim[i], to = rim[(i + 1) % rim.size()];
    if (has_edge(walls.triangles, from, to)) return true;
    if (has_edge(walls.triangles, to, from)) return false;
  }
  return false;
}

/// Fills an end of the walls with the cap, the first corners of which are its rim; false where the corners
/// are not all there, each by itself.
bool add_cap(const TriangleMesh& cap, const Affine3& place, std::size_t rim, bool last, TriangleMesh& walls) {
  const WallVertices vertices(walls, last);
  std::vector<std::uint32_t> numbers;
  for (const Vector3& corner : cap.positions) {
    const auto number = vertices.at(place * corner);
    if (!number) return false;
    numbers.push_back(*number);
  }
  if (std::set(numbers.begin(), numbers.end()).size() != numbers.size()) return false;
  const bool turned = runs_along(walls, std::span(numbers).first(rim));
  for (const auto& [a, b, c] : cap.triangles) {
    const Triangle triangle = {numbers[a], numbers[b], numbers[c]};
    walls.triangles.push_back(turned ? Triangle{triangle[0], triangle[2], triangle[1]} : triangle);
  }
  return true;
}

}  // namespace

Result<TriangleMesh> extrude_outline(const Outline& outline, std::span<const SweepStep> steps,
                                     ExtrusionEnds ends) {
  if (outline.holes.empty()) return extrude({outline.rim}, steps, ends);
  const auto checked = checked_outline(outline);
  if (!checked) return tl::unexpected(checked.error());
  const auto cap = cap_of(*checked);
  if (!cap) return tl::unexpected(cap.error());
  const bool capped = ends == ExtrusionEnds::Capped;
  if (capped)  // some sweeps leave no room for caps, of a rim without holes either
    if (const auto solid = extrude({checked->rim}, steps, ends); !solid) return solid;
  const ExtrusionEnds ends_of_walls = capped ? ExtrusionEnds::Open : ends;
  auto walls = extrude({checked->rim}, steps, ends_of_walls);
  if (!walls) return walls;
  for (const std::vector<Vector2>& hole : checked->holes) {
    auto wall = extrude({hole}, steps, ends_of_walls);
    if (!wall) return wall;
    for (Triangle& triangle : wall->triangles) std::swap(triangle[1], triangle[2]);
    append(*walls, *wall);
  }
  if (!capped) return walls;
  SweepWalk walk(steps);
  while (walk.next()) {
  }
  const std::size_t rim = checked->rim.size();
  if (!add_cap(*cap, Affine3::Identity(), rim, false, *walls) ||
      !add_cap(*cap, walk.place(), rim, true, *walls))
    return base::fail("a profile with holes cannot be swept to a point or a line; scale it less");
  return walls;
}

}  // namespace icome::geometry
