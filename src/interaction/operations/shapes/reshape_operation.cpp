#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "interaction/operations/shapes/shape_making.h"
#include "interaction/operations/shapes/shape_operations.h"
#include "world/sharing.h"

namespace icome::interaction {
namespace {

using base::fail;

/// The values given for the shape's own parameters.
Value::Fields changes_of(const Arguments& arguments) {
  Value::Fields changes = arguments.given();
  std::erase_if(changes, [](const auto& it) { return it.first == "object" || it.first == "alone"; });
  return changes;
}

tl::unexpected<base::Error> nothing_said(const world::Geometry& shape) {
  const auto making = making_of(shape);
  if (!making) return tl::unexpected(making.error());
  std::vector<std::string> names;
  for (const auto& [name, value] : *making)
    if (name != "shape" && name != "op") names.push_back(name);
  if (names.empty()) return fail("it has nothing that could be changed");
  return fail(fmt::format("say what is to change: {}", fmt::join(names, ", ")));
}

/// The remark on the resulting shape, and on the objects that share it.
std::string remark_on(const world::Geometry& shape, std::string shared) {
  const auto making = making_of(shape);
  const bool swept = making && field(*making, "op") != nullptr;
  const std::string own = swept ? remark_on_sweep(shape) : "";
  return own.empty() || shared.empty() ? own + shared : own + "; " + shared;
}

base::Result<Plan> plan_reshape(const world::World& world, const Arguments& arguments, world::IdSource& ids) {
  const world::ObjectId id = arguments.object("object");
  const world::GeometryId geometry = world.find(id)->geometry;
  if (!geometry) return fail("it is a group, which has no shape of its own; name an object below it");
  const world::GeometryObject& shared = *world.find(geometry);
  const Value::Fields changes = changes_of(arguments);
  if (changes.empty()) return nothing_said(*shared.shape);
  auto shape = remade(world, *shared.shape, changes);
  if (!shape) return tl::unexpected(shape.error());
  const bool is_alone = shared.users == 1 || arguments.flag("alone");
  std::string remark = remark_on(**shape, is_alone ? "" : world::sharing(world, geometry));
  if (arguments.flag("alone") && shared.users > 1) {
    const auto own = ids.next<world::GeometryId>();
    world::EditGroup group;
    group.edits.push_back(world::CreateGeometry{own, std::move(*shape)});
    group.edits.push_back(world::ChooseGeometry{id, own});
    return Plan{std::move(group), {id}, std::move(remark)};
  }
  return Plan{world::ReplaceGeometry{geometry, std::move(*shape)}, {id}, std::move(remark)};
}

/// "box: its width, ...", for help: the object that is named decides what can be said.
void add_changeable(const Parameter& parameter, std::vector<Parameter>& parameters) {
  if (parameter.name == "shape" || std::ranges::count(parameter.only_for, "mesh") > 0) return;
  Parameter& added = parameters.emplace_back(parameter);
  const std::string whose =
      parameter.only_for.empty() ? "extrusion" : fmt::format("{}", fmt::join(parameter.only_for, ", "));
  added.meaning = fmt::format("{}: {}", whose, parameter.meaning);
  added.required = false;
  added.fallback = {};
  added.only_for = {};
}

}  // namespace

Operation reshape_operation() {
  std::vector<Parameter> parameters = {
      {.name = "object",
       .kind = ParameterKind::Object,
       .meaning = "whose shape changes, with that of all objects that share it",
       .required = true},
      {.name = "alone",
       .kind = ParameterKind::Flag,
       .meaning = "gives the object a shape of its own first, so that no other changes",
       .fallback = false}};
  for (const Parameter& parameter : shape_parameters()) add_changeable(parameter, parameters);
  for (const Parameter& parameter : extrusion_parameters()) add_changeable(parameter, parameters);
  return {"reshape",
          "Reshape",
          "Shape",
          "Changes what a shape was made of, such as a box's size; what is not said stays as it was.",
          std::move(parameters),
          plan_reshape};
}

}  // namespace icome::interaction
