#pragma once
#include <QCheckBox>
#include <QWidget>
#include <functional>

#include "sketch/feel/paper.h"
#include "ui/forms/colour_button.h"
#include "ui/forms/quantity_field.h"
#include "ui/forms/quiet_combo_box.h"
#include "ui/panels/panel_section.h"
#include "ui/sketch/pressure_editor.h"
#include "ui/sketch/sketch_document.h"
#include "ui/sketch/sketch_look.h"

namespace icome::ui {

/// Choices for the pen: colour, opacity, width, pressure and ends, and what the eraser takes. Colour, opacity
/// and ends go to the strokes that are selected, too. Document and look outlive it.
class PenPanel final : public QWidget {
 public:
  PenPanel(SketchDocument& document, SketchLook& look, QWidget* parent);

  /// Shows a choice of papers, of which the one of that name is there, and calls `lay` when another is
  /// chosen.
  void offer_papers(std::string_view chosen, std::function<void(const sketch::Paper&)> lay);

  /// Called after a change of the look.
  void on_change(std::function<void()> change) { changed_ = std::move(change); }

 private:
  void add_line_rows();
  void add_pressure_rows();
  void add_eraser_rows(PanelSection& eraser);
  QuantityField* length_field(PanelSection& section, const char* name, double least, double& length);
  QCheckBox* check_box(PanelSection& section, const char* text, const char* tip, bool& flag);
  void give_selected(const SketchDocument::Command& command);

  SketchDocument& document_;
  SketchLook& look_;
  PanelSection* pen_;
  std::function<void()> changed_ = [] {};
};

}  // namespace icome::ui
