#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "geometry/smooth_surface.h"
#include "geometry/tree/triangle_tree.h"
#include "world/collision/effort.h"
#include "world/shape/geometry.h"

namespace icome::world {

/// How two shapes lie to each other.
enum class Meeting : std::uint8_t {
  Apart,
  Touching,     // they share places of their surfaces, but nothing of what is inside
  Overlapping,  // one goes through the other, or lies inside it
};

/// What it takes, about, to make a shape ready to be looked into by its triangles.
std::uint64_t effort_to_look_into(const Geometry& shape);

/// A shape made ready for the question whether it meets others. Spheres (that are not stretched) and
/// half-spaces are asked as what they are, meshes and boxes by their triangles, all other shapes by triangles
/// of theirs, which are off them by deviation() at most (or sampled at 100 places along their longest side);
/// first_hit() alone asks these as what they are. A shape of which there are no triangles counts as its box,
/// or, without an end, as nothing.
class CollisionShape {
 public:
  /// The shape is shared. Triangles are made when they are first asked for.
  explicit CollisionShape(GeometryPointer shape);

  /// Own frame; infinite for a half-space, empty for what can meet nothing.
  const Bounds& bounds() const { return bounds_; }
  bool unlimited() const { return kind_ == Kind::HalfSpace; }
  bool nothing() const { return kind_ == Kind::Nothing; }

  struct Ball {
    Vector3 centre;
    double radius;  // m
  };
  /// The placed shape as a ball, where it is asked as one.
  std::optional<Ball> ball(const Affine3& world_from_shape) const;

  struct HalfSpace {
    Vector3 foot;    // on its surface
    Vector3 normal;  // unit, out of it
  };
  /// The placed shape as a half-space; nothing for other shapes.
  std::optional<HalfSpace> half_space(const Affine3& world_from_shape) const;

  /// Its triangles, in its own frame, made when they are first asked for. Of a shape that is neither nothing
  /// nor a half-space.
  const geometry::TriangleTree& triangle_tree() { return *solid().tree; }

  /// How far its triangles may be off what it is itself where it is placed so, m, world frame; 0 where it is
  /// asked as what it is, or is nothing else than triangles.
  double deviation(const Affine3& world_from_shape) const;

  /// Where a straight way leads into the shape from outside, or through a sheet.
  struct Hit {
    double share;    // of the way, 0 to 1
    Vector3 normal;  // of the surface there, against the way; own frame, unit
  };
  /// The first such place on the way from `a` to `b` (m, own frame), by what the shape is itself.
  std::optional<Hit> first_hit(const Vector3& a, const Vector3& b);

  /// The surface as what it is, where triangles are only near it; else null.
  const geometry::SmoothSurface* surface() {
    return kind_ == Kind::Triangles ? solid().exact.get() : nullptr;
  }

  /// What it takes to make the triangles, if they are needed; 0 when they are there.
  std::uint64_t effort_to_make() const;

  struct Placed {
    CollisionShape& shape;
    const Affine3& world_from_shape;
  };
  /// Solids count as what is inside them, also a mesh that is closed; other meshes as their surface. Lengths
  /// up to 1e-10 of the largest coordinate count as none, as in contact: a box that stands on another
  /// touches it, whatever rounding made of where it stands. Where the effort is spent (null: there is no end
  /// to it), nothing is known, and they count as overlapping.
  friend Meeting meeting(const Placed& one, const Placed& other, Effort* effort);

 private:
  enum class Kind : std::uint8_t { Nothing, HalfSpace, Sphere, Triangles };
  class Pair;

  /// Triangles with what it takes to look into them.
  struct Solid {
    Solid(geometry::TriangleMesh mesh, std::shared_ptr<const geometry::SmoothSurface> surface);
    void find_probes(const geometry::TriangleMesh& mesh);

    bool closed = false;
    std::optional<geometry::TriangleTree> tree;
    std::vector<Vector3> probes;  // a place in each connected part: inside where it is closed
    std::shared_ptr<const geometry::SmoothSurface> exact;  // what the triangles stand for; null: themselves
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
