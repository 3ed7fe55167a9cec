#include "geometry/sweep/section_weld.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace icome::geometry {
namespace {

/// Gives one section its vertices.
class SectionWelder {
 public:
  SectionWelder(SweepSection& section, const SweepSection& before, double tolerance,
                std::vector<Vector3>& positions)
      : section_(section), before_(before), tolerance_(tolerance), positions_(positions) {
    section_.vertices.assign(section_.points.size(), 0);
  }

  /// Unites corners with their own vertices in the section before, or else with their neighbours.
  void weld_neighbours(bool open) {
    const std::size_t count = section_.points.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (stays(i, before_.vertices[i])) continue;
      if (i > 0 && stays(i, section_.vertices[i - 1])) continue;
      if (!open && i + 1 == count && stays(i, section_.vertices[0])) continue;
      section_.vertices[i] = add(section_.points[i]);
    }
  }

  /// Unites corners wherever they meet on the line.
  void weld_along(const Vector3& direction) {
    const std::size_t count = section_.points.size();
    std::vector<double> places(count);
    for (std::size_t i = 0; i < count; ++i)
      places[i] = (section_.points[i] - section_.points[0]).dot(direction);
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(places[a], a) < std::pair(places[b], b);
    });
    for (std::size_t first = 0; first < count;) {
      std::size_t end = first + 1;
      while (end < count && places[order[end]] - places[order[first]] <= tolerance_) ++end;
      unite(std::span(order).subspan(first, end - first));
      first = end;
    }
  }

 private:
  /// Gives the corner the vertex if it lies there; false if it does not.
  bool stays(std::size_t corner, std::uint32_t vertex) {
    if ((section_.points[corner] - positions_[vertex]).norm() > tolerance_) return false;
    section_.vertices[corner] = vertex;
    return true;
  }

  std::uint32_t add(const Vector3& point) {
    positions_.push_back(point);
    return static_cast<std::uint32_t>(positions_.size() - 1);
  }

  void unite(std::span<const std::size_t> corners) {
    const auto kept = std::find_if(corners.begin(), corners.end(),
                                   [&](std::size_t i) { return stays(i, before_.vertices[i]); });
    const std::uint32_t vertex =
        kept != corners.end() ? section_.vertices[*kept] : add(section_.points[corners.front()]);
    for (const std::size_t i : corners) section_.vertices[i] = vertex;
  }

  SweepSection& section_;
  const SweepSection& before_;
  double tolerance_;
  std::vector<Vector3>& positions_;
};

/// Does the outline run along each of its edges once each way?
bool meets_in_pairs(const std::vector<std::uint32_t>& outline) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Edge> forth;
  std::vector<Edge> back;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::uint32_t a = outline[i];
    const std::uint32_t b = outline[(i + 1) % outline.size()];
    if (a == b) continue;
    forth.emplace_back(a, b);
    back.emplace_back(b, a);
  }
  std::sort(forth.begin(), forth.end());
  std::sort(back.begin(), back.end());
  return forth == back && std::adjacent_find(forth.begin(), forth.end()) == forth.end();
}

}  // namespace

SectionShape weld_section(SweepSection& section, const SweepSection& before, bool open, double tolerance,
                          std::vector<Vector3>& positions) {
  SectionWelder welder(section, before, tolerance, positions);
  const std::optional<Vector3> line = common_line(section.points, tolerance);
  if (!line || (open && !line->isZero(0.0))) {
    welder.weld_neighbours(open);
    return SectionShape::Whole;
  }
  welder.weld_along(*line);
  if (line->isZero(0.0)) return SectionShape::Point;
  return meets_in_pairs(section.vertices) ? SectionShape::Line : SectionShape::Ragged;
}

int meeting_corner(std::span<const Vector3> first, std::span<const Vector3> last, bool open, double reach) {
  const std::size_t count = first.size();
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t shift = 0; shift < (open ? 1 : count); ++shift) {
    double farthest = 0.0;
    for (std::size_t i = 0; i < count && farthest <= reach; ++i)
      farthest = std::max(farthest, (last[i] - first[(i + shift) % count]).norm());
    if (farthest > reach || !(farthest < least)) continue;
    least = farthest;
    best = static_cast<int>(shift);
  }
  return best;
}

}  // namespace icome::geometry
