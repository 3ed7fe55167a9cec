#include "ui/cutout/panels/cell_panel.h"

#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/cutout/time/exposure_sheet.h"
#include "ui/look/theme.h"
#include "ui/panels/object_look.h"

namespace icome::ui {
namespace {

using animation::Cell;

constexpr double kLargestCellScale = 1e4;

}  // namespace

CellPanel::CellPanel(CutoutDocument& document, QWidget* parent)
    : QWidget(parent), document_(document), section_(new PanelSection("Cell", this)) {
  setObjectName("cell");
  none_ = new QLabel("Select a cell on the stage to see its values.", section_->body());
  none_->setWordWrap(true);
  section_->add_wide(none_);
  name_ = new TextField(section_->body());
  name_->setObjectName("cell.name");
  name_->setAccessibleName("Name of the cell");
  name_->on_refusal([this](const QString& why) { section_->note().keep(why); });
  name_->on_commit([this](const std::string& name) -> base::Result<void> {
    const Cell* const cell = document_.leading();
    if (cell == nullptr || name == cell->name) return {};
    if (name.empty()) return base::fail("A cell needs a name.");
    if (document_.project().find(name) != nullptr) return base::fail("Another cell has that name.");
    document_.perform(cutout_command("change-cell", {{"cell", cell->name}, {"name", name}}));
    return {};
  });
  name_row_ = section_->add_row("Name", "Of the cell, in scripts, too", {name_});
  x_ = add_field(Quantity::Pixels, "cell.x", "x of the pivot on the stage");
  y_ = add_field(Quantity::Pixels, "cell.y", "y of the pivot on the stage");
  set_channel_of(*x_, Channel::X);
  set_channel_of(*y_, Channel::Y);
  place_row_ = section_->add_row("Place, px", "Of the pivot on the stage: to the right, and down", {x_, y_});
  angle_ = add_field(Quantity::Angle, "cell.angle", "Angle");
  set_channel_of(*angle_, Channel::Angle);
  angle_row_ = section_->add_row("Angle, \u00b0", "Counter-clockwise", {angle_});
  scale_ = add_field(Quantity::Share, "cell.scale", "Scale");
  set_channel_of(*scale_, Channel::Scale);
  scale_row_ = section_->add_row("Scale, %", "100: as large as its picture", {scale_});
  opacity_ = add_field(Quantity::Share, "cell.opacity", "Opacity");
  set_channel_of(*opacity_, Channel::Opacity);
  opacity_row_ = section_->add_row("Opacity, %", "100: nothing is seen through it", {opacity_});
  picture_ = new QuietComboBox(section_->body());
  picture_->setObjectName("cell.picture");
  picture_->setAccessibleName("Picture that is shown");
  connect(picture_, &QComboBox::activated, this,
          [this](int row) { (void)set_value(Channel::Picture, row - 1); });
  picture_row_ = section_->add_row("Picture", "From the present frame on", {picture_});
  pivot_x_ = add_field(Quantity::Pixels, "cell.pivot_x", "x of the pivot in the picture");
  pivot_y_ = add_field(Quantity::Pixels, "cell.pivot_y", "y of the pivot in the picture");
  set_pivot_of(*pivot_x_, true);
  set_pivot_of(*pivot_y_, false);
  pivot_row_ = section_->add_row("Pivot, px", "The point in its picture about which it turns, at all frames",
                                 {pivot_x_, pivot_y_});
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(section_);
  refresh();
}

QuantityField* CellPanel::add_field(Quantity quantity, const char* name, const QString& accessible) {
  auto* field = new QuantityField(quantity, section_->body());
  field->setObjectName(name);
  field->setAccessibleName(accessible);
  field->on_refusal([this](const QString& why) { section_->note().keep(why); });
  return field;
}

void CellPanel::set_channel_of(QuantityField& field, Channel channel) {
  field.on_commit([this, channel](std::optional<double> value, bool more) -> base::Result<void> {
    if (!value) return base::fail("A number is needed.");
    return set_in_step(more, [&] { return set_value(channel, *value); });
  });
}

/// Further steps of the same turn are one step to undo.
base::Result<void> CellPanel::set_in_step(bool more, const std::function<base::Result<void>()>& set) {
  if (!more || document_.steps() != steps_before_ + 1) steps_before_ = document_.steps();
  auto done = set();
  document_.join_steps(steps_before_);
  return done;
}

void CellPanel::set_pivot_of(QuantityField& field, bool across) {
  field.on_commit([this, across](std::optional<double> value, bool more) -> base::Result<void> {
    if (!value) return base::fail("A number is needed.");
    return set_in_step(more, [&] { return set_pivot(across, *value); });
  });
}

base::Result<void> CellPanel::set_value(Channel channel, double value) {
  const Cell* const cell = document_.leading();
  if (cell == nullptr) return {};
  if (is_locked(document_.project(), cell->id)) return base::fail("The cell lies on a locked layer.");
  if (channel == Channel::Opacity && (value < 0.0 || value > 1.0))
    return base::fail("An opacity is from 0 to 100 %.");
  if (channel == Channel::Scale && (value <= 0.0 || value > kLargestCellScale))
    return base::fail("A scale is above 0 %.");
  const bool is_posed = channel == Channel::X || channel == Channel::Y || channel == Channel::Angle;
  if (!is_posed) {
    document_.perform(one_key(document_.project(), cell->id, channel, document_.frame(), value));
    return {};
  }
  const auto shown = document_.shown().find(cell->id);
  if (shown == document_.shown().end()) return {};
  animation::Hold hold{.cell = cell->id, .wish = shown->second};
  animation::set_channel(hold.wish, channel, value);
  document_.try_out({hold});
  document_.keep();
  return {};
}

base::Result<void> CellPanel::set_pivot(bool across, double value) {
  const Cell* const cell = document_.leading();
  if (cell == nullptr || cell->id == animation::kCamera) return {};
  animation::Vector2 pivot = cell->pivot;
  (across ? pivot.x() : pivot.y()) = value;
  document_.perform(cutout_command("change-cell", {{"cell", cell->name}, {"pivot", command_point(pivot)}}));
  return {};
}

void CellPanel::show_label(const PanelSection::Row& row, const QString& text,
                           std::initializer_list<Channel> channels) {
  const Cell* const cell = document_.leading();
  const bool is_keyed =
      cell != nullptr && std::ranges::any_of(channels, [&](Channel channel) {
        return animation::key_at(cell->tracks[std::size_t(channel)], document_.frame()) != nullptr;
      });
  row.label->setText(is_keyed ? text + QString::fromUtf8(" \u25c6") : text);
}

void CellPanel::refresh() {
  const Cell* const cell = document_.leading();
  const auto shown = cell == nullptr ? document_.shown().end() : document_.shown().find(cell->id);
  const bool is_there = cell != nullptr && shown != document_.shown().end();
  const bool is_paper = is_there && cell->id != animation::kCamera;
  none_->setVisible(!is_there);
  for (const PanelSection::Row* row : {&place_row_, &angle_row_, &scale_row_}) row->set_visible(is_there);
  for (const PanelSection::Row* row : {&name_row_, &opacity_row_, &picture_row_, &pivot_row_})
    row->set_visible(is_paper);
  if (!is_there) return;
  const animation::CellState& state = shown->second;
  x_->show_value(state.place.x());
  y_->show_value(state.place.y());
  angle_->show_value(state.angle);
  scale_->show_value(state.scale);
  show_label(place_row_, "Place, px", {Channel::X, Channel::Y});
  show_label(angle_row_, QString::fromUtf8("Angle, \u00b0"), {Channel::Angle});
  show_label(scale_row_, "Scale, %", {Channel::Scale});
  if (!is_paper) return;
  name_->show_text(cell->name);
  opacity_->show_value(state.opacity);
  pivot_x_->show_value(cell->pivot.x());
  pivot_y_->show_value(cell->pivot.y());
  show_label(opacity_row_, "Opacity, %", {Channel::Opacity});
  show_label(picture_row_, "Picture", {Channel::Picture});
  const QSignalBlocker quiet(picture_);
  QStringList names = {"None"};
  for (int i = 0; i < int(cell->pictures.size()); ++i)
    names << QString("%1  %2").arg(i + 1).arg(shortened(short_picture_name(*cell, i)));
  QStringList before;
  for (int i = 0; i < picture_->count(); ++i) before << picture_->itemText(i);
  if (names != before) {
    picture_->clear();
    picture_->addItems(names);
  }
  picture_->setCurrentIndex(std::clamp(state.picture + 1, 0, int(cell->pictures.size())));
}

}  // namespace icome::ui
