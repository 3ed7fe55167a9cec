#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "interaction/operations/object_frames.h"
#include "interaction/operations/objects/object_operations.h"
#include "interaction/operations/objects/path_places.h"
#include "interaction/operations/placement.h"
#include "world/edit/copy.h"

namespace icome::interaction {
namespace {

using base::Affine3;
using base::fail;
using base::Result;
using world::Duplicate;
using world::ObjectId;
using world::World;

constexpr std::size_t kMostAlong = 10'000;    // duplicates of one call
constexpr std::size_t kMostMade = 1'000'000;  // objects of one call

struct NamedWay {
  const char* name;
  Duplicate how;
};

constexpr std::array<NamedWay, 6> kWays{{{"copy-object", Duplicate::CopyObject},
                                         {"copy-object-and-children", Duplicate::CopyObjectAndChildren},
                                         {"clone-object", Duplicate::CloneObject},
                                         {"clone-object-and-children", Duplicate::CloneObjectAndChildren},
                                         {"copy-object-clone-children", Duplicate::CopyObjectCloneChildren},
                                         {"clone-object-copy-children", Duplicate::CloneObjectCopyChildren}}};

Duplicate way_named(const std::string& name) {
  for (const NamedWay& way : kWays)
    if (name == way.name) return way.how;
  return Duplicate::CopyObject;  // a Choice is one of them
}

/// The edit in a duplication that makes the duplicate itself.
world::CreateObject& creation_of(world::Duplication& duplication) {
  auto& edits = std::get<world::EditGroup>(duplication.edit.what).edits;
  const auto makes_it = [&](const world::Edit& edit) {
    const auto* create = std::get_if<world::CreateObject>(&edit.what);
    return create && create->id == duplication.object;
  };
  return std::get<world::CreateObject>(std::ranges::find_if(edits, makes_it)->what);
}

/// The name to which duplicates add a number.
std::string stem_of(const world::PhysicalObject& model) { return model.name.empty() ? "object" : model.name; }

/// Fails for too many objects: a model that holds its own clones doubles each time that it is cloned.
Result<void> check_count(const World& world, ObjectId model, std::size_t count) {
  if (count <= kMostMade / world::subtree(world, model).size()) return {};
  return fail(fmt::format("that would be more than {} objects: make fewer", kMostMade));
}

// ---- Clone and copy -----------------------------------------------------------------------------------

/// Place of a model's duplicate under a parent.
Result<Affine3> place_of_duplicate(const World& world, const Arguments& arguments, ObjectId model,
                                   ObjectId parent) {
  if (arguments.has("at") && arguments.has("by"))
    return fail("say 'at' or 'by', not both: where it stands in its parent, or how far from its model");
  Affine3 place = world.find(model)->parent_from_object;
  if (arguments.has("at")) place.translation() = arguments.vector("at");
  if (!arguments.has("by")) return place;
  const Affine3 frame = parent ? world::world_from_object(world, parent) : Affine3::Identity();
  const Affine3 parent_from_world = frame.inverse();
  if (!parent_from_world.matrix().allFinite())
    return fail(fmt::format("{} is shrunk to nothing: nothing can be moved in it", called(world, parent)));
  place.translation() += parent_from_world.linear() * arguments.vector("by");
  return place;
}

Result<Plan> plan_duplicate(const World& world, const Arguments& arguments, world::IdSource& ids) {
  const ObjectId model = arguments.object("object");
  if (const auto good = check_count(world, model, 1); !good) return tl::unexpected(good.error());
  const world::PhysicalObject& object = *world.find(model);
  const ObjectId parent = arguments.has("parent") ? arguments.object("parent") : object.parent;
  const auto place = place_of_duplicate(world, arguments, model, parent);
  if (!place) return tl::unexpected(place.error());
  const std::string name =
      arguments.has("name") ? arguments.text("name") : unused_name(world, stem_of(object));
  if (arguments.has("name"))
    if (const auto good = check_name(name); !good) return tl::unexpected(good.error());
  auto made = world::duplicate(world, model, way_named(arguments.text("mode")), parent, ids);
  if (!made) return tl::unexpected(made.error());
  world::CreateObject& creation = creation_of(*made);
  creation.object.name = name;
  creation.object.parent_from_object = *place;
  return Plan{std::move(made->edit), {made->object}};
}

// ---- Along a path -------------------------------------------------------------------------------------

/// The path that was given (m, world frame), and whether the model stands at its beginning.
struct SaidPath {
  std::vector<Vector3> points;
  bool from_model = false;
};

Result<SaidPath> said_path(const World& world, const Arguments& arguments, ObjectId model) {
  const bool ends = arguments.has("from") || arguments.has("to");
  if (arguments.has("path") == ends) return fail("say 'path', or 'to' and maybe 'from'");
  if (arguments.has("path")) return SaidPath{arguments.points3("path")};
  if (!arguments.has("to")) return fail("'to' is missing: where the last one stands");
  if (arguments.has("from")) return SaidPath{{arguments.vector("from"), arguments.vector("to")}};
  return SaidPath{{world::world_from_object(world, model).translation(), arguments.vector("to")}, true};
}

Result<std::vector<PathPlace>> said_places(const World& world, const Arguments& arguments, ObjectId model) {
  const auto path = said_path(world, arguments, model);
  if (!path) return tl::unexpected(path.error());
  const auto count = std::size_t(arguments.count("count"));
  auto places = places_along(path->points, count + (path->from_model ? 1 : 0));
  if (places && path->from_model) places->erase(places->begin());
  return places;
}

/// Plans duplicates that stand one behind the other among their siblings.
class Row {
 public:
  Row(const World& world, ObjectId model, Duplicate how, world::IdSource& ids)
      : world_(world), model_(model), how_(how), ids_(ids) {}

