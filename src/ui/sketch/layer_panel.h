#pragma once
#include <QWidget>

#include "ui/look/icons.h"
#include "ui/sketch/sketch_document.h"

class QToolButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace icome::ui {

/// The layers of a drawing, the topmost first: which are seen and locked, their names and order, and where
/// new strokes go. The document outlives it.
class LayerPanel final : public QWidget {
 public:
  LayerPanel(SketchDocument& document, QWidget* parent);

  /// Shows the layers as they are now.
  void refresh();

 private:
  QToolButton* add_button(const char* name, const QString& text, Icon picture, std::function<void()> act);
  void show_item(QTreeWidgetItem& item, const drawing::Layer& layer);
  void take_change(const QTreeWidgetItem& item, int column);
  void use(const char* tool, interaction::Value::Fields fields = {});
  void move(int by);
  /// The place of the chosen layer, the lowest first; -1: there is none.
  int chosen() const;

  SketchDocument& document_;
  QTreeWidget* tree_;
  QToolButton *delete_ = nullptr, *up_ = nullptr, *down_ = nullptr;
  bool showing_ = false;  // what changes in the tree was not done by a person
};

}  // namespace icome::ui
