#include <fmt/format.h>

#include <numbers>

#include "geometry/loop/loop_control.h"
#include "geometry/loop/loop_topology.h"
#include "geometry/mesh/weld.h"
#include "interaction/operations/shapes/shape_change.h"
#include "interaction/operations/shapes/vertex_operations.h"
#include "world/shape/geometry_check.h"

namespace icome::interaction {
namespace {

using base::fail;
using base::Result;
using world::LoopGeometry;
using world::MeshGeometry;

Result<Plan> plan_refine(const world::World& world, const Arguments& arguments, world::IdSource& ids) {
  const auto change = shape_change(world, arguments);
  if (!change) return tl::unexpected(change.error());
  const auto* loop = dynamic_cast<const LoopGeometry*>(change->shape.get());
  if (!loop)
    return fail(
        fmt::format("'{}' is {} and no Loop surface: 'smooth' makes one of a mesh, and 'subdivide' "
                    "makes a mesh finer as it is",
                    arguments.text("object"), kind_in_words(*change->shape)));
  if (std::string wrong = world::complaint(*loop); !wrong.empty()) return fail(std::move(wrong));
  auto finer = geometry::refine_control(loop->control, int(arguments.count("levels")));
  if (!finer) return tl::unexpected(finer.error());
  return plan_of_shape(*change, std::make_shared<LoopGeometry>(std::move(*finer)), ids);
}

/// The mesh with one vertex at each place and no triangle that names one twice, so that indices join it.
geometry::TriangleMesh joined(geometry::TriangleMesh mesh) {
  geometry::weld_equal(mesh);
  std::erase_if(mesh.triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  return mesh;
}

Result<Plan> plan_smooth(const world::World& world, const Arguments& arguments, world::IdSource& ids) {
  auto change = shape_change(world, arguments);
  if (!change) return tl::unexpected(change.error());
  if (dynamic_cast<const LoopGeometry*>(change->shape.get()))
    return fail(fmt::format("'{}' is a Loop surface already", arguments.text("object")));
  const auto shape = mesh_to_change(*change, arguments);
  if (!shape) return tl::unexpected(shape.error());
  geometry::ControlMesh control;
  control.mesh = joined((*shape)->mesh);
  if (arguments.has("crease"))
    control.creases = geometry::bent_edges(control.mesh, arguments.number("crease") * std::numbers::pi / 180);
  if (const auto surface = geometry::loop_topology(control); !surface) return tl::unexpected(surface.error());
  return plan_of_shape(*change, std::make_shared<LoopGeometry>(std::move(control)), ids);
}

}  // namespace

Operation refine_operation() {
  constexpr double kMostSteps = 12;  // by then one triangle makes more than can be
  return {"refine",
          "Refine",
          "Shape",
          "Makes the control mesh of a Loop surface finer; the surface stays as it is.",
          {object_parameter("whose control mesh gets finer"),
           {.name = "levels",
            .kind = ParameterKind::Count,
            .meaning = "how many times in a row each triangle becomes four",
            .fallback = 1,
            .least = 1,
            .most = kMostSteps},
           alone_parameter()},
          plan_refine};
}

Operation smooth_operation() {
  return {"smooth",
          "Smooth",
          "Shape",
          "Makes a Loop surface of a mesh, which becomes its control mesh; texture coordinates, normals and "
          "colours of corners go.",
          {object_parameter("what becomes smooth"),
           {.name = "crease",
            .kind = ParameterKind::Number,
            .meaning = "edges that bend more stay sharp, degrees; else none does",
            .least = 0,
            .most = 180},
           alone_parameter(),
           as_mesh_parameter()},
          plan_smooth};
}

}  // namespace icome::interaction
