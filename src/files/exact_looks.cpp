#include "files/exact_looks.h"

#include <utility>

#include "files/crease_normals.h"
#include "world/shape/csg_colours.h"
#include "world/shape/primitive_normals.h"
#include "world/shape/solid_geometry.h"

namespace icome::files {
namespace {

using world::MeshGeometry;

/// Is there a leaf whose colour satisfies `such`?
template <typename Such>
bool any_leaf_colour(const world::Geometry& shape, const Such& such) {
  const auto* const csg = dynamic_cast<const world::CsgGeometry*>(&shape);
  for (geometry::CsgTree::Index i = 0; csg && i < csg->tree.size(); ++i) {
    const auto& node = csg->tree.node(i);
    if (node.is_leaf && node.colour && such(*node.colour)) return true;
  }
  return false;
}

/// Adds normals as the window draws exact shapes.
void add_crease_normals(MeshGeometry& shape) {
  constexpr double kCrease = 0.6;  // rad
  PolygonMesh polygons;
  polygons.positions = shape.mesh.positions;
  for (const auto& triangle : shape.mesh.triangles) {
    polygons.corners.insert(polygons.corners.end(), triangle.begin(), triangle.end());
    polygons.begins.push_back(std::uint32_t(polygons.corners.size()));
  }
  const std::vector<base::Vector3> normals = crease_normals(polygons, kCrease);
  for (std::size_t i = 0; i + 2 < normals.size(); i += 3)
    shape.normals.push_back({normals[i], normals[i + 1], normals[i + 2]});
}

void fill_colours(MeshGeometry& shape, const world::Colour& own) {
  for (auto& corners : shape.colours) {
    for (world::Colour& colour : corners) {
      if (colour == world::kMaterialsColour) colour = own;
    }
  }
}

}  // namespace

bool has_part_colours(const world::Geometry& shape) {
  return any_leaf_colour(shape, [](const auto&) { return true; });
}

bool has_clear_parts(const world::Geometry& shape) {
  return any_leaf_colour(shape, [](const auto& colour) { return colour[3] < 1.0F; });
}

std::shared_ptr<const MeshGeometry> with_exact_looks(const world::Geometry& shape,
                                                     std::shared_ptr<const MeshGeometry> triangles,
                                                     const world::Colour& own) {
  if (shape.kind() == "mesh" || !triangles) return triangles;
  std::shared_ptr<const MeshGeometry> coloured = triangles;
  if (const auto* const csg = dynamic_cast<const world::CsgGeometry*>(&shape))
    coloured = world::coloured_by_operands(csg->tree, triangles);
  auto made = std::make_shared<MeshGeometry>(*coloured);
  fill_colours(*made, own);
  if (const auto* const primitive = dynamic_cast<const world::PrimitiveGeometry*>(&shape)) {
    made->normals = world::primitive_normals(*primitive, made->mesh);
  } else if (made->normals.empty()) {
    add_crease_normals(*made);
  }
  return made;
}

}  // namespace icome::files
