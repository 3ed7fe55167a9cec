#pragma once
#include <QWidget>
#include <functional>

#include "ui/cutout/document/cutout_document.h"
#include "ui/look/icons.h"

class QToolButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace icome::ui {

/// The layers of an animation and their cells, the front first: names, order, which layers are seen and
/// locked, and what is selected. The document outlives it.
class CellTree final : public QWidget {
 public:
  CellTree(CutoutDocument& document, QWidget* parent);

  /// Shows layers and cells as they are now.
  void refresh();
  /// Shows what is selected now.
  void follow_selection();
  /// Asks for pictures, or a folder of them.
  void on_add(std::function<void()> add) { add_ = std::move(add); }
  void on_import(std::function<void()> import) { import_ = std::move(import); }
  /// Begins to type another name for what is chosen.
  void rename();
  /// Deletes the cells that are selected, else the chosen layer.
  void delete_chosen();
  /// Brings what is chosen by one place to the front (1) or the back (-1).
  void move_chosen(int by);
  void add_layer();

 private:
  class Tree;

  QToolButton* add_button(const char* name, const QString& text, Icon picture, std::function<void()> act);
  void show_layer(QTreeWidgetItem& item, const animation::Layer& layer);
  void show_cell(QTreeWidgetItem& item, const animation::Cell& cell);
  void take_change(const QTreeWidgetItem& item, int column);
  void take_selection();
  void drop(const std::vector<CellId>& cells, animation::LayerId layer, CellId target, int where);
  void drop_layer(animation::LayerId layer, animation::LayerId target, int where);
  void later(std::function<void()> act);
  const animation::Layer* chosen_layer() const;
  void show_buttons();

  CutoutDocument& document_;
  Tree* tree_;
  QToolButton *delete_ = nullptr, *up_ = nullptr, *down_ = nullptr;
  std::function<void()> add_ = [] {}, import_ = [] {};
  animation::LayerId layer_;  // the one chosen last
  bool showing_ = false;      // changes in the tree are not a person's
};

}  // namespace icome::ui
