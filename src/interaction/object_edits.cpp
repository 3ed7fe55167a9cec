#include "interaction/object_edits.h"

#include <algorithm>
#include <map>
#include <variant>

#include "interaction/object_move.h"
#include "world/row.h"

namespace icome::interaction {
namespace {

using base::Affine3;
using base::Result;
using world::ObjectId;
using world::World;

const std::vector<ObjectId>& siblings_of(const World& world, ObjectId parent) {
  return parent ? world.find(parent)->children : world.roots();
}

Affine3 place_of_frame(const World& world, ObjectId frame) {
  return frame ? world::world_from_object(world, frame) : Affine3::Identity();
}

/// The inverse. Fails where parents within parents shrink space to nothing, though no place by itself does.
Result<Affine3> inverse_of(const Affine3& world_from_frame) {
  const Affine3 inverse = world_from_frame.inverse();
  if (inverse.matrix().allFinite()) return inverse;
  return base::fail(
      "There the objects cannot stay where they are: the place is shrunk to nothing. Move them "
      "to another one.");
}

std::size_t place_among(const World& world, const std::vector<ObjectId>& siblings, ObjectId id) {
  return world::place_near(siblings, id, world.find(id)->place_hint);
}

/// Collects the edits that delete a subtree but not its shapes, and counts the users that each shape loses.
void take_subtree(const World& world, ObjectId root, std::vector<world::Edit>& edits,
                  std::map<world::GeometryId, std::uint32_t>& let_go) {
  world::Edit subtree = world::delete_subtree(world, root);
  for (world::Edit& edit : std::get<world::EditGroup>(subtree.what).edits) {
    if (std::holds_alternative<world::DeleteGeometry>(edit.what)) continue;
    if (const auto* object = std::get_if<world::DeleteObject>(&edit.what)) {
      const world::GeometryId shape = world.find(object->id)->geometry;
      if (shape) ++let_go[shape];
    }
    edits.push_back(std::move(edit));
  }
}

}  // namespace

world::Edit delete_objects(const World& world, std::span<const ObjectId> objects) {
  world::EditGroup group;
  std::map<world::GeometryId, std::uint32_t> let_go;
  for (const ObjectId root : topmost(world, objects)) take_subtree(world, root, group.edits, let_go);
  for (const auto& [shape, users] : let_go) {
    if (world.find(shape)->users == users) group.edits.push_back(world::DeleteGeometry{shape});
  }
  return group;
}

Result<world::Edit> put_under(const World& world, std::span<const ObjectId> objects, ObjectId parent,
                              std::size_t place) {
  if (parent && !world.find(parent)) return base::fail("The object to put them under is not there any more.");
  const std::vector<ObjectId> moved = topmost(world, objects);
  const auto holds_parent = [&](ObjectId id) { return world::is_within(world, parent, id); };
  if (parent && std::any_of(moved.begin(), moved.end(), holds_parent))
    return base::fail("An object cannot go under itself or under what is below it.");
  const auto parent_from_world = inverse_of(place_of_frame(world, parent));
  if (!parent_from_world) return tl::unexpected(parent_from_world.error());

  // Places count siblings-to-be: those that are moved do not stand in their own way.
  const std::vector<ObjectId>& siblings = siblings_of(world, parent);
  place = std::min(place, siblings.size());
  std::size_t next = place;
  for (const ObjectId id : moved) {
    const std::size_t now =
        world.find(id)->parent == parent ? place_among(world, siblings, id) : siblings.size();
    if (now < place) --next;
  }
  world::EditGroup group;
  std::size_t still_before = place - next;  // of those that move, in front of where they go
  for (const ObjectId id : moved) {
    const bool stays = world.find(id)->parent == parent;
    if (stays && place_among(world, siblings, id) < place) --still_before;
    const Affine3 now = stays ? world.find(id)->parent_from_object
                              : Affine3(*parent_from_world * world::world_from_object(world, id));
    group.edits.push_back(world::MoveObject{id, parent, next++ + still_before, now});
  }
  return group;
}

Result<Grouping> group_objects(const World& world, std::span<const ObjectId> objects, world::IdSource& ids) {
  const std::vector<ObjectId> members = topmost(world, objects);
  if (members.empty()) return base::fail("Select the objects to group first.");
  const ObjectId parent = world.find(members.front())->parent;
  const auto parent_from_world = inverse_of(place_of_frame(world, parent));
  if (!parent_from_world) return tl::unexpected(parent_from_world.error());
  base::Bounds around;
  for (const ObjectId id : members) around.extend(world::bounds(world, id));
  world::PhysicalObject group;
  group.parent = parent;
  if (!around.isEmpty()) group.parent_from_object.translation() = *parent_from_world * around.center();

  const Affine3 group_from_world = group.parent_from_object.inverse() * *parent_from_world;
  const ObjectId id = ids.next<ObjectId>();
  world::EditGroup edits;
  const std::size_t place = place_among(world, siblings_of(world, parent), members.front());
  edits.edits.push_back(world::CreateObject{id, place, group});
  std::size_t next = 0;
  for (const ObjectId member : members) {
    const Affine3 now = group_from_world * world::world_from_object(world, member);
    edits.edits.push_back(world::MoveObject{member, id, next++, now});
  }
  return Grouping{std::move(edits), id};
}

}  // namespace icome::interaction
