#pragma once
#include <memory>
#include <vector>

#include "base/result.h"
#include "render/csg/render_solid.h"
#include "render/model/shading_mesh.h"
#include "render/model/shape_levels.h"
#include "world/shape/geometry.h"

namespace icome::render {

/// A shape's surface as a graphics card takes it, made once for all objects of the shape. Immutable once
/// made: edits and drawing share it across threads. Owns its arrays.
struct RenderShape {
  ShadingMesh mesh;
  std::vector<Eigen::Vector2f> picture_places;  ///< of every vertex or none; (0, 0) is the lower left
  std::vector<Eigen::Vector3f> colours;         ///< of every vertex or none; linear; < 0: the material's
  std::vector<ShapeLevel> coarser;              ///< without places in a picture
  base::Bounds bounds;                          ///< m, the shape's frame, of what is drawn; empty for nothing
  std::vector<base::Vector3> extremes;          ///< m, outermost vertices all round, to frame a view by
  bool lacks_parts = false;                     ///< a solid whose thin parts cannot be drawn
  std::shared_ptr<const RenderSolid> solid;     ///< null: has no images; else in the same frame as the mesh

  std::size_t triangle_count() const { return mesh.indices.size() / 3; }
};

using RenderShapePointer = std::shared_ptr<const RenderShape>;

/// Makes the surface of a shape, fine enough for a picture that the shape fills. Where the shape has no
/// normals of its own, bends of more than 0.9 rad are edges (2.2 rad in meshes of more than 20,000
/// triangles: the rims of scans are full of sharp bends that are no edges). One that changes is made as at
/// `time` (s), more coarsely but for 0. Fails, saying why, for shapes that cannot be made triangles.
base::Result<RenderShapePointer> make_render_shape(const world::Geometry& shape, double time = 0.0);

/// Does the shape change with time?
bool changes(const world::Geometry& shape);

}  // namespace icome::render
