#pragma once
#include <QWidget>
#include <array>

#include "ui/tools/shape_tool.h"

class QComboBox;
class QLabel;
class QSpinBox;

namespace icome::ui {

class QuantityField;

/// One row that says what the Shape tool drags: what, how far round it others follow, or how many cells the
/// lattice has; and why there is none. The tool outlives it.
class ShapeOptions final : public QWidget {
 public:
  ShapeOptions(session::Session& session, ShapeTool& tool, QWidget* parent);

  /// Says what is in the way of a lattice; once for each update.
  void tick();
  /// Commits what is being typed; false: it was refused.
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
