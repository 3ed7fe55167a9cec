#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "interaction/operations/placement.h"
#include "interaction/operations/shapes/flat_outline.h"
#include "interaction/operations/shapes/shape_making.h"
#include "interaction/operations/shapes/shape_operations.h"
#include "world/shape/flat_curves.h"
#include "world/shape/mesh_geometry.h"

namespace icome::interaction {
namespace {

constexpr double kMostCurves = 1e6;

using base::fail;
using base::Result;

Value listed_points(const std::vector<Vector2>& listed) {
  Value::List points;
  for (const Vector2& point : listed) points.push_back(Value::List{point.x(), point.y()});
  return points;
}

/// A profile and its holes; an open one has none.
struct HoledProfile {
  geometry::Profile profile;
  std::vector<std::vector<Vector2>> holes = {};
};

/// The profiles that an object gives, all in one frame.
struct ObjectProfiles {
  std::vector<HoledProfile> profiles;
  base::Affine3 shape_from_profile = base::Affine3::Identity();
};

/// The profiles of a drawing: what its closed curves enclose or, where they are `open`, its other curves.
Result<std::vector<HoledProfile>> profiles_of_curves(const world::Geometry& shape, bool open) {
  constexpr double kFineness = 2000.0;  // of the shape's size
  const auto curves = shape.flat_curves(shape.bounds().diagonal().norm() / kFineness);
  if (!curves) return tl::unexpected(curves.error());
  std::vector<HoledProfile> profiles;
  if (open) {
    for (const std::vector<Vector2>& line : curves->lines) profiles.push_back({{line, true}});
    if (profiles.empty()) return fail("it has no open curve");
    return profiles;
  }
  for (const geometry::Outline& area : curves->areas) profiles.push_back({{area.rim}, area.holes});
  if (profiles.empty()) return fail("it has no closed curve; say 'open' to sweep a line");
  return profiles;
}

Result<ObjectProfiles> profiles_of(const world::Geometry& shape, bool open) {
  if (const auto* const mesh = dynamic_cast<const world::MeshGeometry*>(&shape)) {
    if (open) return fail("'open' is for points and drawings: the outline of a mesh is closed");
    auto outline = flat_outline(*mesh);
    if (!outline) return tl::unexpected(outline.error());
    return ObjectProfiles{{{std::move(outline->profile)}}, outline->mesh_from_profile};
  }
  auto profiles = profiles_of_curves(shape, open);
  if (!profiles) return tl::unexpected(profiles.error());
  return ObjectProfiles{std::move(*profiles)};
}

/// The profiles of the object that the arguments name: all of its areas, or the one that is asked for.
Result<ObjectProfiles> named_profiles(const world::World& world, const Arguments& arguments) {
  const world::PhysicalObject& object = *world.find(arguments.object("profile"));
  const world::GeometryObject* geometry = world.find(object.geometry);
  const bool open = arguments.flag("open");
  auto found = geometry ? profiles_of(*geometry->shape, open)
                        : Result<ObjectProfiles>(fail("it has no shape; name something flat"));
  const auto wrong = [&](const std::string& why) {
    return fail(fmt::format("the profile '{}': {}", object.name, why));
  };
  if (!found) return wrong(found.error().message);
  std::vector<HoledProfile>& profiles = found->profiles;
  if (arguments.has("which")) {
    const auto which = std::size_t(arguments.count("which"));
    if (which > profiles.size())
      return wrong(fmt::format("there is no {} of number {}: it has {}", open ? "curve" : "area", which,
                               profiles.size()));
    profiles = {profiles[which - 1]};
  }
  if (open && profiles.size() > 1)
    return wrong(fmt::format("it has {} open curves: say 'which', from 1", profiles.size()));
  return found;
}

/// The extrusion of one profile with the other arguments as they are.
Result<world::GeometryPointer> sweep_of(const world::World& world, const Arguments& arguments,
                                        Value::Fields making, const HoledProfile& holed) {
  const geometry::Profile& profile = holed.profile;
  making.emplace_back("points", listed_points(profile.points));
  if (!arguments.has("places") && !profile.places.empty())
    making.emplace_back("places", listed_points(profile.places));
  const auto sweep = Arguments::check(extrusion_parameters(), making, world);
  if (!sweep) return tl::unexpected(sweep.error());
  return holed.holes.empty() ? make_extrusion(*sweep) : make_extrusion_with_holes(*sweep, holed.holes);
}

/// All sweeps as one mesh, which has no recipe where there are several.
Result<world::GeometryPointer> sweeps_of(const world::World& world, const Arguments& arguments,
                                         const Value::Fields& making,
                                         const std::vector<HoledProfile>& profiles) {
  if (profiles.size() == 1) return sweep_of(world, arguments, making, profiles.front());
  geometry::TriangleMesh all;
  for (const HoledProfile& profile : profiles) {
    const auto part = sweep_of(world, arguments, making, profile);
    if (!part) return tl::unexpected(part.error());
    geometry::append(all, static_cast<const world::MeshGeometry&>(**part).mesh);
  }
  return std::make_shared<world::MeshGeometry>(std::move(all));
}

bool says_place(const Arguments& arguments) {
  constexpr std::array kWords = {"at", "turn", "scale", "factor", "parent"};
  return std::ranges::any_of(kWords,
                             [&](const char* word) { return field(arguments.given(), word) != nullptr; });
}

/// Without a place of its own the sweep begins where its profile is; without a material it gets its.
void stay_with(const world::PhysicalObject& profile, const base::Affine3& shape_from_profile,
               const Arguments& arguments, world::PhysicalObject& object) {
  if (!arguments.has("material")) object.material = profile.material;
  if (says_place(arguments)) return;
  object.parent = profile.parent;
  object.parent_from_object = profile.parent_from_object * shape_from_profile;
}

/// The swept shape; where an object gave its profile, `object` is placed by that.
Result<world::GeometryPointer> swept_shape(const world::World& world, const Arguments& arguments,
                                           world::PhysicalObject& object) {
  const Value::Fields making = said_of(extrusion_parameters(), arguments, {});
  if (!arguments.has("profile")) {
    if (arguments.has("which")) return fail("'which' is for a 'profile' that is a drawing");
    const auto sweep = Arguments::check(extrusion_parameters(), making, world);
    if (!sweep) return tl::unexpected(sweep.error());
    return make_extrusion(*sweep);
  }
  const auto found = named_profiles(world, arguments);
  if (!found) return tl::unexpected(found.error());
  stay_with(*world.find(arguments.object("profile")), found->shape_from_profile, arguments, object);
  return sweeps_of(world, arguments, making, found->profiles);
}

Result<Plan> plan_extrude(const world::World& world, const Arguments& arguments, world::IdSource& ids) {
  if (arguments.has("points") == arguments.has("profile"))
    return fail("say either the 'points' of the profile or, as 'profile', an object that is flat");
  world::EditGroup group;
  auto object = placed_object(world, arguments, "extrusion", ids, group);
  if (!object) return tl::unexpected(object.error());
  auto shape = swept_shape(world, arguments, *object);
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
       .meaning =
           "a flat object whose outline is swept, or a drawing: what its closed curves enclose or, with "
           "'open', its open curve; the sweep stands where it does, where no place is said, and its z is "
           "where the object's fronts face"},
      {.name = "which",
       .kind = ParameterKind::Count,
       .meaning = "which of a drawing's areas or open curves is swept, from 1; else all areas",
       .least = 1,
       .most = kMostCurves}};
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
