#include "ui/panels/object_model.h"

#include <QApplication>
#include <QBrush>
#include <QMimeData>
#include <array>

#include "ui/look/theme.h"
#include "ui/panels/object_look.h"
#include "ui/sharing/sharing_panel.h"

namespace icome::ui {
namespace {

/// MIME type of dragged objects: this process's id, then the ids of the objects.
const char* const kObjects = "application/x-icome-objects";

const QIcon& kept_icon(Icon which) {
  static std::array<QIcon, std::size_t(Icon::Count)> icons;
  QIcon& it = icons[std::size_t(which)];
  if (it.isNull()) it = icon(which);
  return it;
}

}  // namespace

int ObjectModel::columnCount(const QModelIndex& parent) const { return parent.column() > 0 ? 0 : 1; }

QVariant ObjectModel::data(const QModelIndex& index, int role) const {
  const world::ObjectId id = object(index);
  const world::PhysicalObject* it = index.isValid() ? world().find(id) : nullptr;
  if (!it) return {};
  switch (role) {
    case Qt::DisplayRole:
    case Qt::AccessibleTextRole:
      return shown_name(world(), id) + holder_words(id);
    case Qt::EditRole:
      return QString::fromStdString(it->name);
    case Qt::DecorationRole:
      if (const auto holder = session_.sharing().holder_of(id)) return dot_of(holder->colour);
      return kept_icon(icon_of(world(), *it));
    case Qt::ForegroundRole:
      if (session_.sharing().holder_of(id)) return QBrush(colours().faint);
      return it->name.empty() ? QVariant(QBrush(colours().faint)) : QVariant();
    case Qt::ToolTipRole:
      return tip_of(description(world(), id));
    case Qt::AccessibleDescriptionRole:
      return description(world(), id);
    default:
      return {};
  }
}

/// " - Ann", of what another holds.
QString ObjectModel::holder_words(world::ObjectId id) const {
  const auto holder = session_.sharing().holder_of(id);
  return holder && holder->object == id ? " \u2013 " + shortened(one_line(holder->name)) : QString();
}

bool ObjectModel::setData(const QModelIndex& index, const QVariant& value, int role) {
  const world::PhysicalObject* it = index.isValid() ? world().find(object(index)) : nullptr;
  if (!it || role != Qt::EditRole) return false;
  const std::string name = value.toString().simplified().toStdString();
  if (name == it->name) return true;
  const std::string action = action_name("Rename", shown_name(world(), object(index)));
  const auto done = session_.history().perform(world::RenameObject{object(index), name}, action);
  if (!done) refuse(done.error().message);
  return done.has_value();
}

Qt::ItemFlags ObjectModel::flags(const QModelIndex& index) const {
  if (!index.isValid()) return Qt::ItemIsDropEnabled;
  return Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsEditable | Qt::ItemIsDragEnabled |
         Qt::ItemIsDropEnabled;
}

QStringList ObjectModel::mimeTypes() const { return {kObjects}; }

QMimeData* ObjectModel::mimeData(const QModelIndexList& indexes) const {
  QByteArray bytes;
  const auto add = [&bytes](std::uint64_t number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
  };
  add(std::uint64_t(QApplication::applicationPid()));
  for (const QModelIndex& index : indexes) add(object(index).value);
  auto* data = new QMimeData;
  data->setData(kObjects, bytes);
  return data;
}

void ObjectModel::refuse(const std::string& why) const {
  if (refused_) refused_(QString::fromStdString(why));
}

std::vector<world::ObjectId> ObjectModel::objects_of(const QMimeData& data) {
  const QByteArray bytes = data.data(kObjects);
  std::vector<world::ObjectId> objects(std::size_t(bytes.size()) / sizeof(world::ObjectId));
  if (objects.empty()) return {};
  std::copy_n(bytes.data(), objects.size() * sizeof(world::ObjectId),
              reinterpret_cast<char*>(objects.data()));
  if (objects.front().value != std::uint64_t(QApplication::applicationPid())) return {};
  objects.erase(objects.begin());
  return objects;
}

}  // namespace icome::ui
