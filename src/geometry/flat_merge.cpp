#include "geometry/flat_merge.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

namespace icome::geometry {
namespace {

using Triangle = TriangleMesh::Triangle;

constexpr std::uint32_t kGone = ~std::uint32_t{0};
/// Of many vertices that could go, some only can when their neighbours have.
constexpr int kMostRounds = 100;

class FlatMerger {
 public:
  FlatMerger(const TriangleMesh& mesh, const std::vector<std::uint32_t>& planes, double thinnest)
      : at_(mesh.positions),
        triangles_(mesh.triangles),
        planes_(planes),
        thinnest_(thinnest),
        around_(at_.size()) {
    assert(planes.size() == mesh.triangles.size());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for (const std::uint32_t corner : triangles_[t]) around_[corner].push_back(t);
    }
  }

  TriangleMesh merged() {
    for (int round = 0; round < kMostRounds; ++round) {
      bool any = false;
      for (std::uint32_t vertex = 0; vertex < at_.size(); ++vertex) any = take_away(vertex) || any;
      if (!any) break;
    }
    return numbered();
  }

 private:
  /// Moves the vertex onto a neighbour, the one that leaves the best shapes, where that changes no face.
  bool take_away(std::uint32_t vertex) {
    if (around_[vertex].empty()) return false;
    const auto faces = planes_around(vertex);
    if (!faces) return false;
    std::uint32_t best = kGone;
    double least = thinnest_;
    for (const std::uint32_t other : neighbours(vertex)) {
      if (!faces->only_one && !is_crease(vertex, other)) continue;
      const double height = least_height(vertex, other);
      if (height <= least || !links_alike(vertex, other)) continue;
      least = height;
      best = other;
    }
    if (best == kGone) return false;
    collapse(vertex, best);
    return true;
  }

  struct Faces {
    bool only_one;
  };

  /// Nothing where the vertex is a corner: of three faces, of a bent one, or where a face meets itself.
  std::optional<Faces> planes_around(std::uint32_t vertex) const {
    std::uint32_t creases = 0;
    for (const std::uint32_t t : around_[vertex]) {
      if (planes_[t] == kNoPlane) return std::nullopt;
    }
    const auto ring = neighbours(vertex);
    for (const std::uint32_t other : ring) creases += is_crease(vertex, other) ? 1 : 0;
    if (creases != 0 && creases != 2) return std::nullopt;
    return Faces{creases == 0};
  }

  std::vector<std::uint32_t> neighbours(std::uint32_t vertex) const {
    std::vector<std::uint32_t> ring;
    for (const std::uint32_t t : around_[vertex]) {
      for (const std::uint32_t corner : triangles_[t]) {
        if (corner != vertex) ring.push_back(corner);
      }
    }
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    return ring;
  }

  bool holds(std::uint32_t triangle, std::uint32_t vertex) const {
    const Triangle& corners = triangles_[triangle];
    return corners[0] == vertex || corners[1] == vertex || corners[2] == vertex;
  }

  /// Do the triangles at the edge lie in two planes?
  bool is_crease(std::uint32_t vertex, std::uint32_t other) const {
    std::uint32_t first = kNoPlane;
    for (const std::uint32_t t : around_[vertex]) {
      if (!holds(t, other)) continue;
      if (first == kNoPlane) {
        first = planes_[t];
      } else if (planes_[t] != first) {
        return true;
      }
    }
    return false;
  }

  static Vector3 twice_area(const Vector3& a, const Vector3& b, const Vector3& c) {
    return (b - a).cross(c - a);
  }

  /// Of the triangles that change, m; 0 where one is turned over.
  double least_height(std::uint32_t vertex, std::uint32_t to) const {
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t t : around_[vertex]) {
      if (holds(t, to)) continue;
      std::array<Vector3, 3> before, after;
      for (std::size_t i = 0; i < 3; ++i) {
        before[i] = at_[triangles_[t][i]];
        after[i] = at_[triangles_[t][i] == vertex ? to : triangles_[t][i]];
      }
      const Vector3 area = twice_area(after[0], after[1], after[2]);
      if (area.dot(twice_area(before[0], before[1], before[2])) <= 0.0) return 0.0;
      const double longest = std::max(
          {(after[1] - after[0]).norm(), (after[2] - after[1]).norm(), (after[0] - after[2]).norm()});
      least = std::min(least, area.norm() / longest);
    }
    return least;
  }

  /// Are the only common neighbours those over the edge, so that nothing is pinched?
  bool links_alike(std::uint32_t vertex, std::uint32_t other) const {
    const auto one = neighbours(vertex), two = neighbours(other);
    std::vector<std::uint32_t> common;
    std::set_intersection(one.begin(), one.end(), two.begin(), two.end(), std::back_inserter(common));
    // A tetrahedron has nothing that could go.
    return common.size() == 2 && (one.size() > 3 || two.size() > 3);
  }

  void collapse(std::uint32_t vertex, std::uint32_t to) {
    for (const std::uint32_t t : around_[vertex]) {
      if (holds(t, to)) {
        for (const std::uint32_t corner : triangles_[t]) {
          if (corner != vertex) std::erase(around_[corner], t);
        }
        triangles_[t] = {kGone, kGone, kGone};
      } else {
        std::replace(triangles_[t].begin(), triangles_[t].end(), vertex, to);
        around_[to].push_back(t);
      }
    }
    around_[vertex].clear();
  }

  TriangleMesh numbered() {
    TriangleMesh result;
    std::vector<std::uint32_t> number(at_.size(), kGone);
    for (Triangle triangle : triangles_) {
      if (triangle[0] == kGone) continue;
      for (std::uint32_t& corner : triangle) {
        if (number[corner] == kGone) {
          number[corner] = std::uint32_t(result.positions.size());
          result.positions.push_back(at_[corner]);
        }
        corner = number[corner];
      }
      result.triangles.push_back(triangle);
    }
    return result;
  }

  const std::vector<Vector3>& at_;
  std::vector<Triangle> triangles_;
  const std::vector<std::uint32_t>& planes_;
  double thinnest_;
  std::vector<std::vector<std::uint32_t>> around_;  // by vertex: its triangles
};

}  // namespace

TriangleMesh merge_flat_faces(const TriangleMesh& mesh, const std::vector<std::uint32_t>& planes,
                              double thinnest) {
  return FlatMerger(mesh, planes, thinnest).merged();
}

}  // namespace icome::geometry
