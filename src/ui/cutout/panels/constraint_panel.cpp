#include "ui/cutout/panels/constraint_panel.h"

#include <fmt/format.h>

#include <QHBoxLayout>
#include <QListWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "ui/look/theme.h"
#include "ui/panels/object_look.h"

namespace icome::ui {
namespace {

using animation::Cell;
using animation::Constraint;
using animation::Vector2;

constexpr std::size_t kMostPathPlaces = 1000;
constexpr double kDegreesOfRadian = 180.0 / M_PI;

const animation::Joint* joint_of_child(const animation::Project& project, CellId child) {
  for (const Constraint& constraint : project.constraints)
    if (const auto* joint = std::get_if<animation::Joint>(&constraint.what); joint && joint->child == child)
      return joint;
  return nullptr;
}

/// Tells constraints in words.
struct Words {
  const animation::Project& project;

  QString name(CellId id) const {
    const Cell* const cell = project.find(id);
    return cell == nullptr ? QString("?") : shortened(one_line(cell->name), 24);
  }
  QString operator()(const animation::DistanceLimit& limit) const {
    const QString ends = QString("%1 and %2: ").arg(name(limit.one), name(limit.other));
    if (limit.least == limit.greatest) return ends + QString("%1 px apart").arg(limit.least, 0, 'f', 0);
    return ends + QString("%1 to %2 px apart").arg(limit.least, 0, 'f', 0).arg(limit.greatest, 0, 'f', 0);
  }
  QString operator()(const animation::Joint& joint) const {
    return QString("%1 hangs on %2").arg(name(joint.child), name(joint.parent));
  }
  QString operator()(const animation::Chain& chain) const {
    if (chain.cells.empty()) return "Chain";
    return QString("%1 to %2 bend as a chain").arg(name(chain.cells.front()), name(chain.cells.back()));
  }
  QString operator()(const animation::PathGuide& guide) const {
    return QString(guide.turns ? "%1 follows a path, turning" : "%1 follows a path").arg(name(guide.cell));
  }
  QString operator()(const animation::AxisGuide& guide) const {
    return QString("%1 stays on an axis at %2\u00b0")
        .arg(name(guide.cell))
        .arg(kDegreesOfRadian * guide.direction, 0, 'f', 0);
  }
};

}  // namespace

QString constraint_words(const animation::Project& project, const Constraint& constraint) {
  return std::visit(Words{project}, constraint.what);
}

// Making.

const Cell* ConstraintMaker::leading_paper(const char* need) const {
  const Cell* const cell = document_.leading();
  if (cell != nullptr && cell->id != animation::kCamera) return cell;
  document_.remark(need);
  return nullptr;
}

std::optional<std::pair<std::string, std::string>> ConstraintMaker::two_names(const char* need) const {
  const auto& selection = document_.selection();
  if (selection.size() != 2) {
    document_.remark(need);
    return std::nullopt;
  }
  return std::pair(document_.project().find(selection[0])->name,
                   document_.project().find(selection[1])->name);
}

/// Tells in words what was made.
void ConstraintMaker::make(const interaction::Value& command) {
  if (!document_.perform(command)) return;
  const Constraint& made = document_.project().constraints.back();
  document_.remark(constraint_words(document_.project(), made).toStdString() + ".");
}

void ConstraintMaker::join() {
  const auto names =
      two_names("Select two cells: first the one that hangs, then (Shift) the one that carries it.");
  if (!names) return;
  stage_.ask_places(
      QString("Click where %1 hangs on %2").arg(one_line(names->first), one_line(names->second)), 1, 1,
      [=, this](const std::vector<Vector2>& places) {
        make(cutout_command("join", {{"parent", names->second},
                                     {"child", names->first},
                                     {"at", command_point(places[0])},
                                     {"frame", document_.frame()}}));
      });
}

void ConstraintMaker::chain() {
  const Cell* const last = leading_paper("Select the last cell of the chain, such as a hand.");
  if (last == nullptr) return;
  const auto& selection = document_.selection();
  std::vector<std::string> names = {last->name};
  for (CellId cell = last->id; names.size() <= animation::kMostCells;) {
    const animation::Joint* const joint = joint_of_child(document_.project(), cell);
    // Among several selected cells, the chain goes as far as these.
    if (joint == nullptr || (selection.size() > 1 && !document_.is_selected(joint->parent))) break;
    cell = joint->parent;
    names.insert(names.begin(), document_.project().find(cell)->name);
  }
  if (names.size() < 2)
    return document_.remark("A chain needs joints: join the cell to the one that carries it first.");
  make(cutout_command("chain", {{"cells", command_texts(names)}}));
}

void ConstraintMaker::keep_distance() {
  const auto names = two_names("Select the two cells whose distance is to be kept.");
  if (!names) return;
  stage_.ask_places(QString("Click on the place of %1, then on that of %2, whose distance is kept")
                        .arg(one_line(names->first), one_line(names->second)),
                    2, 2, [=, this](const std::vector<Vector2>& places) {
                      const double apart = (places[1] - places[0]).norm();
                      make(cutout_command("limit-distance", {{"one", names->first},
                                                             {"other", names->second},
                                                             {"least", apart},
                                                             {"greatest", apart},
                                                             {"at_one", command_point(places[0])},
                                                             {"at_other", command_point(places[1])},
                                                             {"frame", document_.frame()}}));
                    });
}

void ConstraintMaker::guide_by_path(bool turns) {
  const Cell* const cell = leading_paper("Select the cell that is to follow a path.");
  if (cell == nullptr) return;
  stage_.ask_places(
      "Click along the path; Enter or a double click ends it", 2, kMostPathPlaces,
      [=, this, name = cell->name](const std::vector<Vector2>& places) {
        interaction::Value::List way;
        for (const Vector2& place : places) way.push_back(command_point(place));
        make(cutout_command("path",
                            {{"cell", name}, {"way", way}, {"turns", turns}, {"frame", document_.frame()}}));
      });
}

void ConstraintMaker::guide_by_axis() {
  const Cell* const cell = leading_paper("Select the cell that is to stay on an axis.");
  if (cell == nullptr) return;
  stage_.ask_places(
      "Click on two places: the axis goes through the cell in that direction", 2, 2,
      [=, this, name = cell->name](const std::vector<Vector2>& places) {
        const Vector2 way = places[1] - places[0];
        const double angle = kDegreesOfRadian * std::atan2(-way.y(), way.x());
        make(cutout_command("axis", {{"cell", name}, {"direction", angle}, {"frame", document_.frame()}}));
      });
}

void ConstraintMaker::release() {
  animation::ProjectEdit edit;
  const auto take = [&](bool chains) {
    for (const Constraint& constraint : document_.project().constraints) {
      if (std::holds_alternative<animation::Chain>(constraint.what) != chains) continue;
      const auto cells = animation::cells_of(constraint);
      if (std::ranges::any_of(cells, [&](CellId cell) { return document_.is_selected(cell); }))
        edit.push_back(animation::TakeConstraint{constraint.id});
    }
  };
  take(true);  // chains need their joints
  take(false);
  if (edit.empty()) return document_.remark("What is selected has no constraints.");
  document_.perform(edit);
}

// The panel.

ConstraintPanel::ConstraintPanel(CutoutDocument& document, ConstraintMaker& maker, QWidget* parent)
    : QWidget(parent),
      document_(document),
      maker_(maker),
      section_(new PanelSection("Constraints", this)),
      list_(new QListWidget(section_->body())) {
  setObjectName("constraints");
  list_->setObjectName("constraints.list");
  list_->setAccessibleName("Constraints");
  list_->setMaximumHeight(32 * kGrid);
  section_->add_wide(list_);
  auto* buttons = new QWidget(section_->body());
  auto* row = new QHBoxLayout(buttons);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kGrid);
  row->addWidget(add_button("join", "Join two cells: select the one that hangs, then the one that carries it",
                            Icon::Joint, [this] { maker_.join(); }));
  row->addWidget(add_button("chain", "Chain: the selected cell draws those it hangs on after it", Icon::Chain,
                            [this] { maker_.chain(); }));
  row->addWidget(add_button("distance", "Keep the distance of two cells", Icon::Distance,
                            [this] { maker_.keep_distance(); }));
  row->addWidget(add_button("path", "Path: the selected cell stays on a line", Icon::Way,
                            [this] { maker_.guide_by_path(false); }));
  row->addWidget(add_button("axis", "Axis: the selected cell stays on a straight line", Icon::Axis,
                            [this] { maker_.guide_by_axis(); }));
  release_ = add_button("release", "Release: take the chosen constraint away", Icon::Delete,
                        [this] { release_chosen(); });
  row->addWidget(release_);
  row->addStretch();
  section_->add_wide(buttons);
  nearest_ = add_limit(Quantity::Pixels, "constraints.nearest", false);
  farthest_ = add_limit(Quantity::Pixels, "constraints.farthest", true);
  distance_row_ = section_->add_row("Distance, px", "From least to greatest", {nearest_, farthest_});
  least_ = add_limit(Quantity::Angle, "constraints.least", false);
  greatest_ = add_limit(Quantity::Angle, "constraints.greatest", true);
  least_->allow_none("free");
  greatest_->allow_none("free");
  angle_row_ = section_->add_row("Turn, \u00b0", "Least and greatest angle to the cell that carries it",
                                 {least_, greatest_});
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(section_);
  connect(list_, &QListWidget::currentRowChanged, this, [this] {
    if (showing_) return;
    show_limits();
    if (const Constraint* const constraint = chosen()) document_.select(animation::cells_of(*constraint));
  });
  refresh();
}

