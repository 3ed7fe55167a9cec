#include "ui/panels/world_model.h"

#include <QScopedValueRollback>
#include <algorithm>

#include "interaction/object_edits.h"
#include "ui/panels/object_look.h"
#include "world/row.h"

namespace icome::ui {

using world::ObjectId;

WorldModel::WorldModel(session::Session& session, QObject* parent) : ObjectModel(session, parent) { reset(); }

void WorldModel::reset() {
  beginResetModel();
  nodes_.clear();
  nodes_[ObjectId{}];
  endResetModel();
  fetch({});
}

const std::vector<ObjectId>& WorldModel::children_of(ObjectId object) const {
  static const std::vector<ObjectId> kNone;
  if (!object) return world().roots();
  const world::PhysicalObject* it = world().find(object);
  return it ? it->children : kNone;
}

WorldModel::Node& WorldModel::add_node(ObjectId object, ObjectId parent) {
  Node& node = nodes_[object];
  node = Node{};
  node.parent = parent;
  node.fetched = children_of(object).empty();  // later children are announced
  return node;
}

int WorldModel::row_of(ObjectId object) const {
  const Node& node = nodes_.at(object);
  node.hint = std::uint32_t(world::place_near(nodes_.at(node.parent).children, object, node.hint));
  return int(node.hint);
}

/// Index of an object that has a row.
QModelIndex WorldModel::known_index(ObjectId object) const {
  return object ? createIndex(row_of(object), 0, quintptr(object.value)) : QModelIndex();
}

QModelIndex WorldModel::index_of(ObjectId object) {
  const world::PhysicalObject* it = world().find(object);
  if (!it) return {};
  std::vector<ObjectId> above;
  for (; it->parent; it = world().find(it->parent)) above.push_back(it->parent);
  // From the top down: children of an object can be fetched once it has a row.
  fetch({});
  for (; !above.empty(); above.pop_back()) fetch(above.back());
  return nodes_.contains(object) ? known_index(object) : QModelIndex();
}

QModelIndex WorldModel::index(int row, int column, const QModelIndex& parent) const {
  const auto found = nodes_.find(object(parent));
  if (column != 0 || row < 0 || parent.column() > 0 || found == nodes_.end()) return {};
  const std::vector<ObjectId>& children = found->second.children;
  if (std::size_t(row) >= children.size()) return {};
  return createIndex(row, 0, quintptr(children[std::size_t(row)].value));
}

QModelIndex WorldModel::parent(const QModelIndex& index) const {
  const auto found = nodes_.find(object(index));
  return index.isValid() && found != nodes_.end() ? known_index(found->second.parent) : QModelIndex();
}

int WorldModel::rowCount(const QModelIndex& parent) const {
  const auto found = nodes_.find(object(parent));
  return parent.column() > 0 || found == nodes_.end() ? 0 : int(found->second.children.size());
}

bool WorldModel::hasChildren(const QModelIndex& parent) const {
  const auto found = nodes_.find(object(parent));
  if (parent.column() > 0 || found == nodes_.end()) return false;
  return found->second.fetched ? !found->second.children.empty() : !children_of(object(parent)).empty();
}

bool WorldModel::canFetchMore(const QModelIndex& parent) const {
  const auto found = nodes_.find(object(parent));
  return !changing_ && parent.column() <= 0 && found != nodes_.end() && !found->second.fetched;
}

void WorldModel::fetchMore(const QModelIndex& parent) { fetch(object(parent)); }

void WorldModel::fetch(ObjectId parent) {
  const auto found = nodes_.find(parent);
  if (changing_ || found == nodes_.end() || found->second.fetched) return;
  const std::vector<ObjectId>& children = children_of(parent);
  if (children.empty()) {
    found->second.fetched = true;
    return;
  }
  const QScopedValueRollback<bool> changing(changing_, true);
  beginInsertRows(known_index(parent), 0, int(children.size()) - 1);
  found->second.fetched = true;
  found->second.children = children;
  for (std::size_t i = 0; i < children.size(); ++i) add_node(children[i], parent).hint = std::uint32_t(i);
  endInsertRows();
}

bool WorldModel::canDropMimeData(const QMimeData* data, Qt::DropAction action, int /*row*/, int /*column*/,
                                 const QModelIndex& parent) const {
  if (!data || action != Qt::MoveAction) return false;
  const std::vector<ObjectId> objects = objects_of(*data);
  const ObjectId target = object(parent);
  return !objects.empty() && std::none_of(objects.begin(), objects.end(), [&](ObjectId id) {
    return target && world::is_within(world(), target, id);
  });
}

bool WorldModel::dropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column,
                              const QModelIndex& parent) {
  if (!canDropMimeData(data, action, row, column, parent)) return false;
  const std::vector<ObjectId> objects = objects_of(*data);
  const ObjectId target = object(parent);
  const std::size_t place = row < 0 ? children_of(target).size() : std::size_t(row);
  const auto edit = interaction::put_under(world(), objects, target, place);
  if (!edit) {
    refuse(edit.error().message);
    return false;
  }
  const QString where =
      target ? QString(" under %1").arg(shortened(shown_name(world(), target))) : QString(" to the top");
  const auto done =
      session().history().perform(*edit, action_name("Move", world(), objects) + where.toStdString());
  if (!done) refuse(done.error().message);
  return done.has_value();
}

}  // namespace icome::ui
