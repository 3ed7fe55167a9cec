#include "haptics/judge/plain_loop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

namespace icome::haptics {
namespace {

using base::Vector3;
using geometry::TriangleMesh;

constexpr double kEnough = 1e-6;  // of the size
constexpr std::size_t kMostTriangles = 800'000;
constexpr double kLeftOver = 0.5;  // of the last change: all further ones come to a third of it, around
                                   // vertices of many edges to somewhat more

/// An edge. Sides are counted as 3 * triangle + i, from corner i to i + 1.
struct LoopEdge {
  std::array<std::uint32_t, 2> ends;   // the lower vertex first
  std::array<std::uint32_t, 2> sides;  // of its triangles
  int triangles;
  bool joined;  // its two triangles go on into each other
  bool sharp;
};

/// A mesh with its creases, and with the vertices that stay in place.
struct SharpMesh {
  TriangleMesh mesh;
  std::vector<std::array<std::uint32_t, 2>> creases;
  std::vector<bool> kept;  // vertices that stay in place

  std::uint32_t corner(std::uint32_t side, std::uint32_t after) const {
    return mesh.triangles[side / 3][(side + after) % 3];
  }
};

std::vector<LoopEdge> edges_of(const SharpMesh& of) {
  std::vector<std::array<std::uint32_t, 3>> sides;  // lower and higher end, side
  for (std::uint32_t side = 0; side < 3 * of.mesh.triangles.size(); ++side) {
    const auto [low, high] = std::minmax({of.corner(side, 0), of.corner(side, 1)});
    sides.push_back({low, high, side});
  }
  std::ranges::sort(sides);
  std::vector<LoopEdge> edges;
  for (const auto& [low, high, side] : sides) {
    if (edges.empty() || edges.back().ends != std::array{low, high})
      edges.push_back({{low, high}, {}, 0, false, true});
    LoopEdge& edge = edges.back();
    if (edge.triangles < 2) edge.sides[std::size_t(edge.triangles)] = side;
    ++edge.triangles;
    edge.joined = edge.triangles == 2 && of.corner(edge.sides[0], 0) != of.corner(edge.sides[1], 0);
    edge.sharp = !edge.joined;
  }
  for (const auto& crease : of.creases) {
    const auto [low, high] = std::minmax(crease[0], crease[1]);
    const auto found = std::ranges::lower_bound(edges, std::array{low, high}, {}, &LoopEdge::ends);
    if (found != edges.end() && found->ends == std::array{low, high}) found->sharp = true;
  }
  return edges;
}

/// Keeps vertices in place in which several fans of triangles meet, or triangles that face different ways.
void keep_pinches(const std::vector<LoopEdge>& edges, SharpMesh& mesh) {
  // Corners that sides join belong to one fan; it is known by the first of them.
  std::vector<std::uint32_t> fan(3 * mesh.mesh.triangles.size());
  std::iota(fan.begin(), fan.end(), 0U);
  const auto first = [&](std::uint32_t corner) {
    while (fan[corner] != corner) corner = fan[corner] = fan[fan[corner]];
    return corner;
  };
  const auto join = [&](std::uint32_t one, std::uint32_t other) { fan[first(one)] = first(other); };
  const auto next = [](std::uint32_t side) { return side / 3 * 3 + (side + 1) % 3; };
  for (const LoopEdge& edge : edges) {
    if (edge.joined) {
      join(edge.sides[0], next(edge.sides[1]));
      join(next(edge.sides[0]), edge.sides[1]);
    } else if (edge.triangles == 2) {
      mesh.kept[edge.ends[0]] = mesh.kept[edge.ends[1]] = true;
    }
  }
  std::vector<int> fans(mesh.kept.size(), 0);
  for (std::uint32_t corner = 0; corner < fan.size(); ++corner) {
    const std::uint32_t vertex = mesh.corner(corner, 0);
    if (first(corner) == corner && ++fans[vertex] > 1) mesh.kept[vertex] = true;
  }
}

/// Loop's rules around the vertices of a mesh.
class LoopRules {
 public:
  LoopRules(const SharpMesh& of, const std::vector<LoopEdge>& edges)
      : of_(of), around_(of.mesh.positions.size()) {
    for (const LoopEdge& edge : edges) {
      for (const std::size_t end : {0U, 1U}) {
        Around& around = around_[edge.ends[end]];
        const Vector3& other = place(edge.ends[1 - end]);
        ++around.neighbours;
        around.sum += other;
        around.sharp += edge.sharp;
        if (edge.sharp) around.sharp_sum += other;
      }
    }
  }

  /// A vertex after one subdivision.
  Vector3 refined(std::uint32_t vertex) const {
    return moved(vertex, 1.0 / 8.0, [](double count) { return beta(count); });
  }
  /// A vertex on the limit surface; where a crease ends within the surface, nearly so.
  Vector3 limit(std::uint32_t vertex) const {
    return moved(vertex, 1.0 / 6.0, [](double count) { return 1.0 / (count + 3.0 / (8.0 * beta(count))); });
  }
  Vector3 middle(const LoopEdge& edge) const {
    const Vector3 ends = place(edge.ends[0]) + place(edge.ends[1]);
    if (edge.sharp) return 0.5 * ends;
    return 0.375 * ends + 0.125 * (place(of_.corner(edge.sides[0], 2)) + place(of_.corner(edge.sides[1], 2)));
  }

 private:
  struct Around {
    int neighbours = 0, sharp = 0;
    Vector3 sum = Vector3::Zero(), sharp_sum = Vector3::Zero();
  };

  const Vector3& place(std::uint32_t vertex) const { return of_.mesh.positions[vertex]; }

