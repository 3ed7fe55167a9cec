// Upkeep of a CollisionIndex: its bounds and shapes follow the edits of the world.
#include <algorithm>
#include <utility>

#include "world/collision/collisions.h"

namespace icome::world {

CollisionIndex::CollisionIndex(const World& world) : nodes_(1) {
  std::vector<Slot> nothing_left;
  for (const auto& [id, object] : world.objects())
    link(reach(world, id), object.parent ? reach(world, object.parent) : kWorld, nothing_left);
  for (const ObjectId root : world.roots()) renew(world, slots_.at(root));
}

void CollisionIndex::follow(const World& world, const Changes& changes) {
  std::vector<Slot> shrunk;  // slots that lost a child
  std::vector<Slot> stale;
  for (const ObjectId id : changes.objects) {
    const PhysicalObject* object = world.find(id);
    if (!object) continue;
    const Slot slot = reach(world, id);
    link(slot, object->parent ? reach(world, object->parent) : kWorld, shrunk);
    stale.push_back(slot);
  }
  // Surviving objects below the deleted ones have been linked to other parents by now.
  drop_missing(world, changes.objects, shrunk);
  for (const GeometryId id : changes.geometries) {
    const auto found = shapes_.find(id);
    if (found == shapes_.end() || !world.find(id)) continue;
    change_shape(found->second, world.find(id)->shape);
    stale.insert(stale.end(), found->second.users.begin(), found->second.users.end());
  }
  renew_all(world, stale);
  for (const Slot slot : shrunk) {
    if (slot == kWorld || nodes_[slot].id) renew_upwards(slot);
  }
}

/// Uppermost slots first: a subtree is traversed once, however many of its slots are stale.
void CollisionIndex::renew_all(const World& world, const std::vector<Slot>& stale) {
  std::vector<std::pair<std::size_t, Slot>> by_depth;
  for (const Slot slot : stale) {
    nodes_[slot].stale = true;
    std::size_t depth = 0;
    for (Slot at = slot; at != kWorld; at = nodes_[at].parent) ++depth;
    by_depth.emplace_back(depth, slot);
  }
  std::sort(by_depth.begin(), by_depth.end());
  for (const auto& [depth, slot] : by_depth) {
    if (nodes_[slot].stale) renew(world, slot);
  }
}

/// The object's slot, made if it has none.
CollisionIndex::Slot CollisionIndex::reach(const World& world, ObjectId id) {
  const auto [found, fresh] = slots_.try_emplace(id);
  if (!fresh) return found->second;
  if (free_.empty()) {
    found->second = Slot(nodes_.size());
    nodes_.emplace_back();
  } else {
    found->second = free_.back();
    free_.pop_back();
    nodes_[found->second] = {};
  }
  const Slot slot = found->second;
  nodes_[slot].id = id;
  nodes_[slot].stale = true;
  choose_shape(world, slot, world.find(id)->geometry);
  return slot;
}

void CollisionIndex::drop_missing(const World& world, const std::vector<ObjectId>& ids,
                                  std::vector<Slot>& shrunk) {
  std::vector<Slot> missing;
  for (const ObjectId id : ids) {
    const auto found = slots_.find(id);
    if (found == slots_.end() || world.find(id)) continue;
    missing.push_back(found->second);
    slots_.erase(found);
  }
  for (const Slot slot : missing) {
    shrunk.push_back(nodes_[slot].parent);
    leave_row(slot);
    let_shape_go(slot);
  }
  for (const Slot slot : missing) nodes_[slot] = {};
  free_.insert(free_.end(), missing.begin(), missing.end());
}

void CollisionIndex::leave_row(Slot slot) {
  Node& node = nodes_[slot];
  if (node.leaf == BoundsTree::kNone) return;
  nodes_[node.parent].children.remove(node.leaf);
  node.leaf = BoundsTree::kNone;
}

void CollisionIndex::link(Slot slot, Slot parent, std::vector<Slot>& shrunk) {
  Node& node = nodes_[slot];
  if (node.parent == parent) return;
  if (node.parent != kNone) shrunk.push_back(node.parent);
  leave_row(slot);
  node.parent = parent;
}

void CollisionIndex::let_shape_go(Slot slot) {
  Node& node = nodes_[slot];
  if (!node.geometry) return;
  const auto found = shapes_.find(node.geometry);
  std::vector<Slot>& users = found->second.users;
  users[node.user] = users.back();
  nodes_[users[node.user]].user = node.user;
  users.pop_back();
  if (found->second.shape.unlimited())
    unlimited_.erase(std::find(unlimited_.begin(), unlimited_.end(), slot));
  if (users.empty()) shapes_.erase(found);
  node.geometry = {};
}

void CollisionIndex::change_shape(Shape& of, const GeometryPointer& shape) {
  const bool before = of.shape.unlimited();
  of.shape = CollisionShape(shape);
  if (before == of.shape.unlimited()) return;
  for (const Slot slot : of.users) {
    if (before)
      unlimited_.erase(std::find(unlimited_.begin(), unlimited_.end(), slot));
    else
      unlimited_.push_back(slot);
  }
}

void CollisionIndex::choose_shape(const World& world, Slot slot, GeometryId geometry) {
  if (nodes_[slot].geometry == geometry) return;
  let_shape_go(slot);
  if (!geometry) return;
  auto found = shapes_.find(geometry);
  if (found == shapes_.end())
    found = shapes_.emplace(geometry, Shape{CollisionShape(world.find(geometry)->shape), {}}).first;
  nodes_[slot].geometry = geometry;
  nodes_[slot].user = found->second.users.size();
  found->second.users.push_back(slot);
  if (found->second.shape.unlimited()) unlimited_.push_back(slot);
}

/// Renews the places and bounds of a subtree, and the bounds of all nodes above it.
void CollisionIndex::renew(const World& world, Slot top) {
  std::vector<Slot> order{top};
  for (std::size_t i = 0; i < order.size(); ++i) {
    renew_place(world, order[i]);
    for (const ObjectId child : world.find(nodes_[order[i]].id)->children) order.push_back(slots_.at(child));
  }
  for (std::size_t i = order.size(); i-- > 0;) renew_bounds(order[i]);
  renew_upwards(nodes_[top].parent);
}

void CollisionIndex::renew_place(const World& world, Slot slot) {
  const PhysicalObject& object = *world.find(nodes_[slot].id);
  choose_shape(world, slot, object.geometry);
  Node& node = nodes_[slot];
  node.stale = false;
  node.world_from_object = nodes_[node.parent].world_from_object * object.parent_from_object;
  node.own.setEmpty();
  if (!node.geometry) return;
  const CollisionShape& shape = shapes_.at(node.geometry).shape;
  if (!shape.unlimited() && !shape.bounds().isEmpty())
    node.own = shape.bounds().transformed(node.world_from_object);
}

/// Returns whether the bounds, or their entry in the parent's tree, had to change.
bool CollisionIndex::renew_bounds(Slot slot) {
  Node& node = nodes_[slot];
  const Bounds all = node.own.merged(node.children.bounds());
  const bool known = slot == kWorld || all.isEmpty() == (node.leaf == BoundsTree::kNone);
  if (known && all.min() == node.all.min() && all.max() == node.all.max()) return false;
  leave_row(slot);
  node.all = all;
  if (slot != kWorld && !all.isEmpty()) node.leaf = nodes_[node.parent].children.insert(slot, all);
  return true;
}

void CollisionIndex::renew_upwards(Slot slot) {
  while (slot != kNone && renew_bounds(slot)) slot = nodes_[slot].parent;
}

bool CollisionIndex::is_below(Slot slot, Slot above) const {
  for (; slot != kNone; slot = nodes_[slot].parent) {
    if (slot == above) return true;
  }
  return false;
}

Bounds CollisionIndex::bounds(ObjectId root) const {
  const auto found = slots_.find(root);
  return found == slots_.end() ? Bounds() : nodes_[found->second].all;
}

}  // namespace icome::world
