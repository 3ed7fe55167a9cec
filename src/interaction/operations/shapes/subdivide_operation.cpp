#include <cmath>
#include <numeric>

#include "geometry/deform/triangle_subdivision.h"
#include "geometry/mesh/weld.h"
#include "interaction/operations/shapes/shape_change.h"
#include "interaction/operations/shapes/vertex_operations.h"

namespace icome::interaction {
namespace {

using base::fail;
using base::Result;
using geometry::TriangleSubdivision;
using world::MeshGeometry;

constexpr double kMostLevels = 12;  // by then one triangle makes more than can be

/// Scales blended normals to unit length again; those that cancel out take the triangle's.
void make_unit(MeshGeometry& shape) {
  constexpr double kUnit = 1e-12, kCancelled = 1e-6;
  for (std::size_t t = 0; t < shape.normals.size(); ++t) {
    for (Vector3& normal : shape.normals[t]) {
      const double length = normal.norm();
      if (std::abs(length - 1.0) <= kUnit) continue;
      if (length > kCancelled) {
        normal /= length;
        continue;
      }
      const auto side = [&](int to) { return Vector3(shape.mesh.corner(t, to) - shape.mesh.corner(t, 0)); };
      normal = side(1).cross(side(2)).stableNormalized();
    }
  }
}

std::shared_ptr<MeshGeometry> carried(TriangleSubdivision subdivision, const MeshGeometry& from) {
  auto made = std::make_shared<MeshGeometry>(geometry::TriangleMesh());
  made->texture_coordinates = geometry::carry_corners(subdivision, from.texture_coordinates);
  made->normals = geometry::carry_corners(subdivision, from.normals);
  made->colours = geometry::carry_corners(subdivision, from.colours);
  made->mesh = std::move(subdivision.mesh);
  make_unit(*made);
  return made;
}

Result<Plan> plan_subdivide(const world::World& world, const Arguments& arguments, world::IdSource& ids) {
  auto change = shape_change(world, arguments);
  if (!change) return tl::unexpected(change.error());
  const auto shape = mesh_to_change(*change, arguments);
  if (!shape) return tl::unexpected(shape.error());
  geometry::TriangleMesh mesh = (*shape)->mesh;
  std::vector<std::uint32_t> chosen(mesh.triangles.size());
  std::iota(chosen.begin(), chosen.end(), 0U);
  if (arguments.has("triangles")) {
    chosen = arguments.counts("triangles");
    geometry::weld_equal(mesh);  // else triangles that only touch those would not be cut to fit
  }
  if (chosen.empty()) return fail("there is no triangle to subdivide");
  auto subdivision = geometry::subdivide_triangles(mesh, chosen, int(arguments.count("levels")));
  if (!subdivision) return tl::unexpected(subdivision.error());
  return plan_of_shape(*change, carried(std::move(*subdivision), **shape), ids);
}

}  // namespace

Operation subdivide_operation() {
  return {"subdivide",
          "Subdivide",
          "Shape",
          "Cuts triangles of a mesh into four smaller ones, and their neighbours to fit.",
          {object_parameter("whose triangles are cut"),
           {.name = "triangles",
            .kind = ParameterKind::Counts,
            .meaning = "which ones, by index; else all",
            .least = 0},
           {.name = "levels",
            .kind = ParameterKind::Count,
            .meaning = "how many times in a row",
            .fallback = 1,
            .least = 1,
            .most = kMostLevels},
           alone_parameter(),
           as_mesh_parameter()},
          plan_subdivide};
}

}  // namespace icome::interaction
