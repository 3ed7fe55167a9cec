#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "geometry/smooth_surface.h"
#include "geometry/tree/triangle_tree.h"
#include "world/collision/effort.h"
#include "world/shape/geometry.h"

namespace icome::world {

/// Relation of two shapes in space.
enum class Meeting : std::uint8_t {
  Apart,
  Touching,     // they share points of their surfaces, but none of their insides
  Overlapping,  // one goes through the other, or lies inside it
};

/// Approximate effort of preparing a shape for queries on its triangles.
std::uint64_t effort_to_look_into(const Geometry& shape);

/// A shape prepared for the question whether it meets others. Spheres (unless stretched unevenly) and
/// half-spaces are queried exactly, meshes and boxes by their triangles, all other shapes by a triangulation
/// that is off them by deviation() at most (or sampled at 100 places along their longest side); first_hit()
/// alone queries these exactly. A shape that has no triangles counts as its box, or, where it is unlimited,
/// as nothing.
class CollisionShape {
 public:
  /// The shape is shared. Triangles are made when they are first asked for.
  explicit CollisionShape(GeometryPointer shape);

  /// In the shape's frame; infinite for a half-space, empty for a shape that can meet nothing.
  const Bounds& bounds() const { return bounds_; }
  bool unlimited() const { return kind_ == Kind::HalfSpace; }
  bool nothing() const { return kind_ == Kind::Nothing; }

  struct Ball {
    Vector3 centre;
    double radius;  // m
  };
  /// The placed shape as a ball; nothing where it is not queried as one.
  std::optional<Ball> ball(const Affine3& world_from_shape) const;

  struct HalfSpace {
    Vector3 foot;    // on its surface
    Vector3 normal;  // unit, outwards
  };
  /// The placed shape as a half-space; nothing for other shapes.
  std::optional<HalfSpace> half_space(const Affine3& world_from_shape) const;

  /// Its triangles, in its own frame, made when they are first asked for. The shape must be neither nothing
  /// nor a half-space.
  const geometry::TriangleTree& triangle_tree() { return *solid().tree; }

  /// Largest distance of its triangles from the exact shape in this placement, m, world frame; 0 where it is
  /// queried exactly, or consists of triangles only.
  double deviation(const Affine3& world_from_shape) const;

  /// The point at which a straight way enters the shape from outside, or passes through a sheet.
  struct Hit {
    double share;    // of the way, 0 to 1
    Vector3 normal;  // of the surface there, against the way; own frame, unit
  };
  /// The first hit on the way from `a` to `b` (m, own frame), with the exact shape.
  std::optional<Hit> first_hit(const Vector3& a, const Vector3& b);

  /// The exact surface, where triangles are only near it; else null.
  const geometry::SmoothSurface* surface() {
    return kind_ == Kind::Triangles ? solid().exact.get() : nullptr;
  }

  /// Effort of making the triangles, if they are needed; 0 when they are there already.
  std::uint64_t effort_to_make() const;

  struct Placed {
    CollisionShape& shape;
    const Affine3& world_from_shape;
  };
  /// Solids, also closed meshes, include their inside; other meshes are their surface alone. Lengths up to
  /// 1e-10 of the largest coordinate count as zero, as in contact: a box that stands on another touches it,
  /// however its place was rounded. When the effort is spent (null: unlimited), the answer is unknown and
  /// they count as overlapping.
  friend Meeting meeting(const Placed& one, const Placed& other, Effort* effort);

 private:
  enum class Kind : std::uint8_t { Nothing, HalfSpace, Sphere, Triangles };
  class Pair;

  /// Triangles with the data for queries on them.
  struct Solid {
    Solid(geometry::TriangleMesh mesh, std::shared_ptr<const geometry::SmoothSurface> surface);
    void find_probes(const geometry::TriangleMesh& mesh);

    bool closed = false;
    std::optional<geometry::TriangleTree> tree;
    std::vector<Vector3> probes;  // a point of each connected part: inside where it is closed
    std::shared_ptr<const geometry::SmoothSurface> exact;  // the surface they approximate; null: none
  };

  const Solid& solid();
  std::optional<Hit> hit_of_half_space(const Vector3& a, const Vector3& b) const;
  std::optional<Hit> hit_of_sphere(const Vector3& a, const Vector3& b) const;

  GeometryPointer shape_;
  Kind kind_ = Kind::Triangles;
  Bounds bounds_;
  base::Matrix3 shape_from_primitive_ = base::Matrix3::Identity();
  double radius_ = 0.0;                 // of a sphere, m
  std::shared_ptr<const Solid> solid_;  // null until it is asked for
};

Meeting meeting(const CollisionShape::Placed& one, const CollisionShape::Placed& other,
                Effort* effort = nullptr);

}  // namespace icome::world