QToolButton* ConstraintPanel::add_button(const char* name, const QString& text, Icon picture,
                                         std::function<void()> act) {
  auto* button = new QToolButton(section_->body());
  button->setObjectName(QString("constraints.%1").arg(name));
  button->setIcon(icon(picture));
  button->setToolTip(text);
  button->setAccessibleName(text);
  button->setAutoRaise(true);
  button->setFocusPolicy(Qt::StrongFocus);
  connect(button, &QToolButton::clicked, this, std::move(act));
  return button;
}

QuantityField* ConstraintPanel::add_limit(Quantity quantity, const char* name, bool greatest) {
  auto* field = new QuantityField(quantity, section_->body());
  field->setObjectName(name);
  field->setAccessibleName(greatest ? "Greatest" : "Least");
  field->on_refusal([this](const QString& why) { section_->note().keep(why); });
  field->on_commit([=, this](std::optional<double> value, bool) { return set_limit(greatest, value); });
  return field;
}

const Constraint* ConstraintPanel::chosen() const {
  const int row = list_->currentRow();
  const auto& all = document_.project().constraints;
  return row < 0 || row >= int(all.size()) ? nullptr : &all[std::size_t(row)];
}

void ConstraintPanel::show_limits() {
  const Constraint* const constraint = chosen();
  const auto* const distance =
      constraint ? std::get_if<animation::DistanceLimit>(&constraint->what) : nullptr;
  const auto* const joint = constraint ? std::get_if<animation::Joint>(&constraint->what) : nullptr;
  distance_row_.set_visible(distance != nullptr);
  angle_row_.set_visible(joint != nullptr);
  release_->setEnabled(constraint != nullptr);
  if (distance != nullptr) {
    nearest_->show_value(distance->least);
    farthest_->show_value(distance->greatest);
  }
  if (joint == nullptr) return;
  least_->show_value(joint->limits ? std::optional(joint->limits->least) : std::nullopt);
  greatest_->show_value(joint->limits ? std::optional(joint->limits->greatest) : std::nullopt);
}

