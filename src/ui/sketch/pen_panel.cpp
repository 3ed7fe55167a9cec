#include "ui/sketch/pen_panel.h"

#include <QVBoxLayout>
#include <utility>

namespace icome::ui {
PenPanel::PenPanel(SketchDocument& document, SketchLook& look, QWidget* parent)
    : QWidget(parent), document_(document), look_(look), pen_(new PanelSection("Pen", this)) {
  setObjectName("pen");
  auto* eraser = new PanelSection("Eraser", this);
  add_line_rows();
  add_pressure_rows();
  add_eraser_rows(*eraser);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(pen_);
  column->addWidget(eraser);
  column->addStretch();
}

/// Gives the look that is chosen for the pen to what is selected, as one step to undo.
void PenPanel::give_selected(const SketchDocument::Command& command) {
  if (!document_.selection().empty()) document_.perform(command);
  changed_();
}

QuantityField* PenPanel::length_field(PanelSection& section, const char* name, double least, double& length) {
  auto* field = new QuantityField(Quantity::Length, section.body());
  field->setObjectName(QString("pen.%1").arg(name).toLower());
  field->setAccessibleName(name);
  field->show_value(length);
  field->on_refusal([&section](const QString& why) { section.note().keep(why); });
  field->on_commit([=, this, &length](std::optional<double> value, bool) -> base::Result<void> {
    if (!value || *value < least || *value > kWidestTip)
      return base::fail(QString("A length from %1 to %2 mm is needed.")
                            .arg(1000.0 * least)
                            .arg(1000.0 * kWidestTip)
                            .toStdString());
    length = *value;
    field->show_value(length);
    changed_();
    return {};
  });
  return field;
}

QCheckBox* PenPanel::check_box(PanelSection& section, const char* text, const char* tip, bool& flag) {
  auto* box = new QCheckBox(text, section.body());
  box->setAccessibleName(text);
  box->setToolTip(tip);
  box->setChecked(flag);
  connect(box, &QCheckBox::clicked, this, [this, &flag](bool on) {
    flag = on;
    changed_();
  });
  return box;
}

void PenPanel::add_line_rows() {
  QWidget* const body = pen_->body();
  auto* colour = new ColourButton("Colour", body);
  colour->show_colour(look_.colour);
  colour->on_choice([=, this](const world::Colour& chosen) {
    look_.colour = chosen;
    colour->show_colour(chosen);
    give_selected(command("colour", {{"colour", command_colour(chosen)}}));
  });
  pen_->add_row("Colour", "Of lines that are drawn, and of those that are selected", {colour});
  auto* fill = new ColourButton("Fill colour", body);
  fill->show_colour(look_.fill);
  fill->on_choice([=, this](const world::Colour& chosen) {
    look_.fill = chosen;
    fill->show_colour(chosen);
    changed_();
  });
  pen_->add_row("Fill", "Of the tool Fill", {fill});
  auto* opacity = new QuantityField(Quantity::Share, body);
  opacity->setObjectName("pen.opacity");
  opacity->setAccessibleName("Opacity");
  opacity->show_value(look_.opacity);
  opacity->on_refusal([this](const QString& why) { pen_->note().keep(why); });
  opacity->on_commit([=, this](std::optional<double> value, bool) -> base::Result<void> {
    if (!value || *value < 0.0 || *value > 1.0) return base::fail("An opacity is from 0 to 100 %.");
    look_.opacity = *value;
    opacity->show_value(value);
    give_selected(command("opacity", {{"opacity", *value}}));
    return {};
  });
  pen_->add_row("Opacity, %", "Of line and fill", {opacity});
  auto* ends = new QuietComboBox(body);
  ends->setAccessibleName("Ends");
  ends->addItems({"Round", "Flat"});
  ends->setCurrentIndex(look_.ends == drawing::CurveEnds::Flat ? 1 : 0);
  connect(ends, &QComboBox::activated, this, [this](int row) {
    look_.ends = row == 1 ? drawing::CurveEnds::Flat : drawing::CurveEnds::Round;
    give_selected(command("ends", {{"ends", row == 1 ? "flat" : "round"}}));
  });
  pen_->add_row("Ends", "The shape of a line where it begins and ends", {ends});
}

void PenPanel::add_pressure_rows() {
  pen_->add_row("Width, mm", "Of the line: without pressure, and at full pressure",
                {length_field(*pen_, "Thinnest", 0.0, look_.tip.thinnest),
                 length_field(*pen_, "Widest", 0.0, look_.tip.widest)});
  auto* pressure = new PressureEditor(pen_->body());
  pressure->show_curve(look_.pressure);
  pressure->on_change([this](const sketch::PressureCurve& curve) {
    look_.pressure = curve;
    changed_();
  });
  pen_->add_row("Pressure", pressure->toolTip(), {pressure});
  pen_->add_below(check_box(*pen_, "even width with a mouse", "Else it is wider the slower the mouse is",
                            look_.constant_width));
}

void PenPanel::offer_papers(std::string_view chosen, std::function<void(const sketch::Paper&)> lay) {
  auto* paper = new QuietComboBox(pen_->body());
  paper->setObjectName("pen.paper");
  paper->setAccessibleName("Paper");
  for (const sketch::Paper& it : sketch::papers()) {
    paper->addItem(QString::fromUtf8(it.name.data(), int(it.name.size())));
    paper->setItemData(paper->count() - 1, QString::fromUtf8(it.about.data(), int(it.about.size())),
                       Qt::ToolTipRole);
    if (it.name == chosen) paper->setCurrentIndex(paper->count() - 1);
  }
  connect(paper, &QComboBox::activated, this,
          [lay = std::move(lay)](int row) { lay(sketch::papers()[std::size_t(row)]); });
  pen_->add_row("Paper", "How it feels below a pen that pushes back", {paper});
}

void PenPanel::add_eraser_rows(PanelSection& eraser) {
  eraser.add_row("Radius, mm", "Of the circle that erases",
                 {length_field(eraser, "Eraser", kLeastEraser, look_.eraser_radius)});
  eraser.add_below(
      check_box(eraser, "whole strokes", "Takes away all of what it touches", look_.whole_strokes));
}

}  // namespace icome::ui
