#include "geometry/mesh/mesh_sheets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace icome::geometry {
namespace {

/// An edge of a triangle, from its corner `from` to the next.
struct SheetEdge {
  std::uint32_t low, high;  // its vertices
  std::uint32_t triangle;
  std::uint8_t from;
  bool rising;  // runs from `low` to `high`
};

class SheetSeparator {
 public:
  explicit SheetSeparator(const TriangleMesh& mesh) : mesh_(mesh), sheet_(3 * mesh.triangles.size()) {
    std::iota(sheet_.begin(), sheet_.end(), 0U);
  }

  TriangleMesh separated() {
    std::vector<SheetEdge> edges = sorted_edges();
    for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
      while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high) ++end;
      join_around({edges.begin() + std::ptrdiff_t(i), edges.begin() + std::ptrdiff_t(end)});
    }
    return numbered();
  }

 private:
  std::vector<SheetEdge> sorted_edges() const {
    std::vector<SheetEdge> edges;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (std::uint8_t i = 0; i < 3; ++i) {
        const std::uint32_t a = mesh_.triangles[t][i], b = mesh_.triangles[t][(i + 1) % 3];
        edges.push_back({std::min(a, b), std::max(a, b), t, i, a < b});
      }
    }
    std::sort(edges.begin(), edges.end(), [](const SheetEdge& a, const SheetEdge& b) {
      return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    return edges;
  }

  /// Going round the edge, solid begins behind a triangle of the one direction and ends at the next of the
  /// other.
  void join_around(std::vector<SheetEdge> edges) {
    if (edges.size() == 2) return join(edges[0], edges[1]);
    const Vector3 origin = mesh_.positions[edges[0].low];
    const Vector3 axis = (mesh_.positions[edges[0].high] - origin).normalized();
    const Vector3 u = axis.unitOrthogonal(), v = axis.cross(u);
    std::vector<std::pair<double, SheetEdge>> around;
    for (const SheetEdge& edge : edges) {
      const Vector3 arm = mesh_.corner(edge.triangle, (edge.from + 2U) % 3U) - origin;
      around.emplace_back(std::atan2(v.dot(arm), u.dot(arm)), edge);
    }
    std::sort(around.begin(), around.end(), [](const auto& a, const auto& b) {
      return std::tie(a.first, a.second.triangle) < std::tie(b.first, b.second.triangle);
    });
    // Paired like brackets: a falling edge's triangle has its solid ahead, a rising one's behind it.
    std::vector<SheetEdge> begun;
    for (std::size_t i = 0; i < 2 * around.size(); ++i) {
      SheetEdge& edge = around[i % around.size()].second;
      if (edge.triangle == kTaken) continue;
      if (!edge.rising && i < around.size()) begun.push_back(edge);
      if (!edge.rising || begun.empty()) continue;
      join(begun.back(), edge);
      begun.pop_back();
      edge.triangle = kTaken;
    }
  }

  void join(const SheetEdge& one, const SheetEdge& other) {
    unite(corner(one, one.low), corner(other, other.low));
    unite(corner(one, one.high), corner(other, other.high));
  }

  std::uint32_t corner(const SheetEdge& edge, std::uint32_t vertex) const {
    const bool first = mesh_.triangles[edge.triangle][edge.from] == vertex;
    return 3 * edge.triangle + (first ? edge.from : (edge.from + 1U) % 3U);
  }

  std::uint32_t find(std::uint32_t corner) {
    while (sheet_[corner] != corner) corner = sheet_[corner] = sheet_[sheet_[corner]];
    return corner;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    sheet_[high] = low;
  }

  TriangleMesh numbered() {
    TriangleMesh result;
    std::vector<std::uint32_t> number(sheet_.size());
    result.triangles.resize(mesh_.triangles.size());
    for (std::uint32_t c = 0; c < sheet_.size(); ++c) {
      const std::uint32_t first = find(c);
      if (first == c) {
        number[c] = std::uint32_t(result.positions.size());
        result.positions.push_back(mesh_.positions[mesh_.triangles[c / 3][c % 3]]);
      }
      result.triangles[c / 3][c % 3] = number[first];
    }
    return result;
  }

  static constexpr std::uint32_t kTaken = ~std::uint32_t{0};

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> sheet_;  // by corner: another that shares its vertex; itself for the lowest
};

}  // namespace

TriangleMesh separate_sheets(const TriangleMesh& mesh) { return SheetSeparator(mesh).separated(); }

}  // namespace icome::geometry
