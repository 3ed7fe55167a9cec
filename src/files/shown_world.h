#pragma once
#include <memory>
#include <unordered_map>
#include <vector>

#include "files/design.h"
#include "world/mesh_geometry.h"

namespace icome::files {

/// How far the triangles that files show of an exact shape may lie off it: a small part of its size, m.
double shown_tolerance(const world::Geometry& shape);

/// The triangles that files show of shapes: made once for each shape, whatever the number of its objects.
class ShownShapes {
 public:
  explicit ShownShapes(const world::World& world) : world_(world) {}

  /// Null where nothing can be shown; why() says why then.
  std::shared_ptr<const world::MeshGeometry> triangles(world::GeometryId id);
  const std::string& why(world::GeometryId id) const { return refusals_.at(id); }

 private:
  const world::World& world_;
  std::unordered_map<world::GeometryId, std::shared_ptr<const world::MeshGeometry>> shown_;
  std::unordered_map<world::GeometryId, std::string> refusals_;
};

/// An object's triangles where they are in the world.
struct ShownObject {
  world::ObjectId object;
  std::shared_ptr<const world::MeshGeometry> mesh;
  base::Affine3 world_from_object = base::Affine3::Identity();
};

/// All objects of a world that have triangles, parents before children, in the order that people see.
/// Remarks tell what cannot be shown and, once each, what else formats without a hierarchy lose. Fails for
/// more than kMostShownTriangles: few bytes with many clones can stand for very many.
inline constexpr std::size_t kMostShownTriangles = 100'000'000;
base::Result<std::vector<ShownObject>> shown_objects(const world::World& world, std::vector<Remark>& remarks);

/// A world as one mesh in its own frame.
struct FlatWorld {
  geometry::TriangleMesh mesh;
  std::vector<world::Colour> colours;  // of the vertices, or none where no object has a colour
};

/// `with_colours`: of corners, or else of materials; a vertex with several of them becomes several.
FlatWorld flatten(const world::World& world, const std::vector<ShownObject>& objects, bool with_colours);

}  // namespace icome::files
