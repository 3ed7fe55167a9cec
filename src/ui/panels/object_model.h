#pragma once
#include <QAbstractItemModel>
#include <functional>

#include "session/session.h"

namespace icome::ui {

/// The common part of the world's tree and the list of found objects: an item is an object. Renames and moves
/// objects through the session, which outlives it.
class ObjectModel : public QAbstractItemModel {
 public:
  enum Role { PathRole = Qt::UserRole };  // names of its ancestors, for items of a list

  ObjectModel(session::Session& session, QObject* parent) : QAbstractItemModel(parent), session_(session) {}

  static world::ObjectId object(const QModelIndex& index) { return {std::uint64_t(index.internalId())}; }
  /// Index of the object; invalid where it is not shown.
  virtual QModelIndex index_of(world::ObjectId object) = 0;
  /// To be called when the world has changed; null: it is another world.
  virtual void follow(const world::Changes* changes) = 0;
  /// `hear` gets the reason why an edit was refused.
  void on_refusal(std::function<void(const QString&)> hear) { refused_ = std::move(hear); }

  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  QStringList mimeTypes() const override;
  QMimeData* mimeData(const QModelIndexList& indexes) const override;
  Qt::DropActions supportedDropActions() const override { return Qt::MoveAction; }

 protected:
  session::Session& session() const { return session_; }
  const world::World& world() const { return session_.world(); }
  void refuse(const std::string& why) const;
  /// The objects that mimeData() has packed; none for data of another program.
  static std::vector<world::ObjectId> objects_of(const QMimeData& data);

 private:
  QString holder_words(world::ObjectId id) const;

  session::Session& session_;
  std::function<void(const QString&)> refused_ = {};
};

}  // namespace icome::ui
