#include <fmt/format.h>

#include <algorithm>

#include "geometry/sweep/sweep.h"
#include "interaction/operations/placement.h"
#include "interaction/operations/shapes/shape_operations.h"
#include "world/edit/copy.h"
#include "world/row.h"

namespace icome::interaction {
namespace {

using base::Affine3;
using base::fail;
using base::Result;

/// The most objects that one operation makes.
constexpr std::size_t kMostRepeated = 100'000;

/// The copies one after the other, in the frame of the object's parent.
struct Repetition {
  world::ObjectId object;
  Vector3 pivot;
  std::vector<Affine3> places;  // of the copies, with respect to the object
  std::vector<std::string> names;
  world::Duplicate how;
};

Result<std::vector<Affine3>> places_of(const world::World& world, const Arguments& arguments,
                                       const Vector3& pivot) {
  const std::size_t each = world::subtree(world, arguments.object("object")).size();
  const auto count = std::size_t(arguments.count("count"));
  if (count > kMostRepeated / each)
    return fail(fmt::format("{} copies of {} object{} each are too many; ask for {} at most", count, each,
                            each == 1 ? "" : "s", kMostRepeated / each));
  const auto scale = scale_of(arguments);
  if (!scale) return tl::unexpected(scale.error());
  Affine3 step = Affine3::Identity();
  step.linear() = turn_of(arguments.vector("turn")) * scale->asDiagonal();
  step.translation() = arguments.vector("move");
  return geometry::repeated_copies(step, pivot, count);
}

Result<Repetition> repetition_of(const world::World& world, const Arguments& arguments) {
  Repetition repetition;
  repetition.object = arguments.object("object");
  const world::PhysicalObject& object = *world.find(repetition.object);
  repetition.pivot =
      arguments.has("pivot") ? arguments.vector("pivot") : Vector3(object.parent_from_object.translation());
  auto places = places_of(world, arguments, repetition.pivot);
  if (!places) return tl::unexpected(places.error());
  repetition.places = std::move(*places);
  repetition.names =
      unused_names(world, object.name.empty() ? "object" : object.name, repetition.places.size());
  repetition.how = arguments.text("how") == "copy" ? world::Duplicate::CopyObjectAndChildren
                                                   : world::Duplicate::CloneObjectAndChildren;
  return repetition;
}

/// The parent of the copies, and its frame in that of the object's own parent.
struct Gathering {
  world::ObjectId parent;
  std::size_t place = 0;  // of the first
  Affine3 parent_from_old_parent = Affine3::Identity();
};

/// Makes a group at the pivot, where the object is, and puts the object in it.
Result<Gathering> gather(const world::World& world, const Repetition& repetition, const std::string& name,
                         world::IdSource& ids, Plan& plan) {
  if (const auto good = check_name(name); !good) return fail(fmt::format("'into': {}", good.error().message));
  const world::PhysicalObject& object = *world.find(repetition.object);
  const world::PhysicalObject* parent = world.find(object.parent);
  const auto& siblings = parent ? parent->children : world.roots();
  world::PhysicalObject group;
  group.name = name;
  group.parent = object.parent;
  group.parent_from_object.translation() = repetition.pivot;
  Gathering gathering{ids.next<world::ObjectId>(), 1, Affine3(Eigen::Translation3d(-repetition.pivot))};
  auto& edits = std::get<world::EditGroup>(plan.edit.what).edits;
  edits.push_back(world::CreateObject{
      gathering.parent, world::place_near(siblings, repetition.object, object.place_hint), std::move(group)});
  edits.push_back(world::MoveObject{repetition.object, gathering.parent, 0,
                                    gathering.parent_from_old_parent * object.parent_from_object});
  plan.objects.push_back(gathering.parent);
  return gathering;
}

/// Adds one more copy, by its number from 0.
Result<void> add_copy(const world::World& world, const Repetition& repetition, const Gathering& gathering,
                      std::size_t number, world::IdSource& ids, Plan& plan) {
  const world::PhysicalObject& object = *world.find(repetition.object);
  auto copy = world::duplicate(world, repetition.object, repetition.how, object.parent, ids);
  if (!copy) return tl::unexpected(copy.error());
  for (world::Edit& edit : std::get<world::EditGroup>(copy->edit.what).edits) {
    auto* made = std::get_if<world::CreateObject>(&edit.what);
    if (!made || made->id != copy->object) continue;
    made->place = gathering.place + number;
    made->object.name = repetition.names[number];
    made->object.parent = gathering.parent;
    made->object.parent_from_object =
        gathering.parent_from_old_parent * repetition.places[number] * object.parent_from_object;
  }
  std::get<world::EditGroup>(plan.edit.what).edits.push_back(std::move(copy->edit));
  plan.objects.push_back(copy->object);
  return {};
}

Result<Plan> plan_repeat(const world::World& world, const Arguments& arguments, world::IdSource& ids) {
  const auto repetition = repetition_of(world, arguments);
  if (!repetition) return tl::unexpected(repetition.error());
  const world::ObjectId parent = world.find(repetition->object)->parent;
  const world::PhysicalObject* above = world.find(parent);
  Result<Gathering> gathering = Gathering{parent, above ? above->children.size() : world.roots().size()};
  Plan plan{world::EditGroup{}};
  if (arguments.has("into")) gathering = gather(world, *repetition, arguments.text("into"), ids, plan);
  if (!gathering) return tl::unexpected(gathering.error());
  for (std::size_t i = 0; i < repetition->places.size(); ++i)
    if (const auto good = add_copy(world, *repetition, *gathering, i, ids, plan); !good)
      return tl::unexpected(good.error());
  return plan;
}

}  // namespace

Operation repeat_operation() {
  std::vector<Parameter> parameters = {
      {.name = "object", .kind = ParameterKind::Object, .meaning = "what is repeated", .required = true},
      {.name = "count",
       .kind = ParameterKind::Count,
       .meaning = "how many copies; the first is placed, the others follow as it does",
       .required = true,
       .least = 1,
       .most = double(kMostRepeated)},
      optional_place_parameter("pivot",
                               "what stays in place when copies turn and scale, in the object's "
                               "parent, m; else the object's origin"),
      place_parameter("move", "how far the first copy goes, m"),
      turn_parameter("how the first copy is turned: an axis, as long as the angle in degrees")};
  for (Parameter& scale : scale_parameters()) parameters.push_back(std::move(scale));
  parameters.push_back({.name = "how",
                        .kind = ParameterKind::Choice,
                        .meaning = "clones share the object's shape, copies get one of their own",
                        .fallback = "clone",
                        .choices = {"clone", "copy"}});
  parameters.push_back({.name = "into",
                        .kind = ParameterKind::Text,
                        .meaning = "the name of a new group that holds the object and its copies"});
  return {"repeat",
          "Repeat",
          "Shape",
          "Places a copy of an object, and more as the first stands to it: the steps of stairs.",
          std::move(parameters),
          plan_repeat};
}

}  // namespace icome::interaction
