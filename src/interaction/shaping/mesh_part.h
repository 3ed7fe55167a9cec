#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "geometry/tree/triangle_tree.h"
#include "interaction/navigation.h"
#include "world/world.h"

namespace icome::interaction {

/// The region searched for something small to take hold of: along a line, or round a tip. World frame.
struct PartProbe {
  Vector3 from = Vector3::Zero();
  Vector3 along = Vector3::Zero();  // unit; zero: round `from` only
  double radius = 0.0;              // m, >= 0, at `from`
  double spread = 0.0;              // m, >= 0, by which the radius grows for each metre along the line
  double surface = std::numeric_limits<double>::infinity();  // m along the line, to what hides the rest

  bool is_usable() const;
  double radius_at(double t) const { return radius + spread * t; }
};

/// A probe `spread` (about rad) wide along a ray; a surface at `surface` (m) hides what is well behind it.
PartProbe probe_along(const Ray& ray, double spread,
                      double surface = std::numeric_limits<double>::infinity());
PartProbe probe_round(const Vector3& tip, double radius);

/// The quality of a probe's meeting with something: the lower the better.
struct PartMeeting {
  double cost = 0.0;  // distance as a share of the radius; more where it lies behind the surface
  double t = 0.0;     // m along the line
  bool operator<(const PartMeeting& other) const {
    return cost < other.cost || (cost == other.cost && t < other.t);
  }
};
/// The meeting with a point; nothing where it is not within the probe's radius.
std::optional<PartMeeting> meet(const PartProbe& probe, const Vector3& point);

/// The kind of part of a mesh that is taken hold of.
enum class PartKind : std::uint8_t { Vertex, Edge, Face };

/// A vertex, an edge or a triangle of a mesh or of a Loop surface's control mesh.
struct MeshPart {
  PartKind kind = PartKind::Vertex;
  std::vector<std::uint32_t> vertices = {};  // one, two or three
  Vector3 place = Vector3::Zero();           // m, world frame: its point nearest to the probe
  PartMeeting meeting = {};
};

/// The triangles whose vertices can be dragged: of a mesh, or of a Loop surface's control mesh; null for
/// other kinds of shapes. Lives as long as the shape.
const geometry::TriangleMesh* draggable_mesh(const world::Geometry& shape);
/// The object's shape. Fails, with a sentence that says what to do, where it has no such triangles.
base::Result<world::GeometryPointer> draggable_shape(const world::World& world, world::ObjectId object);

/// Finds the vertices, edges and faces of one shape by place: once made, in time by the logarithm of
/// their number. Keeps the shape.
class PartFinder {
 public:
  /// Takes time by the size of the shape. Fails for shapes without triangles to take hold of and for broken
  /// ones.
  static base::Result<PartFinder> create(world::GeometryPointer shape);
  /// Takes another version of the shape; with the same triangles only places are renewed. Fails as create().
  base::Result<void> follow(const world::GeometryPointer& shape);
  const world::GeometryPointer& shape() const { return shape_; }

  /// The part that the probe meets best; nothing where there is none or numbers are not finite.
  std::optional<MeshPart> find(PartKind kind, const base::Affine3& world_from_shape,
                               const PartProbe& probe) const;
  /// The vertices within the radius (m, world frame) of a place, the nearest ones first, `most` at most.
  std::vector<std::uint32_t> vertices_near(const base::Affine3& world_from_shape, const Vector3& place,
                                           double radius, std::size_t most) const;

 private:
  explicit PartFinder(world::GeometryPointer shape);

  world::GeometryPointer shape_;
  const geometry::TriangleMesh* mesh_;  // the shape's
  geometry::TriangleTree tree_;
};

}  // namespace icome::interaction