  static double beta(double count) {
    const double root = 0.375 + 0.25 * std::cos(2.0 * std::numbers::pi / count);
    return (0.625 - root * root) / count;
  }

  /// The vertex drawn towards each of its neighbours, or towards both along a sharp curve.
  template <typename Weight>
  Vector3 moved(std::uint32_t vertex, double along_curve, Weight&& weight) const {
    const Around& around = around_[vertex];
    const Vector3& old = place(vertex);
    if (around.neighbours == 0 || of_.kept[vertex] || around.sharp > 2) return old;
    if (around.sharp == 2) return old + along_curve * (around.sharp_sum - 2.0 * old);
    const double count = around.neighbours;
    return old + weight(count) * (around.sum - count * old);
  }

  const SharpMesh& of_;
  std::vector<Around> around_;
};

/// The vertices stay the first ones, then come the middles of the edges, in their order.
SharpMesh subdivided(const SharpMesh& mesh, const std::vector<LoopEdge>& edges) {
  const LoopRules rules(mesh, edges);
  const auto count = std::uint32_t(mesh.mesh.positions.size());
  SharpMesh fine;
  for (std::uint32_t vertex = 0; vertex < count; ++vertex)
    fine.mesh.positions.push_back(rules.refined(vertex));
  for (const LoopEdge& edge : edges) fine.mesh.positions.push_back(rules.middle(edge));
  fine.kept = mesh.kept;
  fine.kept.resize(fine.mesh.positions.size(), false);
  std::vector<std::uint32_t> middle_of(3 * mesh.mesh.triangles.size());  // by side
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    const LoopEdge& edge = edges[i];
    for (int k = 0; k < edge.triangles; ++k) middle_of[edge.sides[std::size_t(k)]] = count + i;
    if (edge.joined && edge.sharp) {
      fine.creases.push_back({edge.ends[0], count + i});
      fine.creases.push_back({edge.ends[1], count + i});
    }
  }
  for (std::uint32_t side = 0; side < middle_of.size(); side += 3) {
    const auto& [a, b, c] = mesh.mesh.triangles[side / 3];
    const std::uint32_t ab = middle_of[side], bc = middle_of[side + 1], ca = middle_of[side + 2];
    fine.mesh.triangles.insert(fine.mesh.triangles.end(),
                               {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return fine;
}

std::vector<Vector3> limits(const SharpMesh& mesh, const std::vector<LoopEdge>& edges) {
  const LoopRules rules(mesh, edges);
  std::vector<Vector3> result;
  for (std::uint32_t vertex = 0; vertex < mesh.mesh.positions.size(); ++vertex)
    result.push_back(rules.limit(vertex));
  return result;
}

/// Distance of a place from the planes of an edge's triangles, or from the edge's line where the surface
/// ends there. Along these it may lie anywhere.
double distance_beside(const SharpMesh& mesh, const std::vector<Vector3>& places, const LoopEdge& edge,
                       const Vector3& place) {
  const Vector3 off = place - places[edge.ends[0]];
  const Vector3 along = (places[edge.ends[1]] - places[edge.ends[0]]).stableNormalized();
  if (!edge.joined) return (off - off.dot(along) * along).norm();
  double farthest = 0.0;
  for (const std::uint32_t side : edge.sides) {
    const Vector3 third = places[mesh.corner(side, 2)] - places[edge.ends[0]];
    farthest = std::max(farthest, std::abs(off.dot(along.cross(third).stableNormalized())));
  }
  return farthest;
}

/// Largest distance by which a subdivision takes the limit from the mesh before, with its limits `old`.
double largest_change(const SharpMesh& mesh, const std::vector<LoopEdge>& edges,
                      const std::vector<Vector3>& old, const std::vector<Vector3>& fine) {
  double change = 0.0;
  for (std::size_t i = 0; i < old.size(); ++i) change = std::max(change, (fine[i] - old[i]).norm());
  for (std::size_t i = 0; i < edges.size(); ++i)
    change = std::max(change, distance_beside(mesh, old, edges[i], fine[old.size() + i]));
  return change;
}

}  // namespace

base::Result<PlainLoop> plain_loop(const geometry::ControlMesh& control) {
  SharpMesh mesh{control.mesh, control.creases, std::vector<bool>(control.mesh.positions.size(), false)};
  for (const std::uint32_t corner : control.corners) mesh.kept[corner] = true;
  std::vector<LoopEdge> edges = edges_of(mesh);
  if (std::ranges::any_of(edges, [](const LoopEdge& edge) { return edge.triangles > 2; }))
    return base::fail("more than two triangles of the control mesh meet at an edge");
  if (4 * mesh.mesh.triangles.size() > kMostTriangles)
    return base::fail("the control mesh has too many triangles");
  keep_pinches(edges, mesh);
  std::vector<Vector3> places = limits(mesh, edges);
  double change = 0.0, size = 0.0;
  do {
    SharpMesh fine = subdivided(mesh, edges);
    std::vector<LoopEdge> fine_edges = edges_of(fine);
    std::vector<Vector3> fine_places = limits(fine, fine_edges);
    change = largest_change(mesh, edges, places, fine_places);
    mesh = std::move(fine);
    edges = std::move(fine_edges);
    places = std::move(fine_places);
    size = geometry::bounds({places, mesh.mesh.triangles}).diagonal().norm();
  } while (kLeftOver * change > kEnough * size && 4 * mesh.mesh.triangles.size() <= kMostTriangles);
  mesh.mesh.positions = std::move(places);
  return PlainLoop{std::move(mesh.mesh), kLeftOver * change};
}

}  // namespace icome::haptics
