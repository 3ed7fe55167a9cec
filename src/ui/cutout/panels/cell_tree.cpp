#include "ui/cutout/panels/cell_tree.h"

#include <QDropEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QScrollBar>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "ui/look/theme.h"
#include "ui/panels/object_look.h"

namespace icome::ui {
namespace {

using animation::Layer;
using animation::LayerId;

enum CellTreeColumn : int { CellNameColumn, CellSeenColumn, CellLockedColumn };
constexpr int kLayerRole = Qt::UserRole, kCellRole = Qt::UserRole + 1;

LayerId layer_in(const QTreeWidgetItem& item) {
  return LayerId{item.data(CellNameColumn, kLayerRole).toULongLong()};
}
CellId cell_in(const QTreeWidgetItem& item) {
  return CellId{item.data(CellNameColumn, kCellRole).toULongLong()};
}

std::size_t place_in(const Layer& layer, CellId cell) {
  const auto found = std::ranges::find(layer.cells, cell, &animation::Cell::id);
  return std::size_t(found - layer.cells.begin());
}

std::size_t place_in(const animation::Project& project, LayerId layer) {
  const auto found = std::ranges::find(project.layers, layer, &Layer::id);
  return std::size_t(found - project.layers.begin());
}

}  // namespace

/// A tree whose items are moved by the document, not by the tree itself.
class CellTree::Tree final : public QTreeWidget {
 public:
  explicit Tree(CellTree& owner) : QTreeWidget(&owner), owner_(owner) {
    setDragEnabled(true);
    setAcceptDrops(true);
    setDragDropMode(QAbstractItemView::InternalMove);
    setDropIndicatorShown(true);
  }

 protected:
  void dropEvent(QDropEvent* event) override {
    QTreeWidgetItem* const on = itemAt(event->position().toPoint());
    event->setDropAction(Qt::IgnoreAction);
    event->accept();
    if (on == nullptr) return;
    const int where = dropIndicatorPosition() == AboveItem   ? 1
                      : dropIndicatorPosition() == BelowItem ? -1
                                                             : 0;
    std::vector<CellId> cells;
    LayerId layer;
    for (const QTreeWidgetItem* item : selectedItems()) {
      if (cell_in(*item))
        cells.push_back(cell_in(*item));
      else
        layer = layer_in(*item);
    }
    if (!cells.empty()) return owner_.drop(cells, layer_in(*on), cell_in(*on), where);
    if (layer) owner_.drop_layer(layer, layer_in(*on), where);
  }

 private:
  CellTree& owner_;
};

CellTree::CellTree(CutoutDocument& document, QWidget* parent)
    : QWidget(parent), document_(document), tree_(new Tree(*this)) {
  setObjectName("cells");
  tree_->setObjectName("cells.tree");
  tree_->setAccessibleName("Layers and cells, the front first");
  tree_->setHeaderLabels({"Layers and cells", "Seen", "Locked"});
  tree_->setAllColumnsShowFocus(true);
  tree_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  tree_->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed);
  tree_->setIndentation(4 * kGrid);
  tree_->header()->setStretchLastSection(false);
  tree_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  tree_->header()->setSectionResizeMode(CellNameColumn, QHeaderView::Stretch);
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(kGrid);
  buttons->addWidget(add_button("pictures", "Add cells from pictures", Icon::Cell, [this] { add_(); }));
  buttons->addWidget(add_button("folder", "Import a folder of pictures", Icon::Open, [this] { import_(); }));
  buttons->addWidget(add_button("add", "Add a layer in front", Icon::New, [this] { add_layer(); }));
  delete_ = add_button("delete", "Delete what is chosen", Icon::Delete, [this] { delete_chosen(); });
  buttons->addWidget(delete_);
  up_ = add_button("up", "Bring to the front by one place", Icon::Up, [this] { move_chosen(1); });
  buttons->addWidget(up_);
  down_ = add_button("down", "Send to the back by one place", Icon::Down, [this] { move_chosen(-1); });
  buttons->addWidget(down_);
  buttons->addStretch();
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(kGrid, kGrid, kGrid, kGrid);
  rows->setSpacing(kGrid);
  rows->addWidget(tree_);
  rows->addLayout(buttons);
  connect(tree_, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item, int column) {
    if (!showing_) take_change(*item, column);
  });
  connect(tree_, &QTreeWidget::itemSelectionChanged, this, [this] {
    if (!showing_) take_selection();
  });
  refresh();
}

QToolButton* CellTree::add_button(const char* name, const QString& text, Icon picture,
                                  std::function<void()> act) {
  auto* button = new QToolButton(this);
  button->setObjectName(QString("cells.%1").arg(name));
  button->setIcon(icon(picture));
  button->setToolTip(text);
  button->setAccessibleName(text);
  button->setAutoRaise(true);
  button->setFocusPolicy(Qt::StrongFocus);
  connect(button, &QToolButton::clicked, this, std::move(act));
  return button;
}

