#pragma once
#include <QWidget>

#include "ui/cutout/cutout_look.h"
#include "ui/cutout/document/cutout_document.h"
#include "ui/forms/colour_button.h"
#include "ui/forms/quantity_field.h"
#include "ui/panels/panel_section.h"

namespace icome::ui {

/// Size, length and background of the stage, its sound, and how many poses shine through. Document and look
/// outlive it.
class StagePanel final : public QWidget {
 public:
  StagePanel(CutoutDocument& document, CutoutLook& look, QWidget* parent);

  void refresh();
  /// Called when the look has changed.
  void on_look(std::function<void()> look) { looked_ = std::move(look); }

 private:
  QuantityField* add_field(PanelSection& section, Quantity quantity, const char* name,
                           const QString& accessible, std::function<base::Result<void>(double)> commit);
  std::function<base::Result<void>(double)> stage_setter(const char* parameter, double least, double most);
  void add_stage_rows();
  void add_sound_rows();
  void add_onion_rows();

  CutoutDocument& document_;
  CutoutLook& look_;
  PanelSection *stage_, *sound_, *onion_;
  QuantityField *width_ = nullptr, *height_ = nullptr, *length_ = nullptr, *rate_ = nullptr;
  QuantityField *start_ = nullptr, *gain_ = nullptr, *before_ = nullptr, *after_ = nullptr;
  ColourButton* background_ = nullptr;
  QLabel* no_sound_ = nullptr;
  PanelSection::Row start_row_, gain_row_;
  std::function<void()> looked_ = [] {};
};

}  // namespace icome::ui
