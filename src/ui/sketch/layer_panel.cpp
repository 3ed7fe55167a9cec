#include "ui/sketch/layer_panel.h"

#include <fmt/format.h>

#include <QHBoxLayout>
#include <QHeaderView>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <utility>

#include "ui/look/theme.h"
#include "ui/panels/object_look.h"

namespace icome::ui {
namespace {

enum LayerColumn : int { NameColumn, SeenColumn, LockedColumn };

}  // namespace

LayerPanel::LayerPanel(SketchDocument& document, QWidget* parent)
    : QWidget(parent), document_(document), tree_(new QTreeWidget(this)) {
  setObjectName("layers");
  tree_->setObjectName("layers.tree");
  tree_->setAccessibleName("Layers, the topmost first");
  tree_->setHeaderLabels({"Layer", "Seen", "Locked"});
  tree_->setRootIsDecorated(false);
  tree_->setAllColumnsShowFocus(true);
  tree_->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed);
  tree_->header()->setStretchLastSection(false);
  tree_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  tree_->header()->setSectionResizeMode(NameColumn, QHeaderView::Stretch);
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(kGrid);
  buttons->addWidget(add_button("add", "Add a layer on top", Icon::New, [this] { use("add-layer"); }));
  delete_ = add_button("delete", "Delete the layer with its strokes", Icon::Delete, [this] {
    const int at = chosen();
    if (at < 0) return;
    const std::string id = std::to_string(document_.drawing().layers[std::size_t(at)].id.value);
    use("delete-layer", {{"layer", "#" + id}});
  });
  buttons->addWidget(delete_);
  up_ = add_button("up", "Lay the layer above the next one", Icon::Up, [this] { move(1); });
  buttons->addWidget(up_);
  down_ = add_button("down", "Lay the layer below the next one", Icon::Down, [this] { move(-1); });
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
  connect(tree_, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
    if (showing_ || item == nullptr) return;
    // Not from within the tree's own signal, which refresh() would take its items away from.
    QMetaObject::invokeMethod(
        this,
        [this, id = item->data(NameColumn, Qt::UserRole).toULongLong()] {
          use("choose-layer", {{"layer", fmt::format("#{}", id)}});
        },
        Qt::QueuedConnection);
  });
  refresh();
}

QToolButton* LayerPanel::add_button(const char* name, const QString& text, Icon picture,
                                    std::function<void()> act) {
  auto* button = new QToolButton(this);
  button->setObjectName(QString("layers.%1").arg(name));
  button->setIcon(icon(picture));
  button->setToolTip(text);
  button->setAccessibleName(text);
  button->setAutoRaise(true);
  button->setFocusPolicy(Qt::StrongFocus);
  connect(button, &QToolButton::clicked, this, std::move(act));
  return button;
}

void LayerPanel::use(const char* tool, interaction::Value::Fields fields) {
  document_.perform(command(tool, std::move(fields)));
}

int LayerPanel::chosen() const {
  const auto& layers = document_.drawing().layers;
  for (std::size_t i = 0; i < layers.size(); ++i)
    if (layers[i].id == document_.layer()) return int(i);
  return -1;
}

void LayerPanel::move(int by) {
  const int at = chosen();
  if (at < 0) return;
  const std::string id = std::to_string(document_.drawing().layers[std::size_t(at)].id.value);
  use("move-layer", {{"layer", "#" + id}, {"place", at + by + 1}});
}

/// A name that was typed, or a switch that was set.
void LayerPanel::take_change(const QTreeWidgetItem& item, int column) {
  const std::string id = std::to_string(item.data(NameColumn, Qt::UserRole).toULongLong());
  interaction::Value::Fields fields = {{"layer", "#" + id}};
  const bool on = item.checkState(column) == Qt::Checked;
  if (column == NameColumn) fields.emplace_back("name", item.text(NameColumn).toStdString());
  if (column == SeenColumn) fields.emplace_back("visible", on);
  if (column == LockedColumn) fields.emplace_back("locked", on);
  QMetaObject::invokeMethod(
      this, [this, fields = std::move(fields)] { use("change-layer", fields); }, Qt::QueuedConnection);
}

void LayerPanel::show_item(QTreeWidgetItem& item, const drawing::Layer& layer) {
  const QString name = one_line(layer.name);
  item.setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsEditable | Qt::ItemIsUserCheckable);
  item.setData(NameColumn, Qt::UserRole, qulonglong(layer.id.value));
  item.setText(NameColumn, name);
  item.setToolTip(NameColumn, QString("%L1 strokes").arg(layer.strokes.size()));
  item.setCheckState(SeenColumn, layer.visible ? Qt::Checked : Qt::Unchecked);
  item.setCheckState(LockedColumn, layer.locked ? Qt::Checked : Qt::Unchecked);
  item.setData(SeenColumn, Qt::AccessibleTextRole, name + (layer.visible ? " is seen" : " is hidden"));
  item.setData(LockedColumn, Qt::AccessibleTextRole, name + (layer.locked ? " is locked" : " is not locked"));
}

void LayerPanel::refresh() {
  const auto& layers = document_.drawing().layers;
  showing_ = true;
  while (tree_->topLevelItemCount() > int(layers.size())) delete tree_->takeTopLevelItem(0);
  while (tree_->topLevelItemCount() < int(layers.size())) tree_->addTopLevelItem(new QTreeWidgetItem);
  const int at = chosen();
  for (int row = 0; row < int(layers.size()); ++row) {
    const int layer = int(layers.size()) - 1 - row;
    show_item(*tree_->topLevelItem(row), layers[std::size_t(layer)]);
    if (layer == at) tree_->setCurrentItem(tree_->topLevelItem(row));
  }
  showing_ = false;
  delete_->setEnabled(layers.size() > 1);
  up_->setEnabled(at >= 0 && at + 1 < int(layers.size()));
  down_->setEnabled(at > 0);
}

}  // namespace icome::ui
