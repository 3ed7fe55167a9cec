#pragma once
#include <optional>
#include <vector>

#include "geometry/tree/box_tree.h"
#include "world/collision/collision_shape.h"

namespace icome::interaction {

using base::Affine3;
using base::Bounds;
using base::Vector3;

/// Small things found by place, each in its box. Owns the boxes only.
class PlaceTree {
 public:
  PlaceTree() = default;
  explicit PlaceTree(const std::vector<Bounds>& boxes);

  /// Calls `visit(number)` for things whose boxes are nearer to `point` than `limit` (m), nearer ones sooner;
  /// it returns the new limit.
  template <typename Visit>
  void nearest(const Vector3& point, double limit, Visit&& visit) const {
    boxes_.nearest(point, limit * limit, [&](std::uint32_t leaf) {
      const double left = visit(order_[leaf]);
      return left * left;
    });
  }

 private:
  std::vector<std::uint32_t> order_;
  geometry::BoxTree boxes_;
};

/// The places of a shape to snap to. Corners and edges are those that the shape really has: of boxes, cones
/// and cylinders all, of meshes those at which the surface bends by an angle or ends, of round or sampled
/// shapes none, whatever triangles are drawn of them. Immutable.
class SnapShape {
 public:
  /// `sharp_angle` in radians: what bends less is smooth.
  SnapShape(world::GeometryPointer shape, double sharp_angle);

  /// A place of the placed shape, in the world's frame.
  struct Place {
    Vector3 point;
    Vector3 direction = Vector3::Zero();  // unit: along the edge, or out of the face
    Vector3 from = Vector3::Zero();  // of an edge: where it begins; of a rim a circumference of it, straight
    Vector3 to = Vector3::Zero();
  };

  // The nearest place within `reach` (m, world frame); nothing where there is none.
  std::optional<Place> corner(const Affine3& world_from_shape, const Vector3& point, double reach) const;
  std::optional<Place> middle(const Affine3& world_from_shape, const Vector3& point, double reach) const;
  std::optional<Place> edge(const Affine3& world_from_shape, const Vector3& point, double reach) const;
  /// `triangles` is the same shape, prepared for collisions. Exact for primitives and meshes, but for
  /// unevenly stretched round primitives where several places are as near as their triangles can tell;
  /// other shapes as near as their triangles are.
  std::optional<Place> face(const Affine3& world_from_shape, const Vector3& point, double reach,
                            world::CollisionShape& triangles) const;

  /// The corners, in the shape's frame, m.
  const std::vector<Vector3>& corners() const { return corners_; }

 private:
  struct Edge {
    Vector3 from, to;
  };
  /// The points centre + cos(angle) * one + sin(angle) * other.
  struct Rim {
    Vector3 centre, one, other;
  };

  void take_primitive();
  void take_mesh(double sharp_angle);
  void add_box(const Vector3& half);
  void add_rim(double radius, double height);

  world::GeometryPointer shape_;
  std::vector<Vector3> corners_;
  std::vector<Edge> edges_;
  std::vector<Rim> rims_;
  PlaceTree corner_tree_, middle_tree_, edge_tree_;
};

}  // namespace icome::interaction