/// Not from within the tree's own signals, as refresh() would take its items away from it.
void CellTree::later(std::function<void()> act) {
  QMetaObject::invokeMethod(this, std::move(act), Qt::QueuedConnection);
}

const Layer* CellTree::chosen_layer() const {
  if (const Layer* const layer = document_.project().find(layer_)) return layer;
  return document_.project().layers.empty() ? nullptr : &document_.project().layers.back();
}

void CellTree::add_layer() { document_.perform(cutout_command("add-layer")); }

void CellTree::rename() {
  const auto items = tree_->selectedItems();
  if (!items.isEmpty()) tree_->editItem(items.back(), CellNameColumn);
}

void CellTree::delete_chosen() {
  std::vector<std::string> names;
  for (const CellId cell : document_.selection())
    if (cell != animation::kCamera) names.push_back(document_.project().find(cell)->name);
  if (!names.empty()) {
    document_.perform(cutout_command("delete-cell", {{"cells", command_texts(names)}}));
    return;
  }
  const auto items = tree_->selectedItems();
  const Layer* const layer = items.isEmpty() ? nullptr : document_.project().find(layer_in(*items.back()));
  if (layer != nullptr) document_.perform(cutout_command("delete-layer", {{"layer", layer->name}}));
}

void CellTree::move_chosen(int by) {
  const animation::Project& project = document_.project();
  if (const animation::Cell* const cell = document_.leading(); cell != nullptr) {
    const Layer* const layer = project.layer_of(cell->id);
    if (layer == nullptr) return;
    const int place = int(place_in(*layer, cell->id)) + by;
    if (place < 0 || place >= int(layer->cells.size())) return;
    document_.perform(cutout_command("move-cell", {{"cell", cell->name}, {"place", place}}));
    return;
  }
  const Layer* const layer = chosen_layer();
  if (layer == nullptr) return;
  const int place = int(place_in(project, layer->id)) + by;
  if (place < 0 || place >= int(project.layers.size())) return;
  document_.perform(cutout_command("move-layer", {{"layer", layer->name}, {"place", place}}));
}

/// Lays cells before (1), behind (-1) or at the front of (0) what they were dropped on.
void CellTree::drop(const std::vector<CellId>& cells, LayerId to, CellId target, int where) {
  later([=, this] {
    const Layer* const layer = document_.project().find(to);
    if (layer == nullptr || std::ranges::find(cells, target) != cells.end()) return;
    animation::ProjectEdit edit;
    std::size_t place = 0;
    std::vector<CellId> others;
    for (const animation::Cell& cell : layer->cells)
      if (std::ranges::find(cells, cell.id) == cells.end()) others.push_back(cell.id);
    if (target) {
      place = std::size_t(std::ranges::find(others, target) - others.begin()) + (where == -1 ? 0 : 1);
    } else {
      place = others.size();
    }
    // Moved one after the other, so those that still lie in the layer count.
    std::vector<CellId> now;
    for (const animation::Cell& cell : layer->cells) now.push_back(cell.id);
    std::vector<CellId> wanted = others;
    wanted.insert(wanted.begin() + std::ptrdiff_t(std::min(place, wanted.size())), cells.begin(),
                  cells.end());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (i < now.size() && now[i] == wanted[i]) continue;
      std::erase(now, wanted[i]);
      now.insert(now.begin() + std::ptrdiff_t(std::min(i, now.size())), wanted[i]);
      edit.push_back(animation::MoveCell{wanted[i], to, i});
    }
    document_.perform(edit);
  });
}

void CellTree::drop_layer(LayerId layer, LayerId target, int where) {
  if (layer == target) return;
  later([=, this] {
    const animation::Project& project = document_.project();
    std::vector<LayerId> others;
    for (const Layer& it : project.layers)
      if (it.id != layer) others.push_back(it.id);
    const auto place =
        std::size_t(std::ranges::find(others, target) - others.begin()) + (where == -1 ? 0 : 1);
    document_.perform(animation::ProjectEdit{animation::MoveLayer{layer, std::min(place, others.size())}});
  });
}

/// A name that was typed, or a switch that was set.
void CellTree::take_change(const QTreeWidgetItem& item, int column) {
  const std::string typed = item.text(CellNameColumn).toStdString();
  const bool on = item.checkState(column) == Qt::Checked;
  later([=, this, cell = cell_in(item), layer = layer_in(item)] {
    if (const animation::Cell* const it = cell ? document_.project().find(cell) : nullptr) {
      document_.perform(cutout_command("change-cell", {{"cell", it->name}, {"name", typed}}));
    } else if (const Layer* const its = document_.project().find(layer)) {
      interaction::Value::Fields fields = {{"layer", its->name}};
      if (column == CellNameColumn) fields.emplace_back("name", typed);
      if (column == CellSeenColumn) fields.emplace_back("visible", on);
      if (column == CellLockedColumn) fields.emplace_back("locked", on);
      document_.perform(cutout_command("change-layer", std::move(fields)));
    }
  });
}

