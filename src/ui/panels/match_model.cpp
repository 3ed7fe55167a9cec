#include "ui/panels/match_model.h"

#include "ui/panels/object_look.h"

namespace icome::ui {

using world::ObjectId;

void MatchModel::search(const QString& text) {
  beginResetModel();
  text_ = text.simplified();
  collect();
  number_rows();
  endResetModel();
}

bool MatchModel::matches(ObjectId object) const {
  return !text_.isEmpty() && shown_name(world(), object).contains(text_, Qt::CaseInsensitive);
}

void MatchModel::collect() {
  found_.clear();
  if (text_.isEmpty()) return;
  std::vector<ObjectId> due(world().roots().rbegin(), world().roots().rend());
  while (!due.empty()) {
    const ObjectId id = due.back();
    due.pop_back();
    if (matches(id)) found_.push_back(id);
    const std::vector<ObjectId>& children = world().find(id)->children;
    due.insert(due.end(), children.rbegin(), children.rend());
  }
}

QModelIndex MatchModel::index_of(ObjectId object) {
  const auto found = rows_.find(object);
  return found == rows_.end() ? QModelIndex() : index(found->second, 0);
}

void MatchModel::number_rows() {
  rows_.clear();
  rows_.reserve(found_.size());
  for (std::size_t row = 0; row < found_.size(); ++row) rows_.emplace(found_[row], int(row));
}

void MatchModel::follow(const world::Changes* changes) {
  if (text_.isEmpty()) return;
  if (!changes) return search(text_);
  if (changes->objects.empty() && changes->geometries.empty()) return;
  remove_lost();
  add_found(*changes);
  if (!found_.empty()) emit dataChanged(index(0, 0), index(int(found_.size()) - 1, 0));
}

void MatchModel::remove_lost() {
  const std::size_t before = found_.size();
  for (std::size_t end = found_.size(); end > 0; --end) {
    if (matches(found_[end - 1])) continue;
    std::size_t begin = end - 1;
    while (begin > 0 && !matches(found_[begin - 1])) --begin;
    beginRemoveRows({}, int(begin), int(end) - 1);
    found_.erase(found_.begin() + std::ptrdiff_t(begin), found_.begin() + std::ptrdiff_t(end));
    endRemoveRows();
    end = begin + 1;
  }
  if (found_.size() != before) number_rows();
}

/// Appends the objects that match now to those found before.
void MatchModel::add_found(const world::Changes& changes) {
  std::vector<ObjectId> fresh;
  for (const ObjectId id : changes.objects) {
    if (!rows_.contains(id) && matches(id)) fresh.push_back(id);
  }
  if (fresh.empty()) return;
  beginInsertRows({}, int(found_.size()), int(found_.size() + fresh.size()) - 1);
  for (const ObjectId id : fresh) {
    rows_.emplace(id, int(found_.size()));
    found_.push_back(id);
  }
  endInsertRows();
}

QModelIndex MatchModel::index(int row, int column, const QModelIndex& parent) const {
  if (parent.isValid() || column != 0 || row < 0 || std::size_t(row) >= found_.size()) return {};
  return createIndex(row, 0, quintptr(found_[std::size_t(row)].value));
}

int MatchModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : int(found_.size());
}

QVariant MatchModel::data(const QModelIndex& index, int role) const {
  if (role != PathRole) return ObjectModel::data(index, role);
  const world::PhysicalObject* it = index.isValid() ? world().find(object(index)) : nullptr;
  QStringList names;
  constexpr qsizetype kMost = 4;  // the nearest; more would not fit
  for (; it && it->parent && names.size() < kMost; it = world().find(it->parent))
    names.prepend(shown_name(world(), it->parent));
  return names.join(QStringLiteral(" › "));
}

Qt::ItemFlags MatchModel::flags(const QModelIndex& index) const {
  return ObjectModel::flags(index) & ~(Qt::ItemIsDragEnabled | Qt::ItemIsDropEnabled);
}

}  // namespace icome::ui
