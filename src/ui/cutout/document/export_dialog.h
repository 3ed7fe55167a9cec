#pragma once
#include <QDialog>
#include <functional>

#include "animation/export/export_animation.h"
#include "ui/forms/quantity_field.h"

class QCheckBox;

namespace icome::ui {

/// Asks what of an animation is written, and how large.
class ExportDialog final : public QDialog {
 public:
  ExportDialog(const animation::Project& project, QWidget* parent);

  void on_choice(std::function<void(const animation::ExportOptions&)> choice) { choice_ = std::move(choice); }
  /// The present choice. Fails where a field is no number, or out of range.
  base::Result<animation::ExportOptions> options() const;

 private:
  QuantityField* add_field(const char* name, const QString& accessible, double value);
  QCheckBox* add_switch(const char* name, const QString& text, const QString& tip, bool on);
  void take();

  animation::Stage stage_;
  QuantityField *first_, *last_, *width_;
  QCheckBox *camera_, *background_, *sound_;
  class PanelNote* note_;
  std::function<void(const animation::ExportOptions&)> choice_ = [](const animation::ExportOptions&) {};
};

}  // namespace icome::ui
