#pragma once
#include <QWidget>
#include <array>

#include "ui/tools/shape_tool.h"

class QComboBox;
class QLabel;
class QSpinBox;

namespace icome::ui {

class QuantityField;

/// A row of options of the Shape tool: what it drags, how far round it others follow, or how many cells the
/// lattice has; and why there is none. The tool outlives it.
class ShapeOptions final : public QWidget {
 public:
  ShapeOptions(session::Session& session, ShapeTool& tool, QWidget* parent);

  /// Shows what is in the way of a lattice; to be called once for each update.
  void tick();
  /// Commits the text that is being typed; false: it was refused.
  bool finish_typing();

 private:
  void make_fields();
  void show_target();

  session::Session& session_;
  ShapeTool& tool_;
  QComboBox* target_;
  QLabel* radius_name_;
  QuantityField* radius_;
  QLabel* cells_name_;
  std::array<QSpinBox*, 3> cells_ = {};
  QLabel* complaint_;
};

}  // namespace icome::ui
