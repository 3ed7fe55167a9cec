#include "ui/cutout/document/export_dialog.h"

#include <fmt/format.h>

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QPushButton>
#include <algorithm>
#include <cmath>

#include "ui/look/theme.h"
#include "ui/panels/panel_note.h"

namespace icome::ui {

ExportDialog::ExportDialog(const animation::Project& project, QWidget* parent)
    : QDialog(parent), stage_(project.stage) {
  setObjectName("cutout.export_options");
  setWindowTitle("Export");
  first_ = add_field("export.first", "First frame", 0);
  last_ = add_field("export.last", "Last frame", stage_.length - 1);
  width_ = add_field("export.width", "Width in pixels", stage_.width);
  camera_ =
      add_switch("export.camera", "through the camera", "What the camera films, else all of the stage", true);
  background_ = add_switch("export.background", "background",
                           "Without, what no cell covers is clear; an MP4 film always has it", true);
  sound_ = add_switch("export.sound", "sound", "Goes with MP4 and WebM films", true);
  sound_->setEnabled(project.sound.has_value());
  note_ = new PanelNote(this);
  auto* rows = new QFormLayout(this);
  rows->setContentsMargins(4 * kGrid, 4 * kGrid, 4 * kGrid, 4 * kGrid);
  rows->addRow("First frame", first_);
  rows->addRow("Last frame", last_);
  rows->addRow("Width, px", width_);
  for (QCheckBox* box : {camera_, background_, sound_}) rows->addRow(QString(), box);
  rows->addRow(note_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
  buttons->button(QDialogButtonBox::Ok)->setText("Export\u2026");
  connect(buttons, &QDialogButtonBox::accepted, this, [this] { take(); });
  connect(buttons, &QDialogButtonBox::rejected, this, [this] { reject(); });
  rows->addRow(buttons);
}

QuantityField* ExportDialog::add_field(const char* name, const QString& accessible, double value) {
  auto* field = new QuantityField(Quantity::Whole, this);
  field->setObjectName(name);
  field->setAccessibleName(accessible);
  field->show_value(value);
  field->on_commit([field](std::optional<double> typed, bool) -> base::Result<void> {
    if (!typed) return base::fail("A whole number is needed.");
    field->show_value(typed);
    return {};
  });
  field->on_refusal([this](const QString& why) { note_->keep(why); });
  return field;
}

QCheckBox* ExportDialog::add_switch(const char* name, const QString& text, const QString& tip, bool on) {
  auto* box = new QCheckBox(text, this);
  box->setObjectName(name);
  box->setToolTip(tip);
  box->setChecked(on);
  return box;
}

base::Result<animation::ExportOptions> ExportDialog::options() const {
  const auto whole = [](const QuantityField& field, int least, int most) -> base::Result<int> {
    const auto value = field.typed_value();
    if (!value) return tl::unexpected(value.error());
    if (!*value || **value < least || **value > most)
      return base::fail(
          fmt::format("{} is a number from {} to {}.", field.accessibleName().toStdString(), least, most));
    return int(**value);
  };
  const auto first = whole(*first_, 0, stage_.length - 1);
  if (!first) return tl::unexpected(first.error());
  const auto last = whole(*last_, *first, stage_.length - 1);
  if (!last) return tl::unexpected(last.error());
  const auto width = whole(*width_, 2, animation::kLargestStage);
  if (!width) return tl::unexpected(width.error());
  animation::ExportOptions options;
  options.range = animation::FrameRange{*first, *last};
  options.width = *width;
  options.height = std::clamp(int(std::lround(double(*width) * stage_.height / stage_.width)), 2,
                              animation::kLargestStage);
  options.through_camera = camera_->isChecked();
  options.background = background_->isChecked();
  options.sound = sound_->isChecked();
  return options;
}

void ExportDialog::take() {
  const auto chosen = options();
  if (!chosen) return note_->keep(QString::fromStdString(chosen.error().message));
  accept();
  choice_(*chosen);
}

}  // namespace icome::ui
