#include "ui/tools/shape_options.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QSpinBox>

#include "ui/forms/elided_label.h"
#include "ui/forms/quantity_field.h"
#include "ui/forms/quiet_combo_box.h"
#include "ui/look/theme.h"

namespace icome::ui {

using interaction::ShapingSettings;
using interaction::ShapingTarget;

ShapeOptions::ShapeOptions(session::Session& session, ShapeTool& tool, QWidget* parent)
    : QWidget(parent),
      session_(session),
      tool_(tool),
      target_(new QuietComboBox(this)),
      radius_name_(new QLabel("&Radius", this)),
      radius_(new QuantityField(Quantity::Length, this)),
      cells_name_(new QLabel("&Cells", this)),
      complaint_(new ElidedLabel(this)) {
  setObjectName("shape.options");
  make_fields();
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(2 * kGrid, kGrid, 2 * kGrid, kGrid);
  row->addWidget(target_);
  row->addWidget(radius_name_);
  row->addWidget(radius_);
  row->addWidget(cells_name_);
  for (QSpinBox* it : cells_) row->addWidget(it);
  row->addWidget(complaint_, 1);
  show_target();
}

void ShapeOptions::make_fields() {
  target_->setObjectName("shape.target");
  target_->setAccessibleName("What is dragged");
  target_->addItems({"Vertex", "Edge", "Face", "Lattice"});  // in ShapingTarget's order
  connect(target_, &QComboBox::currentIndexChanged, this, [this](int index) {
    ShapingSettings settings = tool_.settings();
    settings.target = ShapingTarget(index);
    tool_.set(settings);
    show_target();
  });
  radius_->setObjectName("shape.radius");
  radius_->setAccessibleName("Radius within which others follow");
  radius_->setToolTip("How far round it others follow; 0: none does");
  radius_->setMaximumWidth(22 * kGrid);
  radius_->show_value(tool_.settings().soft.radius);
  radius_->on_commit([this](std::optional<double> value, bool) -> base::Result<void> {
    ShapingSettings settings = tool_.settings();
    settings.soft.radius = value.value_or(0.0);
    interaction::Shaping checked;
    if (const auto good = checked.set(settings); !good) return good;
    tool_.set(settings);
    radius_->show_value(settings.soft.radius);
    return {};
  });
  radius_name_->setBuddy(radius_);
  for (std::size_t axis = 0; axis < cells_.size(); ++axis) {
    cells_[axis] = new QSpinBox(this);
    cells_[axis]->setObjectName(QString("shape.cells.%1").arg(axis));
    cells_[axis]->setAccessibleName(QString("Cells of the lattice along %1").arg("xyz"[axis]));
    cells_[axis]->setRange(1, ShapingSettings::kMostCells);
    cells_[axis]->setValue(tool_.settings().cells[axis]);
    connect(cells_[axis], &QSpinBox::valueChanged, this, [this, axis](int cells) {
      ShapingSettings settings = tool_.settings();
      settings.cells[axis] = cells;
      tool_.set(settings);
    });
  }
  cells_name_->setBuddy(cells_[0]);
  complaint_->setObjectName("shape.complaint");
  complaint_->setForegroundRole(QPalette::PlaceholderText);
}

void ShapeOptions::show_target() {
  const bool lattice = tool_.settings().target == ShapingTarget::Lattice;
  radius_name_->setVisible(!lattice);
  radius_->setVisible(!lattice);
  cells_name_->setVisible(lattice);
  for (QSpinBox* it : cells_) it->setVisible(lattice);
}

void ShapeOptions::tick() {
  const QString why = session_.hands().shaping()
                          ? QString::fromStdString(session_.hands().shaping()->complaint())
                          : QString();
  if (complaint_->text() != why) complaint_->setText(why);
}

bool ShapeOptions::finish_typing() { return radius_->finish(); }

}  // namespace icome::ui
