#include <fmt/format.h>

#include "interaction/operations/shapes/shape_change.h"
#include "interaction/operations/shapes/vertex_operations.h"
#include "world/shape/usual_tolerance.h"

namespace icome::interaction {
namespace {

using base::fail;
using base::Result;

Result<Plan> plan_mesh(const world::World& world, const Arguments& arguments, world::IdSource& ids) {
  const auto change = shape_change(world, arguments);
  if (!change) return tl::unexpected(change.error());
  if (dynamic_cast<const world::MeshGeometry*>(change->shape.get()))
    return fail(fmt::format("'{}' is a mesh already", arguments.text("object")));
  const double tolerance =
      arguments.has("tolerance") ? arguments.number("tolerance") : world::usual_tolerance(*change->shape);
  const auto triangles = triangles_of(*change, tolerance);
  if (!triangles) return tl::unexpected(triangles.error());
  return plan_of_shape(*change, *triangles, ids);
}

Result<Plan> plan_own_shape(const world::World& world, const Arguments& arguments, world::IdSource& ids) {
  const auto id = arguments.object("object");
  const world::GeometryId shared = world.find(id)->geometry;
  const world::GeometryObject* shape = world.find(shared);
  if (!shape) return fail(fmt::format("'{}' has no shape", arguments.text("object")));
  if (shape->users == 1)
    return fail(fmt::format("'{}' has a shape of its own already", arguments.text("object")));
  const auto own = ids.next<world::GeometryId>();
  world::EditGroup group;
  group.edits.push_back(world::CopyGeometry{own, shared});
  group.edits.push_back(world::ChooseGeometry{id, own});
  return Plan{std::move(group), {id}};
}

}  // namespace

Operation mesh_operation() {
  constexpr double kFinest = 1e-9, kCoarsest = 1e9;  // m
  return {"mesh",
          "Make Mesh",
          "Shape",
          "Makes a mesh of triangles of any other shape.",
          {object_parameter("what becomes a mesh"),
           {.name = "tolerance",
            .kind = ParameterKind::Number,
            .meaning = "how far the triangles may be off, m; else a thousandth of its size, a hundredth of "
                       "combined solids and formulas",
            .least = kFinest,
            .most = kCoarsest},
           alone_parameter()},
          plan_mesh};
}

Operation own_shape_operation() {
  return {"own-shape",
          "Own Shape",
          "Shape",
          "Gives an object that shares its shape one of its own, which changes without the others'.",
          {object_parameter("what gets its own")},
          plan_own_shape};
}

}  // namespace icome::interaction
