#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "files/remark.h"
#include "world/shape/mesh_geometry.h"
#include "world/world.h"

namespace icome::files {

/// Triangles that show an exact shape to programs that do not know its kind: a few thousand, beside
/// its exact description. For a mesh, its own. Fails where the shape has no triangles.
base::Result<std::shared_ptr<const world::MeshGeometry>> shown_triangles(const world::Geometry& shape);

/// Triangles that stand for an exact shape where nothing else does: within a 500th of its size, within a
/// 100th where it is contoured.
base::Result<std::shared_ptr<const world::MeshGeometry>> fine_triangles(const world::Geometry& shape);

/// The triangles of a world's shapes: made once for each, and for all that share one in memory.
class ShownShapes {
 public:
  using Maker = base::Result<std::shared_ptr<const world::MeshGeometry>> (*)(const world::Geometry&);
  ShownShapes(const world::World& world, Maker maker) : world_(world), make_(maker) {}

  /// Null where nothing can be shown, as for an empty solid; why() gives the reason then.
  std::shared_ptr<const world::MeshGeometry> triangles(world::GeometryId id);
  const std::string& why(world::GeometryId id) const { return refusals_.at(world_.find(id)->shape.get()); }

 private:
  const world::World& world_;
  Maker make_;
  std::unordered_map<const world::Geometry*, std::shared_ptr<const world::MeshGeometry>> shown_;
  std::unordered_map<const world::Geometry*, std::string> refusals_;
};

/// The function by which write_design() makes triangles for a file of this name.
ShownShapes::Maker written_triangles(const std::filesystem::path& path);

/// An object's triangles with their place in the world.
struct ShownObject {
  world::ObjectId object;
  std::shared_ptr<const world::MeshGeometry> mesh;
  base::Affine3 world_from_object = base::Affine3::Identity();
};

/// Has no object anything to be seen, as far as can be told without making triangles?
bool shows_nothing(const world::World& world);

/// Sentences on the recipes of meshes that the format of this name loses: the parameters of shapes,
/// and the places that pictures were projected from.
std::vector<Remark> lost_recipes(const world::World& world, std::string_view format);

/// For remarks: the name in quotes, or that there is none.
std::string object_name(const world::PhysicalObject& object);

/// All objects of a world that have triangles, parents before children, in the order that people see; exact
/// ones `with_looks` (with_exact_looks) for formats that can hold colours. Remarks tell what cannot be shown
/// and, once each, other losses in formats without a hierarchy. Fails where nothing of them can be shown,
/// and for more than kMostShownTriangles: few bytes with many clones can stand for very many.
inline constexpr std::size_t kMostShownTriangles = 100'000'000;
base::Result<std::vector<ShownObject>> shown_objects(const world::World& world, bool with_looks,
                                                     std::vector<Remark>& remarks);

/// A world as one mesh in its own frame.
struct FlatWorld {
  geometry::TriangleMesh mesh;
  std::vector<world::Colour> colours;  // of the vertices, or none where no object has a colour
};

/// `with_colours`: of corners, or else of materials; a vertex with several becomes several.
FlatWorld flatten(const world::World& world, const std::vector<ShownObject>& objects, bool with_colours);

}  // namespace icome::files