  Result<void> add(const Affine3& parent_from_duplicate, std::string name) {
    auto made = world::duplicate(world_, model_, how_, world_.find(model_)->parent, ids_);
    if (!made) return tl::unexpected(made.error());
    world::CreateObject& creation = creation_of(*made);
    creation.place += plan_.objects.size();
    creation.object.name = std::move(name);
    creation.object.parent_from_object = parent_from_duplicate;
    auto& edits = std::get<world::EditGroup>(plan_.edit.what).edits;
    std::ranges::move(std::get<world::EditGroup>(made->edit.what).edits, std::back_inserter(edits));
    plan_.objects.push_back(made->object);
    return {};
  }
  Plan take() { return std::move(plan_); }

 private:
  const World& world_;
  ObjectId model_;
  Duplicate how_;
  world::IdSource& ids_;
  Plan plan_{world::EditGroup{}};
};

Result<Plan> plan_duplicate_along(const World& world, const Arguments& arguments, world::IdSource& ids) {
  const ObjectId model = arguments.object("object");
  const auto count = std::size_t(arguments.count("count"));
  if (const auto good = check_count(world, model, count); !good) return tl::unexpected(good.error());
  const auto places = said_places(world, arguments, model);
  if (!places) return tl::unexpected(places.error());
  const auto parent = parent_from_world(world, model);
  if (!parent) return tl::unexpected(parent.error());
  const Affine3 world_from_model = world::world_from_object(world, model);
  const bool clones = arguments.text("mode") == "clone";
  Row row(world, model, clones ? Duplicate::CloneObjectAndChildren : Duplicate::CopyObjectAndChildren, ids);
  const std::vector<std::string> names = unused_names(world, stem_of(*world.find(model)), count);
  for (std::size_t i = 0; i < count; ++i) {
    Affine3 there = world_from_model;
    if (arguments.flag("along-tangent")) there.linear() = (*places)[i].turn * there.linear();
    there.translation() = (*places)[i].at;
    if (const auto added = row.add(*parent * there, names[i]); !added) return tl::unexpected(added.error());
  }
  return row.take();
}

Parameter model_parameter() {
  return {.name = "object",
          .kind = ParameterKind::Object,
          .meaning = "the model, with all below it",
          .required = true};
}

Operation duplicate_operation(const char* name, const char* title, const char* summary, const char* mode) {
  std::vector<std::string> modes;
  for (const NamedWay& way : kWays) modes.emplace_back(way.name);
  return {name,
          title,
          "Duplicate",
          summary,
          {model_parameter(),
           {.name = "mode",
            .kind = ParameterKind::Choice,
            .meaning = "what gets a shape of its own (copy) and what shares its model's (clone); children "
                       "are all that is below, left out where they are not named",
            .fallback = mode,
            .choices = modes},
           {.name = "name",
            .kind = ParameterKind::Text,
            .meaning = "what it is called; else as its model, with a number"},
           {.name = "parent",
            .kind = ParameterKind::Object,
            .meaning = "what it belongs to, standing there as its model does in its own; else to the same"},
           optional_place_parameter("at", "where its origin stands in its parent, m; instead of by"),
           optional_place_parameter("by", "how far from its model along the axes of the world, m")},
          plan_duplicate};
}

Operation along_operation() {
  return {
      "duplicate-along",
      "Duplicate along",
      "Duplicate",
      "Puts duplicates at equal distances along a path in the world.",
      {model_parameter(),
       {.name = "count",
        .kind = ParameterKind::Count,
        .meaning = "how many are made",
        .required = true,
        .least = 1.0,
        .most = double(kMostAlong)},
       {.name = "path",
        .kind = ParameterKind::Points,
        .meaning = "the first and the last stand at its ends, m in the world; where it ends as it begins, "
                   "the last stands before that",
        .least = -kFarthestPlace,
        .most = kFarthestPlace},
       optional_place_parameter("to", "where the last stands, m in the world; instead of path"),
       optional_place_parameter("from",
                                "where the first stands, m in the world; else the model is the first, "
                                "and as many more are made"),
       {.name = "mode",
        .kind = ParameterKind::Choice,
        .meaning = "do they share the model's shapes or get their own",
        .fallback = "clone",
        .choices = {"clone", "copy"}},
       {.name = "along-tangent",
        .kind = ParameterKind::Flag,
        .meaning = "turn each as the path turns from its beginning to there",
        .fallback = false}},
      plan_duplicate_along};
}

}  // namespace

std::vector<Operation> duplicate_operations() {
  return {
      duplicate_operation("clone", "Clone",
                          "Makes an object that shares shapes with its model: change one, and all change.",
                          "clone-object-and-children"),
      duplicate_operation("copy", "Copy", "Makes an object of shapes of its own that equal its model's.",
                          "copy-object-and-children"),
      along_operation()};
}

}  // namespace icome::interaction
