#include "geometry/mesh/face_merge.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

namespace icome::geometry {
namespace {

using Triangle = TriangleMesh::Triangle;

constexpr std::uint32_t kGone = ~std::uint32_t{0};
/// Some vertices can be removed only after their neighbours.
constexpr int kMostRounds = 100;
constexpr std::uint32_t kAskEach = 4096;  // vertices between two calls of `go_on`

class FaceMerger {
 public:
  FaceMerger(const TriangleMesh& mesh, const std::vector<std::uint32_t>& faces,
             const std::vector<bool>& pinned, double thinnest, const FaceFit& fits)
      : at_(mesh.positions),
        triangles_(mesh.triangles),
        faces_(faces),
        pinned_(pinned),
        thinnest_(thinnest),
        fits_(fits),
        tried_(at_.size(), false),
        around_(at_.size()) {
    assert(faces.size() == mesh.triangles.size() && pinned.size() == mesh.positions.size());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for (const std::uint32_t corner : triangles_[t]) around_[corner].push_back(t);
    }
  }

  base::Result<TriangleMesh> merged(const ContourProgress& go_on) {
    for (int round = 0; round < kMostRounds; ++round) {
      bool any = false;
      for (std::uint32_t vertex = 0; vertex < at_.size(); ++vertex) {
        if (vertex % kAskEach == 0 && !go_on(done(round, vertex)))
          return base::fail("the meshing was interrupted");
        any = take_away(vertex) || any;
      }
      if (!any) break;
    }
    return numbered();
  }

 private:
  /// The part done. The first round takes most time; each of the others, however many, is half of the rest.
  double done(int round, std::uint32_t vertex) const {
    return 1.0 - std::ldexp(1.0 - 0.5 * double(vertex) / double(at_.size()), -round);
  }

  /// Moves the vertex onto a neighbour, the one that leaves the best shapes, where that changes no face.
  bool take_away(std::uint32_t vertex) {
    if (pinned_[vertex] || tried_[vertex] || around_[vertex].empty()) return false;
    tried_[vertex] = true;
    const auto faces = faces_around(vertex);
    if (!faces) return false;
    std::uint32_t best = kGone;
    double least = thinnest_;
    for (const std::uint32_t other : neighbours(vertex)) {
      if (!faces->only_one && !is_crease(vertex, other)) continue;
      const double height = least_height(vertex, other);
      if (height <= least || !links_alike(vertex, other) || !all_fit(vertex, other)) continue;
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

  /// The vertex's faces; nothing at a corner: of three faces, of no face, or of a face that meets itself.
  std::optional<Faces> faces_around(std::uint32_t vertex) const {
    std::uint32_t creases = 0;
    for (const std::uint32_t t : around_[vertex]) {
      if (faces_[t] == kNoFace) return std::nullopt;
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

  /// Do the triangles at the edge lie in two faces?
  bool is_crease(std::uint32_t vertex, std::uint32_t other) const {
    std::uint32_t first = kNoFace;
    for (const std::uint32_t t : around_[vertex]) {
      if (!holds(t, other)) continue;
      if (first == kNoFace) {
        first = faces_[t];
      } else if (faces_[t] != first) {
        return true;
      }
    }
    return false;
  }

  static Vector3 twice_area(const Vector3& a, const Vector3& b, const Vector3& c) {
    return (b - a).cross(c - a);
  }

  /// The triangle's corners when the vertex is moved to the place of `to`.
  std::array<Vector3, 3> moved(std::uint32_t triangle, std::uint32_t vertex, std::uint32_t to) const {
    std::array<Vector3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = at_[triangles_[triangle][i] == vertex ? to : triangles_[triangle][i]];
    return corners;
  }

  bool all_fit(std::uint32_t vertex, std::uint32_t to) const {
    return std::all_of(around_[vertex].begin(), around_[vertex].end(), [&](std::uint32_t t) {
      return holds(t, to) || fits_(faces_[t], moved(t, vertex, to));
    });
  }

  /// The least height of the triangles that change, m; 0 where one is turned over.
  double least_height(std::uint32_t vertex, std::uint32_t to) const {
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t t : around_[vertex]) {
      if (holds(t, to)) continue;
      const std::array<Vector3, 3> before = moved(t, vertex, vertex), after = moved(t, vertex, to);
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
    // Nothing can be removed from a tetrahedron.
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
    tried_[to] = false;
    for (const std::uint32_t other : neighbours(to)) tried_[other] = false;
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
  const std::vector<std::uint32_t>& faces_;
  const std::vector<bool>& pinned_;  // by vertex
  double thinnest_;
  const FaceFit& fits_;
  std::vector<bool> tried_;  // by vertex: in vain, and nothing has changed around it since
  std::vector<std::vector<std::uint32_t>> around_;  // by vertex: its triangles
};

}  // namespace

base::Result<TriangleMesh> merge_faces(const TriangleMesh& mesh, const std::vector<std::uint32_t>& faces,
                                       const std::vector<bool>& pinned, double thinnest, const FaceFit& fits,
                                       const ContourProgress& go_on) {
  return FaceMerger(mesh, faces, pinned, thinnest, fits).merged(go_on);
}

}  // namespace icome::geometry
