#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "geometry/mesh/triangle_mesh.h"
#include "haptics/judge/witness_tree.h"

namespace icome::haptics {

/// Outcome of a search for a way.
enum class WaySearch { Found, None, GaveUp };

/// The ways of a point along a mesh, by triangles that lie edge to edge: the judge's own, for ways too long
/// for a search by samples. Shares the tree; vertices at the same position are one.
class WitnessWays {
 public:
  /// `two_sided`: both sides of the triangles stop the point, else the fronts only.
  WitnessWays(const WitnessTree& tree, const geometry::TriangleMesh& mesh, bool two_sided);

  /// Must every way from `a` to `b` that leads no farther from `centre` than these are pass a side that stops
  /// the point? Proved by the parts of the surface within that ball: one without a rim in it, which the
  /// straight way passes more often from the front than from behind, is passed so by every way. False where
  /// that proves nothing, also when `steps` (triangles looked at) are used up; subtracts those it used.
  bool apart(const base::Vector3& a, const base::Vector3& b, const base::Vector3& centre, int& steps) const;

  /// Is there a way from `a` to `b` that leads along the surface and falls straight to `tip`, and from one
  /// triangle to the next never farther from the tip? On each triangle a place at least as high is known as
  /// the highest that the point can come to. `noise`: m, distance from the surface within which a place is
  /// on it. Gives up when `steps` are used up; subtracts those it used.
  WaySearch leads(const base::Vector3& a, const base::Vector3& b, const base::Vector3& tip, double noise,
                  int& steps) const;

 private:
  class Walk;

  /// The triangles at an edge, and whether as many run along it one way as the other.
  struct Edge {
    std::uint32_t first;  // in at_edges_
    std::uint32_t count;
    bool balanced;
  };

  /// The passage of a straight way through a triangle: 1 from the front, -1 from behind.
  struct Passage {
    std::uint32_t triangle;
    int side;
  };

  struct Ball {
    base::Vector3 centre;
    double radius;  // m
  };

  const Edge& edge(std::uint32_t triangle, int side) const { return edges_[edge_of_[3 * triangle + side]]; }
  void connect(const geometry::TriangleMesh& mesh);
  std::optional<std::vector<Passage>> passages(const base::Vector3& a, const base::Vector3& b) const;
  std::optional<std::vector<Passage>> bent_passages(const base::Vector3& a, const base::Vector3& b) const;

  bool mark_part(std::uint32_t start, std::size_t part, const Ball& ball,
                 std::unordered_map<std::uint32_t, std::size_t>& part_of, int& steps) const;

  const WitnessTree& tree_;
  bool two_sided_;
  std::vector<std::uint32_t> edge_of_;  // of each side of each triangle
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> at_edges_;  // sides: three times the triangle and which
};

}  // namespace icome::haptics
