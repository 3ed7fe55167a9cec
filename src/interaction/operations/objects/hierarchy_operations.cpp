#include <fmt/format.h>

#include <map>
#include <unordered_set>

#include "interaction/object_edits.h"
#include "interaction/object_move.h"
#include "interaction/operations/object_frames.h"
#include "interaction/operations/objects/object_operations.h"
#include "interaction/operations/placement.h"
#include "world/row.h"

namespace icome::interaction {
namespace {

using base::fail;
using base::Result;
using world::ObjectId;
using world::World;

Result<Plan> plan_delete(const World& world, const Arguments& arguments, world::IdSource&) {
  return Plan{delete_objects(world, arguments.objects("objects"))};
}

Result<Plan> plan_rename(const World&, const Arguments& arguments, world::IdSource&) {
  const ObjectId id = arguments.object("object");
  if (const auto good = check_name(arguments.text("name")); !good) return tl::unexpected(good.error());
  return Plan{world::RenameObject{id, arguments.text("name")}, {id}};
}

Result<Plan> plan_group(const World& world, const Arguments& arguments, world::IdSource& ids) {
  const std::string name = arguments.has("name") ? arguments.text("name") : unused_name(world, "group");
  if (const auto good = check_name(name); !good) return tl::unexpected(good.error());
  auto grouping = group_objects(world, arguments.objects("objects"), ids);
  if (!grouping) return tl::unexpected(grouping.error());
  world::EditGroup edits;
  edits.edits.push_back(std::move(grouping->edit));
  edits.edits.emplace_back(world::RenameObject{grouping->group, name});
  return Plan{std::move(edits), {grouping->group}};
}

// ---- Ungroup ------------------------------------------------------------------------------------------

Result<void> check_group(const World& world, ObjectId id) {
  const world::PhysicalObject& group = *world.find(id);
  if (group.children.empty())
    return fail(fmt::format("{} is no group: there is nothing below it", called(world, id)));
  if (group.geometry || group.fixture)
    return fail(
        fmt::format("{} is more than a group: put what is below it elsewhere instead", called(world, id)));
  return {};
}

/// Gives the group's place in every scene that holds it to the objects in it.
void hand_over_scenes(const World& world, ObjectId id, std::vector<world::Edit>& edits) {
  for (const auto& [scene, it] : world.scenes()) {
    std::size_t place = world::place_of(it.roots, id);
    if (place == it.roots.size()) continue;
    edits.emplace_back(world::LeaveScene{scene, id});
    for (const ObjectId child : world.find(id)->children)
      if (world::place_of(it.roots, child) == it.roots.size())
        edits.emplace_back(world::EnterScene{scene, child, place++});
  }
}

/// `place` is the group's among its siblings once the groups before it are gone.
void dissolve(const World& world, ObjectId id, std::size_t place, std::vector<world::Edit>& edits) {
  const world::PhysicalObject& group = *world.find(id);
  if (group.scenes > 0) hand_over_scenes(world, id, edits);
  for (const ObjectId child : group.children)
    edits.emplace_back(world::MoveObject{child, group.parent, place++,
                                         group.parent_from_object * world.find(child)->parent_from_object});
  edits.emplace_back(world::DeleteObject{id});
}

Result<Plan> plan_ungroup(const World& world, const Arguments& arguments, world::IdSource&) {
  const std::vector<ObjectId> groups = topmost(world, arguments.objects("objects"));
  // Sorted by their places, so that each knows how many more came before it.
  std::map<ObjectId, std::map<std::size_t, ObjectId>> rows;
  for (const ObjectId id : groups) {
    if (const auto good = check_group(world, id); !good) return tl::unexpected(good.error());
    const ObjectId parent = world.find(id)->parent;
    const std::vector<ObjectId>& row = parent ? world.find(parent)->children : world.roots();
    rows[parent][world::place_near(row, id, world.find(id)->place_hint)] = id;
  }
  Plan plan{world::EditGroup{}};
  for (const auto& [parent, row] : rows) {
    std::size_t more = 0;
    for (const auto& [place, id] : row) {
      dissolve(world, id, place + more, std::get<world::EditGroup>(plan.edit.what).edits);
      const std::vector<ObjectId>& children = world.find(id)->children;
      plan.objects.insert(plan.objects.end(), children.begin(), children.end());
      more += children.size() - 1;
    }
  }
  return plan;
}

Result<Plan> plan_put(const World& world, const Arguments& arguments, world::IdSource&) {
  const std::vector<ObjectId> objects = topmost(world, arguments.objects("objects"));
  const ObjectId parent = arguments.has("parent") ? arguments.object("parent") : ObjectId();
  const std::size_t last = parent ? world.find(parent)->children.size() : world.roots().size();
  const std::size_t place = arguments.has("place") ? std::size_t(arguments.count("place")) : last;
  auto edit = put_under(world, objects, parent, place);
  if (!edit) return tl::unexpected(edit.error());
  return Plan{std::move(*edit), objects};
}

Parameter objects_parameter(std::string meaning) {
  return {.name = "objects", .kind = ParameterKind::Objects, .meaning = std::move(meaning), .required = true};
}

}  // namespace

std::vector<Operation> hierarchy_operations() {
  const Parameter name{.name = "name", .kind = ParameterKind::Text, .meaning = "what it is called then"};
  Parameter new_name = name;
  new_name.required = true;
  return {{"delete",
           "Delete",
           "Arrange",
           "Takes objects away with all below them.",
           {objects_parameter("what goes")},
           plan_delete},
          {"rename",
           "Rename",
           "Arrange",
           "Calls an object something else.",
           {{.name = "object", .kind = ParameterKind::Object, .meaning = "which one", .required = true},
            new_name},
           plan_rename},
          {"group",
           "Group",
           "Arrange",
           "Puts objects under a new one that stands in the middle of them; they stay where they are.",
           {objects_parameter("what belongs together"), name},
           plan_group},
          {"ungroup",
           "Ungroup",
           "Arrange",
           "Takes groups away; what was in them stays where it is.",
           {objects_parameter("the groups, which have no shape of their own")},
           plan_ungroup},
          {"put",
           "Put under",
           "Arrange",
           "Makes objects belong to another one, or stand for themselves; they stay where they are.",
           {objects_parameter("what is put there"),
            {.name = "parent",
             .kind = ParameterKind::Object,
             .meaning = "the object that they belong to then; else they stand for themselves"},
            {.name = "place",
             .kind = ParameterKind::Count,
             .meaning = "before which of those that are there, counted from 0; else behind the last",
             .least = 0.0}},
           plan_put}};
}

}  // namespace icome::interaction
