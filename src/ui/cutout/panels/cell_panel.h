#pragma once
#include <QWidget>
#include <array>
#include <functional>

#include "ui/cutout/document/cutout_document.h"
#include "ui/forms/quantity_field.h"
#include "ui/forms/quiet_combo_box.h"
#include "ui/forms/text_field.h"
#include "ui/panels/panel_section.h"

namespace icome::ui {

/// The values of the leading cell at the present frame; changing one sets a key there. A diamond beside a
/// name tells that there is one. The document outlives it.
class CellPanel final : public QWidget {
 public:
  CellPanel(CutoutDocument& document, QWidget* parent);

  /// Shows the values as they are now.
  void refresh();

 private:
  QuantityField* add_field(Quantity quantity, const char* name, const QString& accessible);
  void set_channel_of(QuantityField& field, Channel channel);
  void set_pivot_of(QuantityField& field, bool across);
  base::Result<void> set_in_step(bool more, const std::function<base::Result<void>()>& set);
  base::Result<void> set_value(Channel channel, double value);
  base::Result<void> set_pivot(bool across, double value);
  void show_label(const PanelSection::Row& row, const QString& text, std::initializer_list<Channel> channels);

  CutoutDocument& document_;
  PanelSection* section_;
  TextField* name_ = nullptr;
  QuantityField *x_ = nullptr, *y_ = nullptr, *angle_ = nullptr, *scale_ = nullptr, *opacity_ = nullptr;
  std::size_t steps_before_ = 0;  // of undo, before a value was stepped
  QuantityField *pivot_x_ = nullptr, *pivot_y_ = nullptr;
  QuietComboBox* picture_ = nullptr;
  PanelSection::Row name_row_, place_row_, angle_row_, scale_row_, opacity_row_, picture_row_, pivot_row_;
  QLabel* none_ = nullptr;
};

}  // namespace icome::ui
