#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/mesh/triangle_mesh.h"

namespace icome::haptics {

/// A tree of boxes over the triangles of a mesh, in double precision: the judge's own, so that no fault of
/// the trees that contacts are found by can deceive it. Plain and exact rather than fast. Shares the mesh.
class WitnessTree {
 public:
  using Corners = std::array<base::Vector3, 3>;

  explicit WitnessTree(std::shared_ptr<const geometry::TriangleMesh> mesh);

  /// Box around all triangles; empty without any.
  base::Bounds bounds() const { return nodes_.empty() ? base::Bounds() : nodes_.front().box; }

  Corners corners(std::uint32_t triangle) const;

  /// Calls `visit(triangle)` for every triangle that the segment from `a` to `b` meets, and for some near it.
  template <typename Visit>
  void along(const base::Vector3& a, const base::Vector3& b, Visit&& visit) const {
    descend([&](const base::Bounds& box) { return meets(box, a, b); }, visit);
  }

  /// Calls `visit(triangle)` for every triangle within `radius` of `point`, and for some farther off. The
  /// visit may lessen the radius.
  template <typename Visit>
  void around(const base::Vector3& point, const double& radius, Visit&& visit) const {
    descend([&](const base::Bounds& box) { return box.squaredExteriorDistance(point) <= radius * radius; },
            visit);
  }

  /// Distance from `point` to the nearest triangle, `limit` where there is none within that; m.
  double distance(const base::Vector3& point, double limit) const;

 private:
  static constexpr std::uint32_t kLeaf = 4;  // triangles

  struct Node {
    base::Bounds box;
    std::uint32_t first = 0;
    std::uint32_t count = 0;  // of triangles in a leaf; 0: an inner node
    std::uint32_t right = 0;  // of an inner node, whose left child is the next node
  };

  static bool meets(const base::Bounds& box, const base::Vector3& a, const base::Vector3& b);
  std::uint32_t build(std::uint32_t first, std::uint32_t last, const std::vector<base::Vector3>& centres);

  template <typename Near, typename Visit>
  void descend(Near&& near, Visit&& visit) const {
    std::array<std::uint32_t, 64> waiting;  // halves: as deep as 32 bits
    std::size_t count = 0;
    if (!nodes_.empty()) waiting[count++] = 0;
    while (count > 0) {
      const std::uint32_t index = waiting[--count];
      const Node& node = nodes_[index];
      if (!near(node.box)) continue;
      for (std::uint32_t i = 0; i < node.count; ++i) visit(order_[node.first + i]);
      if (node.count > 0) continue;
      waiting[count++] = node.right;
      waiting[count++] = index + 1;
    }
  }

  std::shared_ptr<const geometry::TriangleMesh> mesh_;
  std::vector<Node> nodes_;  // a parent before its children
  std::vector<std::uint32_t> order_;
};

/// The place of a triangle that is nearest to `point`.
base::Vector3 nearest_on(const WitnessTree::Corners& corners, const base::Vector3& point);

/// The place where a segment crosses a triangle, and the side that it comes from.
struct Crossing {
  double t;  // share of the segment, in [0, 1]
  bool from_front;
  double margin;  // distance of the place from the triangle's rim: least barycentric part
};

/// The crossing, found by the sides on which the segment from `start` to `start + step` passes the three
/// edges, which count as part of the triangle. None slips between two triangles with a common edge.
std::optional<Crossing> crossing(const WitnessTree::Corners& corners, const base::Vector3& start,
                                 const base::Vector3& step);

/// Number of times that a closed mesh winds around the point: fronts passed on the way out count against
/// backs, so that parts may overlap.
int winding(const WitnessTree& tree, const base::Vector3& point);

}  // namespace icome::haptics
