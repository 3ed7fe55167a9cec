#include "interaction/operations/placement.h"
#include "interaction/operations/shapes/shape_making.h"
#include "interaction/operations/shapes/shape_operations.h"

namespace icome::interaction {
namespace {

base::Result<Plan> plan_create(const world::World& world, const Arguments& arguments, world::IdSource& ids) {
  world::EditGroup group;
  auto object = placed_object(world, arguments, arguments.text("shape"), ids, group);
  if (!object) return tl::unexpected(object.error());
  auto shape = make_shape(arguments);
  if (!shape) return tl::unexpected(shape.error());
  if (*shape) {
    object->geometry = ids.next<world::GeometryId>();
    group.edits.push_back(world::CreateGeometry{object->geometry, std::move(*shape)});
  }
  const auto id = ids.next<world::ObjectId>();
  group.edits.push_back(create_last(world, id, std::move(*object)));
  return Plan{std::move(group), {id}};
}

}  // namespace

Operation create_operation() {
  std::vector<Parameter> parameters = shape_parameters();
  for (Parameter& placement : placement_parameters()) parameters.push_back(std::move(placement));
  return {"create",
          "Create",
          "Shape",
          "Makes a new object of a simple shape, which reshape can change afterwards.",
          std::move(parameters),
          plan_create};
}

}  // namespace icome::interaction