void CellTree::take_selection() {
  std::vector<CellId> cells;
  for (const QTreeWidgetItem* item : tree_->selectedItems()) {
    if (cell_in(*item)) cells.push_back(cell_in(*item));
    if (layer_in(*item)) layer_ = layer_in(*item);
  }
  const auto* const current = tree_->currentItem();
  // The one that was chosen last leads.
  if (current != nullptr && current->isSelected() && cell_in(*current)) {
    std::erase(cells, cell_in(*current));
    cells.push_back(cell_in(*current));
  }
  later([=, this] {
    document_.select(cells);
    show_buttons();
  });
}

void CellTree::show_layer(QTreeWidgetItem& item, const Layer& layer) {
  const QString name = one_line(layer.name);
  item.setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsEditable | Qt::ItemIsUserCheckable |
                Qt::ItemIsDragEnabled | Qt::ItemIsDropEnabled);
  item.setData(CellNameColumn, kLayerRole, qulonglong(layer.id.value));
  item.setText(CellNameColumn, name);
  QFont bold = font();
  bold.setBold(true);
  item.setFont(CellNameColumn, bold);
  item.setCheckState(CellSeenColumn, layer.visible ? Qt::Checked : Qt::Unchecked);
  item.setCheckState(CellLockedColumn, layer.locked ? Qt::Checked : Qt::Unchecked);
  item.setData(CellSeenColumn, Qt::AccessibleTextRole, name + (layer.visible ? " is seen" : " is hidden"));
  item.setData(CellLockedColumn, Qt::AccessibleTextRole,
               name + (layer.locked ? " is locked" : " is not locked"));
}

void CellTree::show_cell(QTreeWidgetItem& item, const animation::Cell& cell) {
  const bool is_camera = cell.id == animation::kCamera;
  Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable;
  if (!is_camera) flags |= Qt::ItemIsEditable | Qt::ItemIsDragEnabled;
  item.setFlags(flags);
  const animation::Layer* const layer = document_.project().layer_of(cell.id);
  item.setData(CellNameColumn, kLayerRole, qulonglong(layer != nullptr ? layer->id.value : 0));
  item.setData(CellNameColumn, kCellRole, qulonglong(cell.id.value));
  item.setText(CellNameColumn, is_camera ? QString("Camera") : one_line(cell.name));
  item.setIcon(CellNameColumn, icon(is_camera ? Icon::Camera : Icon::Cell));
  item.setToolTip(CellNameColumn, is_camera ? QString("Keys of the camera's pan and zoom")
                                            : QString("%L1 %2")
                                                  .arg(cell.pictures.size())
                                                  .arg(cell.pictures.size() == 1 ? "picture" : "pictures"));
}

void CellTree::refresh() {
  const animation::Project& project = document_.project();
  showing_ = true;
  std::set<LayerId> folded;
  for (int i = 0; i < tree_->topLevelItemCount(); ++i)
    if (!tree_->topLevelItem(i)->isExpanded()) folded.insert(layer_in(*tree_->topLevelItem(i)));
  const int scrolled = tree_->verticalScrollBar()->value();
  const int rows = int(project.layers.size()) + 1;
  while (tree_->topLevelItemCount() > 0) delete tree_->takeTopLevelItem(tree_->topLevelItemCount() - 1);
  for (int row = 0; row < rows; ++row) {
    auto* const item = new QTreeWidgetItem;
    tree_->addTopLevelItem(item);
    if (row + 1 == rows) {
      show_cell(*item, project.camera);
      continue;
    }
    const Layer& layer = project.layers[std::size_t(rows - 2 - row)];
    show_layer(*item, layer);
    for (auto cell = layer.cells.rbegin(); cell != layer.cells.rend(); ++cell) {
      auto* const child = new QTreeWidgetItem;
      item->addChild(child);
      show_cell(*child, *cell);
    }
    item->setExpanded(!folded.contains(layer.id));
  }
  showing_ = false;
  follow_selection();
  tree_->verticalScrollBar()->setValue(scrolled);
}

void CellTree::follow_selection() {
  showing_ = true;
  const auto each = [&](const auto& use) {
    for (int i = 0; i < tree_->topLevelItemCount(); ++i) {
      QTreeWidgetItem* const item = tree_->topLevelItem(i);
      use(*item);
      for (int k = 0; k < item->childCount(); ++k) use(*item->child(k));
    }
  };
  each([&](QTreeWidgetItem& item) {
    const bool chosen = cell_in(item) ? document_.is_selected(cell_in(item))
                                      : document_.selection().empty() && layer_in(item) == layer_;
    if (item.isSelected() != chosen) item.setSelected(chosen);
  });
  showing_ = false;
  show_buttons();
}

void CellTree::show_buttons() {
  const bool has_cell =
      std::ranges::any_of(document_.selection(), [](CellId cell) { return cell != animation::kCamera; });
  const bool has_layer = document_.selection().empty() && document_.project().find(layer_) != nullptr;
  delete_->setEnabled(has_cell || has_layer);
  up_->setEnabled(has_cell || has_layer);
  down_->setEnabled(has_cell || has_layer);
}

}  // namespace icome::ui
