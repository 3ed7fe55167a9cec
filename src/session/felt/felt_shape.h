#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/csg/csg_tree.h"
#include "haptics/shapes/shape.h"
#include "session/felt/rigid_part.h"
#include "world/shape/geometry.h"

namespace icome::session {

/// Settings of the tip and of meshes, needed before shapes are made.
struct FeltSettings {
  double tip_radius = 0.0;           // m; 0 is a point
  bool interpolate_normals = false;  // of meshes, for force shading
  /// Surfaces that change with time do so under the hand; else they are felt as they are at t = 0, and so
  /// they are seen and picked.
  bool with_time = false;
  /// A mesh that needs no change to be felt is the shape's own, no copy: only where none is changed in place.
  bool shares_meshes = false;
};

/// A shape of the world as it is touched, stretched as its object is. Immutable; clones share it.
struct FeltShape {
  std::shared_ptr<const haptics::Shape> shape = nullptr;  // null: it cannot be touched
  bool closed = true;                                     // it encloses a solid
  bool exact = true;   // touched as it is, also if that is a mesh; else as triangles of it
  std::string remark;  // a clause on why it is not touched, or not quite itself; empty: it is
  std::vector<std::string> repairs = {};  // sentences on repairs of a mesh and its remaining faults

  /// m, the place of the felt shape's frame in the felt frame: not at its origin where the
  /// shape has coordinates far larger than itself.
  base::Vector3 middle = base::Vector3::Zero();

  // The shape itself, for judging or drawing what was felt; at most one of the first three. In the felt
  // shape's own frame.
  std::shared_ptr<const geometry::TriangleMesh> mesh = nullptr;
  std::optional<geometry::Primitive> primitive = {};
  std::shared_ptr<const geometry::CsgTree> solid = nullptr;
  bool sound = false;  // the mesh is just the shape's own, which needed no repair
  std::function<bool(const base::Vector3& point, double time)> inside = {};  // of a closed smooth surface
  base::Matrix3 felt_from_geometry = base::Matrix3::Identity();              // the shape's own frame to that
};
using FeltShapePointer = std::shared_ptr<const FeltShape>;

/// The place where a shape is felt whose own frame lies in the world like that. The part of the place that
/// is not rigid is in the shape, but for a half-space, whose image is one wherever it goes.
struct FeltPlace {
  base::Pose world_from_felt = base::Pose::Identity();
  base::Matrix3 felt_from_geometry = base::Matrix3::Identity();
};
FeltPlace felt_place(const world::Geometry& shape, const base::Affine3& world_from_geometry);

/// The shape as it is felt. Exact where that is possible: a mesh's vertices go along with the place, so do
/// control meshes and CSG trees; a primitive stays one where its stretched self is, and else becomes a CSG
/// tree of one leaf. Only stretched implicit surfaces, shapes of one's own kinds, and, under a tip with a
/// radius, those that geometry::CsgOffset, geometry::ImplicitOffset and geometry::LoopOffset refuse are
/// felt as triangles: 1/2000 of their size off at most, or sampled at 100 places along their longest side.
///
/// `before`, where given, is the felt shape made with the same settings before an edit. A sound mesh whose
/// vertices alone have moved follows it, many times as fast as one made anew: its surface stays connected
/// as it was, and is repaired again when a triangle has lost its area.
FeltShapePointer make_felt_shape(const world::Geometry& shape, const base::Matrix3& felt_from_geometry,
                                 const FeltSettings& settings, const FeltShape* before = nullptr);

}  // namespace icome::session
