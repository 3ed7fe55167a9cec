#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "geometry/box_tree.h"
#include "geometry/triangle_mesh.h"

namespace icome::geometry {

/// The three corners of a triangle, in the mesh's frame (m).
using Corners = std::array<Vector3, 3>;

/// The point of `corners` nearest to `point` (Ericson, Real-Time Collision Detection, 5.1.5).
/// Real-time safe.
Vector3 nearest_point(const Corners& corners, const Vector3& point);

/// Where a query met a mesh.
struct MeshHit {
  Vector3 point;             // m
  std::uint32_t triangle;    // index in the mesh
  double parameter;          // along the segment, 0 at its start; for nearest(), the distance in m
};

/// A spatial tree over the triangles of a mesh, laid out for a tip that moves little from one tick to
/// the next: corners are copied in Hilbert order, so what is near in space is near in memory.
/// Owns its copies; the mesh may go. About 84 bytes a triangle. Queries never allocate and may run in
/// several threads at once; "slot" is a triangle's place in the tree's order.
class TriangleTree {
 public:
  /// Builds on all cores. The mesh has at most 2^32 - 1 triangles with indices in range.
  explicit TriangleTree(const TriangleMesh& mesh);

  /// Takes the new positions of a mesh with the same triangles: O(triangles).
  void refit(const TriangleMesh& mesh);

  /// Calls `visit(slot)` for every triangle within `radius` of the segment from `a` to `b`, and for
  /// some that are only near it. Real-time safe when `visit` is.
  template <typename Visit>
  void near(const Vector3& a, const Vector3& b, double radius, Visit&& visit) const {
    boxes_.near(SegmentQuery(a, b, radius), [&](std::uint32_t group) {
      const std::uint32_t end = std::min(group * kGroup + kGroup, std::uint32_t(corners_.size()));
      for (std::uint32_t slot = group * kGroup; slot < end; ++slot) visit(slot);
    });
  }

  /// The first triangle that the segment from `a` to `b` crosses, from either side. Watertight: a
  /// segment through a shared edge or vertex meets one of its triangles. Real-time safe.
  std::optional<MeshHit> first_hit(const Vector3& a, const Vector3& b) const;

  /// The nearest point of the mesh within `limit` metres. Real-time safe.
  std::optional<MeshHit> nearest(const Vector3& point,
                                 double limit = std::numeric_limits<double>::infinity()) const;

  /// Does a closed mesh enclose the point? Counts crossings in three directions and lets the majority
  /// decide, as a ray through an edge counts it twice. Real-time safe.
  bool encloses(const Vector3& point) const;

  const Corners& corners(std::uint32_t slot) const { return corners_[slot]; }
  std::uint32_t triangle(std::uint32_t slot) const { return order_[slot]; }
  std::size_t size() const { return corners_.size(); }
  const Bounds& bounds() const { return bounds_; }

  /// Memory held, beyond the mesh.
  std::size_t bytes() const;

 private:
  static constexpr std::uint32_t kGroup = 4;  // triangles below one leaf box

  void copy_corners(const TriangleMesh& mesh);
  std::vector<FloatBox> group_boxes() const;

  std::vector<std::uint32_t> order_;  // slot to triangle
  std::vector<Corners> corners_;      // by slot
  BoxTree boxes_;                     // over groups of slots
  Bounds bounds_;
};

}  // namespace icome::geometry
