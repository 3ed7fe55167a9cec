#include "haptics/shapes/mesh_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "base/parallel.h"
#include "geometry/mesh/mesh_topology.h"

namespace icome::haptics {
namespace {

using base::Vector3;
using geometry::TriangleMesh;

constexpr std::size_t kFeatureGrain = 1 << 14;
constexpr double kFlat = 1e-10;  // rad: faces reach over the wedge between them, their rims being as wide
// rad: no ball comes to the bottom of a crack as narrow as this, but where the surface passes through itself
// one may come to its edge from the other side.
constexpr double kFoldedBack = 2.7;
constexpr double kBendNoise = 2e-15;      // rad, of a bend over an edge as long as its triangles are high
constexpr std::size_t kMostConvex = 24;   // edges at a corner: with more the corner is always kept
constexpr std::size_t kFewestConvex = 3;  // of a corner away from rims
constexpr unsigned kFrontBit = 1, kBackBit = 2;  // the sides on which an edge is convex

/// The triangles at each vertex.
class Incidence {
 public:
  explicit Incidence(const TriangleMesh& mesh)
      : first_(mesh.positions.size() + 1, 0), triangles_(3 * mesh.triangles.size()) {
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t vertex : triangle) ++first_[vertex + 1];
    }
    for (std::size_t vertex = 1; vertex < first_.size(); ++vertex) first_[vertex] += first_[vertex - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      for (const std::uint32_t vertex : mesh.triangles[i]) triangles_[next[vertex]++] = i;
    }
  }

  std::span<const std::uint32_t> at(std::uint32_t vertex) const {
    return std::span(triangles_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> triangles_;
};

/// Bends of the surface over the edges of each triangle and at each vertex.
class Bends {
 public:
  explicit Bends(const TriangleMesh& mesh)
      : mesh_(mesh), neighbours_(geometry::edge_neighbours(mesh)), incidence_(mesh) {
    find_edges();
    find_corners();
  }

  /// Every shared feature goes to the first of its triangles.
  MeshFeatures features(std::uint32_t triangle) const {
    unsigned front = 0, both = 0;
    const auto add = [&](unsigned sides, unsigned bit) {
      if (sides & kFrontBit) front |= bit;
      if (sides != 0) both |= bit;
    };
    for (unsigned which = 0; which < 3; ++which) {
      // kNoTriangle is larger than all.
      if (neighbours_[triangle][which] > triangle) add(edges_[triangle][which], 1u << which);
      const std::uint32_t vertex = mesh_.triangles[triangle][which];
      if (incidence_.at(vertex).front() == triangle) add(corners_[vertex], 8u << which);
    }
    return {std::uint8_t(front), std::uint8_t(both)};
  }

 private:
  using Sides = std::uint8_t;

  void find_edges() {
    edges_.resize(mesh_.triangles.size());
    base::parallel_for(edges_.size(), kFeatureGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        for (unsigned which = 0; which < 3; ++which) edges_[i][which] = edge_sides(std::uint32_t(i), which);
      }
    });
  }