base::Result<void> ConstraintPanel::set_limit(bool greatest, std::optional<double> value) {
  const Constraint* const old = chosen();
  if (old == nullptr) return {};
  Constraint changed = *old;
  if (auto* const distance = std::get_if<animation::DistanceLimit>(&changed.what)) {
    if (!value || *value < 0.0) return base::fail("A distance of at least 0 px is needed.");
    (greatest ? distance->greatest : distance->least) = *value;
    // The other end gives way.
    if (distance->least > distance->greatest) (greatest ? distance->least : distance->greatest) = *value;
  }
  if (auto* const joint = std::get_if<animation::Joint>(&changed.what)) {
    if (!value) {
      joint->limits.reset();
    } else {
      animation::AngleLimits limits = joint->limits.value_or(animation::AngleLimits{*value, *value});
      (greatest ? limits.greatest : limits.least) = *value;
      if (limits.least > limits.greatest) (greatest ? limits.least : limits.greatest) = *value;
      joint->limits = limits;
    }
  }
  const auto place = std::size_t(list_->currentRow());
  // A chain needs its joints, so chains of this one are put anew with it.
  animation::ProjectEdit edit, after;
  for (std::size_t i = 0; i < document_.project().constraints.size(); ++i) {
    const Constraint& it = document_.project().constraints[i];
    if (!std::holds_alternative<animation::Chain>(it.what) || it.id == changed.id) continue;
    edit.push_back(animation::TakeConstraint{it.id});
    after.push_back(animation::PutConstraint{i, it});
  }
  edit.push_back(animation::TakeConstraint{changed.id});
  std::size_t before = 0;
  for (std::size_t i = 0; i < place; ++i)
    if (!std::holds_alternative<animation::Chain>(document_.project().constraints[i].what)) ++before;
  edit.push_back(animation::PutConstraint{before, changed});
  edit.insert(edit.end(), after.begin(), after.end());
  document_.perform(edit);
  return {};
}

void ConstraintPanel::release_chosen() {
  const Constraint* const constraint = chosen();
  if (constraint == nullptr) return;
  document_.perform(cutout_command("free", {{"number", double(constraint->id.value)}}));
}

void ConstraintPanel::refresh() {
  showing_ = true;
  const int row = list_->currentRow();
  list_->clear();
  for (const Constraint& constraint : document_.project().constraints)
    list_->addItem(constraint_words(document_.project(), constraint));
  list_->setCurrentRow(std::min(row, list_->count() - 1));
  list_->setVisible(list_->count() > 0);
  showing_ = false;
  show_limits();
}

}  // namespace icome::ui
