#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "geometry/mesh/triangle_mesh.h"
#include "geometry/tree/box_tree.h"

namespace icome::geometry {

/// The three corners of a triangle, in the mesh's frame (m).
using Corners = std::array<Vector3, 3>;

/// The point of `corners` nearest to `point` (Ericson, Real-Time Collision Detection, 5.1.5).
/// Real-time safe.
Vector3 nearest_point(const Corners& corners, const Vector3& point);

/// The place at which a query met a mesh.
struct MeshHit {
  Vector3 point;           // m
  std::uint32_t triangle;  // index in the mesh
  double parameter;        // along the segment, 0 at its start; for nearest(), the distance in m
};

/// A spatial tree over the triangles of a mesh, laid out for a tip that moves little from one tick to
/// the next: corners are copied in Hilbert order, so neighbours in space are near in memory.
/// Owns its copies, so the mesh is not needed later. About 84 bytes a triangle. Queries never allocate and
/// may run in several threads at once; "slot" is a triangle's place in the tree's order.
class TriangleTree {
 public:
  /// Builds on all cores. The mesh has at most 2^32 - 1 triangles with indices in range.
  explicit TriangleTree(const TriangleMesh& mesh);

  /// The tree over a mesh with the same triangles as that of `other`, some of them moved: O(triangles), in
  /// the order of the other. It gives the same answers as a new one, faster the less has moved.
  TriangleTree(const TriangleTree& other, const TriangleMesh& mesh);

  /// Takes the new positions of a mesh with the same triangles: O(triangles).
  void refit(const TriangleMesh& mesh);

  /// Calls `visit(slot)` for every triangle within `radius` of the segment from `a` to `b`, and for
  /// some that are only near it, until it returns false. Real-time safe when `visit` is.
  template <typename Visit>
  void near(const Vector3& a, const Vector3& b, double radius, Visit&& visit) const {
    near(SegmentQuery(a, b, radius), visit);
  }

  /// As near() above, for a query that has been prepared.
  template <typename Visit>
  void near(const SegmentQuery& query, Visit&& visit) const {
    // Groups are visited a few at a time, so that memory fetches their corners side by side.
    std::array<std::uint32_t, kBatch> groups;
    unsigned count = 0;
    bool more = true;
    const auto look = [&] {
      for (unsigned i = 0; i < count; ++i) {
        const std::uint32_t end = std::min(groups[i] * kGroup + kGroup, std::uint32_t(corners_.size()));
        for (std::uint32_t slot = groups[i] * kGroup; more && slot < end; ++slot) more = visit(slot);
      }
      count = 0;
      return more;
    };
    boxes_.near(query, [&](std::uint32_t group) {
      prefetch(group);
      groups[count++] = group;
      return count < kBatch || look();
    });
    look();
  }

  /// Calls `visit(slot)` for the triangles that a ball of `radius` (m) can meet on its way from `start` by
  /// `step`, and for some near them, as BoxTree::sweep does. Real-time safe when `visit` is.
  template <typename Visit>
  void sweep(const Vector3& start, const Vector3& step, double radius, Visit&& visit) const {
    boxes_.sweep(
        start, step, radius, [&](std::uint32_t group) { prefetch(group); },
        [&](std::uint32_t group) {
          const std::uint32_t end = std::min(group * kGroup + kGroup, std::uint32_t(corners_.size()));
          double share = 1.0;
          for (std::uint32_t slot = group * kGroup; slot < end; ++slot) share = visit(slot);
          return share;
        });
  }

  /// The first triangle that the segment from `a` to `b` crosses, from either side. Watertight: a
  /// segment through a shared edge or vertex meets one of its triangles. Real-time safe.
  std::optional<MeshHit> first_hit(const Vector3& a, const Vector3& b) const;

  /// The nearest point of the mesh within `limit` metres. Real-time safe.
  std::optional<MeshHit> nearest(const Vector3& point,
                                 double limit = std::numeric_limits<double>::infinity()) const;

  /// The winding number of a closed mesh, outward normals out, around the point; its parts may overlap. Exact
  /// (see WindingRay); for a point on the surface that of a point beside it. Real-time safe.
  int winding(const Vector3& point) const;

  /// Does a closed mesh, outward normals out, enclose the point? Real-time safe.
  bool encloses(const Vector3& point) const { return winding(point) > 0; }

  const Corners& corners(std::uint32_t slot) const { return corners_[slot]; }
  std::uint32_t triangle(std::uint32_t slot) const { return order_[slot]; }
  std::size_t size() const { return corners_.size(); }
  const Bounds& bounds() const { return bounds_; }

  /// Memory held, beyond the mesh.
  std::size_t bytes() const;

 private:
  static constexpr std::uint32_t kGroup = 4;     // triangles below one leaf box
  static constexpr std::size_t kBatch = 16;      // groups
  static constexpr std::size_t kCacheLine = 64;  // bytes

  void prefetch(std::uint32_t group) const {
    const char* corners = reinterpret_cast<const char*>(&corners_[group * kGroup]);
    for (std::size_t line = 0; line < kGroup * sizeof(Corners); line += kCacheLine)
      __builtin_prefetch(corners + line);
  }
  void copy_corners(const TriangleMesh& mesh);
  std::vector<FloatBox> group_boxes() const;
  Bounds triangle_bounds(std::uint32_t slot) const;

  std::vector<std::uint32_t> order_;  // slot to triangle
  std::vector<Corners> corners_;      // by slot
  BoxTree boxes_;                     // over groups of slots
  Bounds bounds_;
};

}  // namespace icome::geometry