  void find_corners() {
    corners_.resize(mesh_.positions.size());
    base::parallel_for(corners_.size(), kFeatureGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t vertex = begin; vertex < end; ++vertex)
        corners_[vertex] = corner_sides(std::uint32_t(vertex));
    });
  }

  Sides edge_sides(std::uint32_t triangle, unsigned which) const {
    const std::uint32_t neighbour = neighbours_[triangle][which];
    if (neighbour == geometry::kNoTriangle) return kFrontBit | kBackBit;
    const auto& corners = mesh_.triangles[triangle];
    const std::uint32_t from = corners[which], to = corners[(which + 1) % 3];
    const auto& over = mesh_.triangles[neighbour];
    const std::uint32_t opposite =
        *std::find_if(over.begin(), over.end(), [&](std::uint32_t v) { return v != from && v != to; });
    const Vector3& a = mesh_.positions[from];
    const Vector3 along = mesh_.positions[to] - a;
    const Vector3 own = mesh_.positions[corners[(which + 2) % 3]] - a;
    const Vector3 beyond = mesh_.positions[opposite] - a;
    const Vector3 area = along.cross(own);
    const double longest = std::max({along.squaredNorm(), own.squaredNorm(), beyond.squaredNorm()});
    const Vector3 beyond_area = along.cross(beyond);
    // Along the edge: sine and cosine of the bend, times the area beyond.
    const double rise = area.dot(beyond) * along.norm() / area.norm();
    const double straight = -area.dot(beyond_area) / area.norm();
    const double bend = std::atan2(rise, straight);
    const double unsure = kBendNoise * longest * along.squaredNorm() / (area.norm() * beyond_area.norm());
    if (std::abs(bend) > kFoldedBack) return kFrontBit | kBackBit;
    if (std::abs(bend) > kFlat + unsure) return bend < 0.0 ? kFrontBit : kBackBit;
    return unsure < kFlat ? 0 : kFrontBit | kBackBit;
  }

  /// The sides on which some position has the vertex as its nearest place: those with directions from the
  /// vertex at more than a right angle to every edge.
  Sides corner_sides(std::uint32_t vertex) const {
    std::array<Vector3, kMostConvex> convex;  // unit, along edges that bend, each as often as it is found
    std::size_t count = 0;
    const std::span<const std::uint32_t> triangles = incidence_.at(vertex);
    for (const std::uint32_t triangle : triangles) {
      for (unsigned which = 0; which < 3; ++which) {
        const auto [from, to] = edge(triangle, which);
        if ((from != vertex && to != vertex) || edges_[triangle][which] == 0) continue;
        if (from != vertex && neighbours_[triangle][which] != geometry::kNoTriangle)
          continue;  // counted in the neighbour
        if (count == kMostConvex) return kFrontBit | kBackBit;
        convex[count++] = way(vertex, from == vertex ? to : from);
      }
    }
    const std::span<const Vector3> edges = std::span(convex).first(count);
    const std::optional<Vector3> out = apex(edges);
    if (!out) return 0;
    const bool told =
        std::all_of(edges.begin(), edges.end(), [&](const Vector3& edge) { return edge.dot(*out) < -kFlat; });
    return told ? side_of(vertex, *out) : kFrontBit | kBackBit;
  }

  /// The middle of all directions at right angles or more to the edges, if there are any. The extreme ones
  /// are at right angles to two edges. Two edges alone are a rim or, in line, a ridge that runs on.
  static std::optional<Vector3> apex(std::span<const Vector3> edges) {
    Vector3 sum = Vector3::Zero();
    if (edges.size() < kFewestConvex) {
      for (const Vector3& edge : edges) sum -= edge;
      return sum.norm() > kFlat ? std::optional(sum.normalized()) : std::nullopt;
    }
    bool found = false;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Vector3 across = edges[i].cross(edges[j]).stableNormalized();
        for (const Vector3& extreme : {across, Vector3(-across)}) {
          if (std::all_of(edges.begin(), edges.end(),
                          [&](const Vector3& edge) { return edge.dot(extreme) <= kFlat; })) {
            sum += extreme;
            found = true;
          }
        }
      }
    }
    return found ? std::optional(sum.stableNormalized()) : std::nullopt;
  }

  /// The side on which `out` lies: the front if the triangles run around it counter-clockwise, seen against
  /// it. They are projected from the vertex on a plane across, where their sides stay straight: unit vectors
  /// could turn the other way round where some of them lie nearly across. An edge that leads up lies in a
  /// flat face of more than half a turn, beside which no position has the vertex as its nearest. Triangles
  /// that pass through each other, as at the end of a twisted flap, run around it either way.
  Sides side_of(std::uint32_t vertex, const Vector3& out) const {
    double turn = 0.0;
    double whole = 0.0;
    for (const std::uint32_t triangle : incidence_.at(vertex)) {
      const auto [one, other] = ways(vertex, triangle);
      const double rise = std::max(one.dot(out), other.dot(out));
      if (rise > -kFlat) return rise > kFlat ? 0 : kFrontBit | kBackBit;
      const double part = one.cross(other).dot(out) / (one.dot(out) * other.dot(out));
      turn += part;
      whole += std::abs(part);
    }
    const bool told = std::abs(turn) > kFlat * whole;
    if (!told || (std::abs(turn) < whole && passes_through_itself(vertex))) return kFrontBit | kBackBit;
    return turn > 0.0 ? kFrontBit : kBackBit;
  }

  /// Do two of the triangles there, all of which lie on one side, pass through each other?
  bool passes_through_itself(std::uint32_t vertex) const {
    const std::span<const std::uint32_t> triangles = incidence_.at(vertex);
    const auto divides = [&](const std::array<Vector3, 2>& one, const std::array<Vector3, 2>& other) {
      const Vector3 normal = one[0].cross(one[1]);
      const double a = normal.dot(other[0]), b = normal.dot(other[1]);
      return std::min(a, b) < -kFlat && std::max(a, b) > kFlat;
    };
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const auto one = ways(vertex, triangles[i]), other = ways(vertex, triangles[j]);
        if (divides(one, other) && divides(other, one)) return true;
      }
    }
    return false;
  }

  /// Unit directions from a vertex of a triangle to the others in their order.
  std::array<Vector3, 2> ways(std::uint32_t vertex, std::uint32_t triangle) const {
    const auto& corners = mesh_.triangles[triangle];
    const auto which = unsigned(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
    return {way(vertex, corners[(which + 1) % 3]), way(vertex, corners[(which + 2) % 3])};
  }

  std::array<std::uint32_t, 2> edge(std::uint32_t triangle, unsigned which) const {
    return {mesh_.triangles[triangle][which], mesh_.triangles[triangle][(which + 1) % 3]};
  }

  Vector3 way(std::uint32_t from, std::uint32_t to) const {
    return (mesh_.positions[to] - mesh_.positions[from]).stableNormalized();
  }

  const TriangleMesh& mesh_;
  geometry::EdgeNeighbours neighbours_;
  Incidence incidence_;
  std::vector<std::array<Sides, 3>> edges_;  // by triangle
  std::vector<Sides> corners_;               // by vertex
};

}  // namespace

std::vector<MeshFeatures> mesh_features(const TriangleMesh& mesh) {
  const Bends bends(mesh);
  std::vector<MeshFeatures> result(mesh.triangles.size());
  base::parallel_for(result.size(), kFeatureGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) result[i] = bends.features(std::uint32_t(i));
  });
  return result;
}

}  // namespace icome::haptics
