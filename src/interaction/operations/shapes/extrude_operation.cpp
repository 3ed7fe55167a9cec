#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "interaction/operations/placement.h"
#include "interaction/operations/shapes/flat_outline.h"
#include "interaction/operations/shapes/shape_making.h"
#include "interaction/operations/shapes/shape_operations.h"
#include "world/shape/mesh_geometry.h"

namespace icome::interaction {
namespace {

using base::fail;
using base::Result;

Value listed_points(const std::vector<Vector2>& listed) {
  Value::List points;
  for (const Vector2& point : listed) points.push_back(Value::List{point.x(), point.y()});
  return points;
}

Result<FlatOutline> outline_of(const world::World& world, world::ObjectId id) {
  const world::PhysicalObject& object = *world.find(id);
  const world::GeometryObject* geometry = world.find(object.geometry);
  const auto* mesh = geometry ? dynamic_cast<const world::MeshGeometry*>(geometry->shape.get()) : nullptr;
  const auto outline =
      mesh ? flat_outline(*mesh)
           : Result<FlatOutline>(fail("it is no mesh; name something flat, such as a square"));
  if (outline) return outline;
  return fail(fmt::format("the profile '{}': {}", object.name, outline.error().message));
}

bool says_place(const Arguments& arguments) {
  constexpr std::array kWords = {"at", "turn", "scale", "factor", "parent"};
  return std::ranges::any_of(kWords,
                             [&](const char* word) { return field(arguments.given(), word) != nullptr; });
}

/// Without a place of its own the sweep begins where its profile is; without a material it gets its.
void stay_with(const world::PhysicalObject& profile, const base::Affine3& mesh_from_profile,
               const Arguments& arguments, world::PhysicalObject& object) {
  if (!arguments.has("material")) object.material = profile.material;
  if (says_place(arguments)) return;
  object.parent = profile.parent;
  object.parent_from_object = profile.parent_from_object * mesh_from_profile;
}

Result<Plan> plan_extrude(const world::World& world, const Arguments& arguments, world::IdSource& ids) {
  if (arguments.has("points") == arguments.has("profile"))
    return fail("say either the 'points' of the profile or, as 'profile', an object that is flat");
  world::EditGroup group;
  auto object = placed_object(world, arguments, "extrusion", ids, group);
  if (!object) return tl::unexpected(object.error());
  Value::Fields making = said_of(extrusion_parameters(), arguments, {});
  if (arguments.has("profile")) {
    if (arguments.flag("open")) return fail("'open' is for points: the outline of an object is closed");
    const world::ObjectId id = arguments.object("profile");
    const auto outline = outline_of(world, id);
    if (!outline) return tl::unexpected(outline.error());
    making.emplace_back("points", listed_points(outline->profile.points));
    if (!arguments.has("places") && !outline->profile.places.empty())
      making.emplace_back("places", listed_points(outline->profile.places));
    stay_with(*world.find(id), outline->mesh_from_profile, arguments, *object);
  }
  const auto sweep = Arguments::check(extrusion_parameters(), making, world);
  if (!sweep) return tl::unexpected(sweep.error());
  auto shape = make_extrusion(*sweep);
  if (!shape) return tl::unexpected(shape.error());

  std::string remark = remark_on_sweep(**shape);
  object->geometry = ids.next<world::GeometryId>();
  const auto id = ids.next<world::ObjectId>();
  group.edits.push_back(world::CreateGeometry{object->geometry, std::move(*shape)});
  group.edits.push_back(create_last(world, id, std::move(*object)));
  return Plan{std::move(group), {id}, std::move(remark)};
}

}  // namespace

Operation extrude_operation() {
  std::vector<Parameter> parameters = {
      {.name = "profile",
       .kind = ParameterKind::Object,
       .meaning = "a flat object whose outline is swept; the sweep stands where it does, where no place is "
                  "said, and its z is where the object's fronts face"}};
  for (Parameter parameter : extrusion_parameters()) {
    if (parameter.name == "points") {
      parameter.required = false;
      parameter.meaning += "; instead of profile";
    }
    parameters.push_back(std::move(parameter));
  }
  for (Parameter& placement : placement_parameters()) parameters.push_back(std::move(placement));
  return {"extrude",
          "Extrude",
          "Shape",
          "Sweeps a drawing through steps and makes an object of what it passes.",
          std::move(parameters),
          plan_extrude};
}

}  // namespace icome::interaction
