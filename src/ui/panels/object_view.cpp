#include "ui/panels/object_view.h"

#include <QPainter>
#include <QScopedValueRollback>
#include <QStyledItemDelegate>
#include <algorithm>
#include <map>
#include <unordered_set>

#include "ui/look/theme.h"

namespace icome::ui {

using world::ObjectId;

namespace {

/// Draws rows of an even height; in a list also the path to the object.
class ObjectDelegate final : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    QSize size = QStyledItemDelegate::sizeHint(option, index);
    return {size.width(), std::max(6 * kGrid, option.fontMetrics.height() + 2 * kGrid)};
  }

  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    QStyledItemDelegate::paint(painter, option, index);
    const QString path = index.data(ObjectModel::PathRole).toString();
    if (path.isEmpty()) return;
    const QString name = index.data(Qt::DisplayRole).toString();
    const int taken = option.decorationSize.width() + option.fontMetrics.horizontalAdvance(name) + 6 * kGrid;
    const QRect rest = option.rect.adjusted(taken, 0, -kGrid, 0);
    if (rest.width() < 10 * kGrid) return;
    painter->save();
    painter->setPen(option.state & QStyle::State_Selected ? colours().selection_text : colours().faint);
    painter->drawText(rest, Qt::AlignVCenter | Qt::AlignRight,
                      option.fontMetrics.elidedText(path, Qt::ElideLeft, rest.width()));
    painter->restore();
  }
};

}  // namespace

ObjectView::ObjectView(session::Session& session, ObjectModel& objects, QWidget* parent)
    : QTreeView(parent), session_(session), objects_(objects) {
  setModel(&objects);
  setItemDelegate(new ObjectDelegate(this));
  setHeaderHidden(true);
  setUniformRowHeights(true);
  setFrameShape(QFrame::NoFrame);
  setSelectionMode(QAbstractItemView::ExtendedSelection);
  setEditTriggers(QAbstractItemView::EditKeyPressed);  // a click only selects, a double click zooms
  setExpandsOnDoubleClick(false);
  setAnimated(false);
  setAllColumnsShowFocus(true);
  setContextMenuPolicy(Qt::CustomContextMenu);
  connect(selectionModel(), &QItemSelectionModel::selectionChanged, this, [this] { select_in_session(); });
}

void ObjectView::follow(const world::Changes* changes) {
  const QScopedValueRollback<bool> busy(busy_, true);
  objects_.follow(changes);
}

void ObjectView::finish_editing() {
  QWidget* const editor = state() == EditingState ? indexWidget(currentIndex()) : nullptr;
  if (!editor) return;
  commitData(editor);
  closeEditor(editor, QAbstractItemDelegate::NoHint);
}

/// Selects the view's objects in the session, in the order of selecting: those selected before come first.
void ObjectView::select_in_session() {
  if (busy_) return;
  std::vector<ObjectId> now;
  for (const QItemSelectionRange& range : selectionModel()->selection()) {
    for (int row = range.top(); row <= range.bottom(); ++row)
      now.push_back(ObjectModel::object(objects_.index(row, 0, range.parent())));
  }
  const std::unordered_set<ObjectId> chosen(now.begin(), now.end());
  std::vector<ObjectId> ordered;
  for (const ObjectId id : session_.selection()) {
    if (chosen.contains(id)) ordered.push_back(id);
  }
  const std::unordered_set<ObjectId> before(ordered.begin(), ordered.end());
  for (const ObjectId id : now) {
    if (!before.contains(id)) ordered.push_back(id);
  }
  const QScopedValueRollback<bool> busy(busy_, true);
  session_.select(std::move(ordered));
}

/// The selection of the objects; adjacent rows are one range, as a selection of very many ranges is slow.
QItemSelection ObjectView::selection_of(const std::vector<ObjectId>& objects) {
  std::map<ObjectId, std::vector<int>> rows;  // by parent
  std::map<ObjectId, QModelIndex> parents;
  for (const ObjectId id : objects) {
    const QModelIndex index = objects_.index_of(id);
    if (!index.isValid()) continue;
    const ObjectId parent = ObjectModel::object(index.parent());
    rows[parent].push_back(index.row());
    parents[parent] = index.parent();
  }
  QItemSelection selection;
  for (auto& [parent, of_parent] : rows) {
    std::sort(of_parent.begin(), of_parent.end());
    const QModelIndex& above = parents[parent];
    for (std::size_t first = 0, i = 1; i <= of_parent.size(); ++i) {
      if (i < of_parent.size() && of_parent[i] == of_parent[i - 1] + 1) continue;
      selection.append(QItemSelectionRange(objects_.index(of_parent[first], 0, above),
                                           objects_.index(of_parent[i - 1], 0, above)));
      first = i;
    }
  }
  return selection;
}

void ObjectView::show_selection() {
  if (busy_) return;
  const QScopedValueRollback<bool> busy(busy_, true);
  const std::vector<ObjectId>& objects = session_.selection();
  selectionModel()->select(selection_of(objects), QItemSelectionModel::ClearAndSelect);
  const QModelIndex last = objects.empty() ? QModelIndex() : objects_.index_of(objects.back());
  if (!last.isValid() || last == currentIndex()) return;
  selectionModel()->setCurrentIndex(last, QItemSelectionModel::NoUpdate);
  scrollTo(last);
}

}  // namespace icome::ui
