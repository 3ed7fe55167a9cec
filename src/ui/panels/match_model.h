#pragma once
#include <unordered_map>
#include <vector>

#include "ui/panels/object_model.h"

namespace icome::ui {

/// The list of objects with names that contain the text of a search, in upper or lower case; it follows
/// edits. Unnamed objects are found by the names that they are shown with.
class MatchModel final : public ObjectModel {
 public:
  MatchModel(session::Session& session, QObject* parent) : ObjectModel(session, parent) {}

  /// Lists the objects that match, in the order of the tree; none for an empty text.
  void search(const QString& text);
  std::size_t size() const { return found_.size(); }

  QModelIndex index_of(world::ObjectId object) override;
  void follow(const world::Changes* changes) override;

  QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
  QModelIndex parent(const QModelIndex& /*index*/) const override { return {}; }
  using QObject::parent;
  int rowCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;

 private:
  bool matches(world::ObjectId object) const;
  void collect();
  void remove_lost();
  void add_found(const world::Changes& changes);
  void number_rows();

  QString text_ = {};
  std::vector<world::ObjectId> found_ = {};
  std::unordered_map<world::ObjectId, int> rows_ = {};  // of found_
};

}  // namespace icome::ui
