#include "geometry/deform/soft_selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include "base/parallel.h"
#include "geometry/mesh/mesh_check.h"

namespace icome::geometry {
namespace {

constexpr double kUnreached = std::numeric_limits<double>::infinity();

/// Distances are in radii: squares of metres could overflow or vanish where the radius is enormous or tiny.
double radii_between(const Vector3& a, const Vector3& b, double radius) { return ((a - b) / radius).norm(); }

/// The seeds as a k-d tree, halved at the medians along x, y and z in turn.
class SeedTree {
 public:
  SeedTree(std::vector<Vector3> points, double radius) : points_(std::move(points)), radius_(radius) {
    for (const Vector3& point : points_) box_.extend(point);
    build(0, points_.size(), 0);
  }

  /// The distance to the nearest seed, in radii; kUnreached when no seed is within the radius.
  double distance(const Vector3& from) const {
    double nearest = std::nextafter(1.0, 2.0);  // seeds at the radius itself count
    const Vector3 gap = (box_.min() - from).cwiseMax(from - box_.max()).cwiseMax(Vector3::Zero()) / radius_;
    look(from, 0, points_.size(), 0, gap, nearest);
    return nearest <= 1.0 ? nearest : kUnreached;
  }

 private:
  void build(std::size_t begin, std::size_t end, int axis) {
    if (end - begin < 2) return;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [axis](const Vector3& a, const Vector3& b) { return a[axis] < b[axis]; });
    build(begin, middle, (axis + 1) % 3);
    build(middle + 1, end, (axis + 1) % 3);
  }

  /// `gap` is the distance, in radii along each axis, of `from` outside the part of space that these points
  /// lie in. Its length never exceeds their computed distances, as rounding keeps the order of numbers.
  void look(const Vector3& from, std::size_t begin, std::size_t end, int axis, const Vector3& gap,
            double& nearest) const {
    if (begin == end || gap.norm() >= nearest) return;
    const std::size_t middle = begin + (end - begin) / 2;
    nearest = std::min(nearest, radii_between(from, points_[middle], radius_));
    const double beyond = (from[axis] - points_[middle][axis]) / radius_;
    const int next = (axis + 1) % 3;
    Vector3 gap_across = gap;
    gap_across[axis] = std::abs(beyond);
    if (beyond < 0) {
      look(from, begin, middle, next, gap, nearest);
      look(from, middle + 1, end, next, gap_across, nearest);
    } else {
      look(from, middle + 1, end, next, gap, nearest);
      look(from, begin, middle, next, gap_across, nearest);
    }
  }

  std::vector<Vector3> points_;
  double radius_;
  base::Bounds box_;
};

std::vector<double> straight_distances(const TriangleMesh& mesh, std::span<const std::uint32_t> seeds,
                                       double radius) {
  constexpr std::size_t kVerticesForOneThread = 1U << 14U;
  std::vector<Vector3> points;
  for (const std::uint32_t seed : seeds) points.push_back(mesh.positions[seed]);
  const SeedTree tree(std::move(points), radius);
  std::vector<double> distances(mesh.positions.size());
  base::parallel_for(distances.size(), kVerticesForOneThread, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) distances[v] = tree.distance(mesh.positions[v]);
  });
  return distances;
}

/// The vertices that each vertex has an edge to; inner edges are there twice, which costs nothing but time.
struct VertexNeighbours {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> others;  // those of vertex v are others[first[v]..first[v + 1])
};

VertexNeighbours vertex_neighbours(const TriangleMesh& mesh) {
  VertexNeighbours result;
  result.first.assign(mesh.positions.size() + 1, 0);
  for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) result.first[v + 1] += 2;
  }
  std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
  result.others.resize(result.first.back());
  std::vector<std::uint32_t> next(result.first.begin(), result.first.end() - 1);
  for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      std::uint32_t& at = next[triangle[corner]];
      result.others[at++] = triangle[(corner + 1) % 3];
      result.others[at++] = triangle[(corner + 2) % 3];
    }
  }
  return result;
}

/// Distances along edges by Dijkstra's algorithm, in radii; kUnreached beyond the radius.
std::vector<double> edge_distances(const TriangleMesh& mesh, std::span<const std::uint32_t> seeds,
                                   double radius) {
  using Visit = std::pair<double, std::uint32_t>;
  const VertexNeighbours neighbours = vertex_neighbours(mesh);
  std::vector<double> distances(mesh.positions.size(), kUnreached);
  std::priority_queue<Visit, std::vector<Visit>, std::greater<>> queue;
  for (const std::uint32_t seed : seeds) {
    distances[seed] = 0;
    queue.emplace(0.0, seed);
  }
  while (!queue.empty()) {
    const auto [distance, vertex] = queue.top();
    queue.pop();
    if (distance > distances[vertex]) continue;
    for (std::uint32_t i = neighbours.first[vertex]; i < neighbours.first[vertex + 1]; ++i) {
      const std::uint32_t other = neighbours.others[i];
      const double on = distance + radii_between(mesh.positions[vertex], mesh.positions[other], radius);
      if (!(on <= 1.0 && on < distances[other])) continue;
      distances[other] = on;
      queue.emplace(on, other);
    }
  }
  return distances;
}

base::Result<void> check_selection(const TriangleMesh& mesh, std::span<const std::uint32_t> seeds,
                                   const SoftSelection& selection) {
  if (!(selection.radius >= 0 && std::isfinite(selection.radius))) {
    return base::fail(fmt::format(
        "the radius of a soft selection cannot be {} m: give 0 (no softness) or more", selection.radius));
  }
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max() / 6) {
    return base::fail("the mesh has too many triangles for a soft selection: simplify it first");
  }
  if (auto fine = check_mesh(mesh); !fine) return fine;
  return check_chosen(seeds, mesh.positions.size(), "vertex");
}

}  // namespace

double falloff_weight(Falloff falloff, double t) {
  if (!(t <= 1.0)) return 0.0;
  const double left = 1.0 - t;
  switch (falloff) {
    case Falloff::Constant:
      return 1.0;
    case Falloff::Linear:
      return left;
    case Falloff::Smooth:
      return left * left * (1.0 + 2.0 * t);  // the same polynomial, without cancellation at the rim
    case Falloff::Sharp:
      return left * left;
  }
  return 0.0;
}

base::Result<std::vector<SoftWeight>> soft_weights(const TriangleMesh& mesh,
                                                   std::span<const std::uint32_t> seeds,
                                                   const SoftSelection& selection) {
  const auto fine = check_selection(mesh, seeds, selection);
  if (!fine) return tl::unexpected(fine.error());
  std::vector<std::uint32_t> unique(seeds.begin(), seeds.end());
  std::ranges::sort(unique);
  unique.erase(std::unique(unique.begin(), unique.end()), unique.end());

  std::vector<SoftWeight> weights;
  if (selection.radius == 0 || unique.empty()) {
    for (const std::uint32_t seed : unique) weights.push_back({seed, 1.0});
    return weights;
  }
  const bool straight = selection.distance == SoftDistance::Straight;
  const std::vector<double> distances = straight ? straight_distances(mesh, unique, selection.radius)
                                                 : edge_distances(mesh, unique, selection.radius);
  for (std::uint32_t v = 0; v < distances.size(); ++v) {
    const double weight = falloff_weight(selection.falloff, distances[v]);
    if (weight > 0) weights.push_back({v, weight});
  }
  return weights;
}

}  // namespace icome::geometry
