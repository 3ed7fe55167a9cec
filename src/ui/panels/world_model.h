#pragma once
#include <unordered_map>
#include <vector>

#include "ui/panels/object_model.h"

namespace icome::ui {

/// The hierarchy of a world as rows. It mirrors only the parts that views have asked for, and after an edit
/// it changes only the rows that differ: views keep their open items, selection and scroll position.
class WorldModel final : public ObjectModel {
 public:
  WorldModel(session::Session& session, QObject* parent);

  QModelIndex index_of(world::ObjectId object) override;
  void follow(const world::Changes* changes) override;

  QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
  QModelIndex parent(const QModelIndex& index) const override;
  using QObject::parent;
  int rowCount(const QModelIndex& parent = {}) const override;
  bool hasChildren(const QModelIndex& parent = {}) const override;
  bool canFetchMore(const QModelIndex& parent) const override;
  void fetchMore(const QModelIndex& parent) override;
  bool canDropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column,
                       const QModelIndex& parent) const override;
  bool dropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column,
                    const QModelIndex& parent) override;

 private:
  /// An object as views know it.
  struct Node {
    world::ObjectId parent = {};
    std::vector<world::ObjectId> children = {};  // none before they are fetched
    bool fetched = false;
    mutable std::uint32_t hint = 0;  // likely place among its siblings
  };

  const std::vector<world::ObjectId>& children_of(world::ObjectId object) const;
  Node& add_node(world::ObjectId object, world::ObjectId parent);
  int row_of(world::ObjectId object) const;
  QModelIndex known_index(world::ObjectId object) const;
  bool is_shown_within(world::ObjectId object, world::ObjectId ancestor) const;
  void fetch(world::ObjectId parent);
  void reset();

  // The steps of follow().
  std::vector<world::ObjectId> take_moves(const world::Changes& changes);
  void move_row(world::ObjectId object, world::ObjectId parent);
  void remove_rows(const std::vector<world::ObjectId>& gone);
  void remove_run(world::ObjectId parent, int first, int last);
  void forget(world::ObjectId object);
  std::vector<world::ObjectId> parents_to_arrange(const world::Changes& changes) const;
  void arrange(world::ObjectId parent);
  std::size_t insert_run(world::ObjectId parent, std::size_t first);
  void note_childless();
  void announce(const world::Changes& changes);

  bool changing_ = false;                            // nothing can be fetched: the world is ahead of the rows
  std::unordered_map<world::ObjectId, Node> nodes_;  // the one without an id holds the roots
};

}  // namespace icome::ui
