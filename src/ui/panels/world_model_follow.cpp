#include <QScopedValueRollback>
#include <algorithm>
#include <map>
#include <unordered_set>

#include "ui/panels/world_model.h"
#include "world/row.h"

// The steps by which the rows of a WorldModel follow a world that has changed. The world is there already;
// the rows follow in steps, and views look at them between any two.

namespace icome::ui {

using world::ObjectId;

namespace {

std::size_t depth_of(const world::World& world, ObjectId object) {
  std::size_t depth = 0;
  for (ObjectId id = object; id; ++depth) id = world.find(id)->parent;
  return depth;
}

/// Calls `run(first, last)` for each run of adjacent rows, from the last run to the first: changing a run
/// leaves the numbers of the rows before it as they are.
template <typename Run>
void for_runs(std::vector<int>& rows, const Run& run) {
  std::sort(rows.begin(), rows.end());
  for (std::size_t end = rows.size(); end > 0;) {
    std::size_t begin = end - 1;
    while (begin > 0 && rows[begin - 1] + 1 == rows[begin]) --begin;
    run(rows[begin], rows[end - 1]);
    end = begin;
  }
}

}  // namespace

void WorldModel::follow(const world::Changes* changes) {
  if (!changes) return reset();
  const bool unseen = std::any_of(changes->objects.begin(), changes->objects.end(),
                                  [this](ObjectId id) { return !nodes_.contains(id); });
  {
    const QScopedValueRollback<bool> changing(changing_, true);
    remove_rows(take_moves(*changes));
    for (const ObjectId parent : parents_to_arrange(*changes)) arrange(parent);
  }
  if (unseen) note_childless();
  announce(*changes);
}

/// Moves rows to their new parents where these have rows; returns the objects that have no row any more.
std::vector<ObjectId> WorldModel::take_moves(const world::Changes& changes) {
  std::vector<ObjectId> gone;
  std::vector<std::pair<std::size_t, ObjectId>> moved;  // with their depths
  for (const ObjectId id : changes.objects) {
    const auto node = nodes_.find(id);
    if (!id || node == nodes_.end()) continue;
    const world::PhysicalObject* object = world().find(id);
    if (!object) {
      gone.push_back(id);
    } else if (object->parent != node->second.parent) {
      moved.emplace_back(depth_of(world(), id), id);
    }
  }
  // From the top down: when a row moves, the rows above its target are right already.
  std::sort(moved.begin(), moved.end());
  for (const auto& [depth, id] : moved) {
    const ObjectId parent = world().find(id)->parent;
    const auto target = nodes_.find(parent);
    const bool has_rows = target != nodes_.end() && target->second.fetched;
    if (has_rows && !is_shown_within(parent, id)) {
      move_row(id, parent);
    } else {
      gone.push_back(id);
    }
  }
  return gone;
}

bool WorldModel::is_shown_within(ObjectId object, ObjectId ancestor) const {
  while (object && object != ancestor) object = nodes_.at(object).parent;
  return object == ancestor;
}

/// Puts the row behind the nearest sibling before it that has a row; arrange() sees to the rest.
void WorldModel::move_row(ObjectId object, ObjectId parent) {
  const std::vector<ObjectId>& wanted = children_of(parent);
  const world::PhysicalObject& it = *world().find(object);
  std::size_t place = world::place_near(wanted, object, it.place_hint);
  std::size_t row = 0;
  for (; place > 0; --place) {
    const auto before = nodes_.find(wanted[place - 1]);
    if (before == nodes_.end() || before->second.parent != parent) continue;
    row = std::size_t(row_of(wanted[place - 1])) + 1;
    break;
  }
  const int from = row_of(object);
  Node& node = nodes_.at(object);
  beginMoveRows(known_index(node.parent), from, from, known_index(parent), int(row));
  std::vector<ObjectId>& left = nodes_.at(node.parent).children;
  left.erase(left.begin() + from);
  world::insert(nodes_.at(parent).children, row, object);
  node.parent = parent;
  node.hint = std::uint32_t(row);
  endMoveRows();
}

void WorldModel::remove_rows(const std::vector<ObjectId>& gone) {
  const std::unordered_set<ObjectId> all(gone.begin(), gone.end());
  std::map<ObjectId, std::vector<int>> rows;  // by parent
  for (const ObjectId id : gone) {
    const ObjectId parent = nodes_.at(id).parent;
    if (!all.contains(parent)) rows[parent].push_back(row_of(id));  // else it goes with its parent
  }
  for (auto& [parent, of_parent] : rows) {
    const ObjectId from = parent;
    if (!nodes_.contains(from)) continue;  // removed with an ancestor
    for_runs(of_parent, [&](int first, int last) { remove_run(from, first, last); });
  }
}

void WorldModel::remove_run(ObjectId parent, int first, int last) {
  beginRemoveRows(known_index(parent), first, last);
  std::vector<ObjectId>& children = nodes_.at(parent).children;
  const auto begin = children.begin() + first, end = children.begin() + last + 1;
  const std::vector<ObjectId> taken(begin, end);
  children.erase(begin, end);
  for (const ObjectId id : taken) forget(id);
  endRemoveRows();
}

void WorldModel::forget(ObjectId object) {
  std::vector<ObjectId> due{object};
  while (!due.empty()) {
    const auto node = nodes_.find(due.back());
    due.pop_back();
    due.insert(due.end(), node->second.children.begin(), node->second.children.end());
    nodes_.erase(node);
  }
}

/// Parents with fetched rows that do not match their children any more.
std::vector<ObjectId> WorldModel::parents_to_arrange(const world::Changes& changes) const {
  std::vector<ObjectId> parents;
  for (const ObjectId id : changes.objects) {
    const world::PhysicalObject* object = world().find(id);
    if (!object) continue;
    const auto parent = nodes_.find(object->parent);
    if (parent == nodes_.end() || !parent->second.fetched) continue;
    const std::vector<ObjectId>& wanted = children_of(object->parent);
    const std::vector<ObjectId>& rows = parent->second.children;
    const bool in_place =
        nodes_.contains(id) && rows.size() == wanted.size() && wanted[std::size_t(row_of(id))] == id;
    if (!in_place) parents.push_back(object->parent);
  }
  std::sort(parents.begin(), parents.end());
  parents.erase(std::unique(parents.begin(), parents.end()), parents.end());
  return parents;
}

/// Inserts and moves rows until they are the parent's children, in their order.
void WorldModel::arrange(ObjectId parent) {
  const std::vector<ObjectId>& wanted = children_of(parent);
  for (std::size_t i = 0; i < wanted.size();) {
    const std::vector<ObjectId>& rows = nodes_.at(parent).children;
    if (i < rows.size() && rows[i] == wanted[i]) {
      ++i;
    } else if (!nodes_.contains(wanted[i])) {
      i = insert_run(parent, i);
    } else {
      const int from = row_of(wanted[i]);
      beginMoveRows(known_index(parent), from, from, known_index(parent), int(i));
      std::vector<ObjectId>& children = nodes_.at(parent).children;
      children.erase(children.begin() + from);
      world::insert(children, i, wanted[i]);
      nodes_.at(wanted[i]).hint = std::uint32_t(i);
      endMoveRows();
      ++i;
    }
  }
}

/// Inserts rows for the children without one, from place `first` on; returns the place behind them.
std::size_t WorldModel::insert_run(ObjectId parent, std::size_t first) {
  const std::vector<ObjectId>& wanted = children_of(parent);
  std::size_t end = first;
  while (end < wanted.size() && !nodes_.contains(wanted[end])) ++end;
  beginInsertRows(known_index(parent), int(first), int(end) - 1);
  std::vector<ObjectId>& children = nodes_.at(parent).children;
  children.insert(children.begin() + std::ptrdiff_t(first), wanted.begin() + std::ptrdiff_t(first),
                  wanted.begin() + std::ptrdiff_t(end));
  for (std::size_t i = first; i < end; ++i) add_node(wanted[i], parent).hint = std::uint32_t(i);
  endInsertRows();
  return end;
}

/// Marks objects that have lost children before these were fetched; views learn that from the layout only.
void WorldModel::note_childless() {
  bool found = false;
  for (auto& [id, node] : nodes_) {
    if (node.fetched || !children_of(id).empty()) continue;
    node.fetched = true;
    found = true;
  }
  if (!found) return;
  emit layoutAboutToBeChanged();
  emit layoutChanged();
}

/// Tells views which rows look different.
void WorldModel::announce(const world::Changes& changes) {
  std::map<ObjectId, std::vector<int>> rows;  // by parent
  for (const ObjectId id : changes.objects) {
    const auto node = nodes_.find(id);
    if (id && node != nodes_.end()) rows[node->second.parent].push_back(row_of(id));
  }
  for (auto& [parent, of_parent] : rows) {
    const QModelIndex above = known_index(parent);
    for_runs(of_parent,
             [&](int first, int last) { emit dataChanged(index(first, 0, above), index(last, 0, above)); });
  }
  // A shared shape or material may show in any row.
  const bool shared = !changes.geometries.empty() || !changes.materials.empty();
  if (shared && rowCount() > 0) emit dataChanged(index(0, 0), index(rowCount() - 1, 0));
}

}  // namespace icome::ui
