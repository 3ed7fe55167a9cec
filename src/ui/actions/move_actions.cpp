#include "ui/actions/move_actions.h"

#include <QDialog>
#include <QDialogButtonBox>
#include <QVBoxLayout>

#include "ui/actions/actions.h"
#include "ui/forms/quantity_field.h"
#include "ui/look/theme.h"
#include "ui/panels/object_look.h"
#include "ui/panels/panel_section.h"

namespace icome::ui {
namespace {

using session::GrabSettings;

struct SwitchEntry {
  const char* name;
  const char* text;
  const char* tip;
  bool& (*of)(GrabSettings& settings);
};
const SwitchEntry kSwitches[] = {
    {"move.stop", "&Stop at Surfaces", "What is moved goes through nothing, and slides along what it meets",
     [](GrabSettings& it) -> bool& { return it.stop; }},
    {"move.snap_grid", "Snap to &Grid", "Corners, middle or origin of what is moved snap to the grid",
     [](GrabSettings& it) -> bool& { return it.snaps.grid; }},
    {"move.snap_corners", "Snap to &Corners", "To the corners of other objects",
     [](GrabSettings& it) -> bool& { return it.snaps.vertices; }},
    {"move.snap_edges", "Snap to &Edges", "To the edges of other objects, and to the middles of edges",
     [](GrabSettings& it) -> bool& { return it.snaps.edges; }},
    {"move.snap_faces", "Snap to &Faces", "To the surfaces of other objects",
     [](GrabSettings& it) -> bool& { return it.snaps.faces; }},
    {"move.pull_back", "&Pull Back",
     "A device feels what it holds pull back, the more the farther it is taken",
     [](GrabSettings& it) -> bool& { return it.pull_back; }},
};

struct NumberEntry {
  const char* name;
  const char* text;
  const char* tip;
  Quantity quantity;
  double least, most;
  double& (*of)(GrabSettings& settings);
};
const NumberEntry kNumbers[] = {
    {"move.grid_spacing", "Grid spacing", "From one place of the grid to the next", Quantity::Length, 1e-5,
     10.0, [](GrabSettings& it) -> double& { return it.snaps.spacing; }},
    {"move.snap_radius", "Snap radius", "How near things come to what they snap to", Quantity::Length, 1e-4,
     1.0, [](GrabSettings& it) -> double& { return it.snaps.radius; }},
    {"move.snap_strength", "Snap strength", "The strongest pull that a device feels of a snap",
     Quantity::Force, 0.0, 5.0, [](GrabSettings& it) -> double& { return it.snap_strength; }},
    {"move.weight", "Weight", "What a device feels of the weight of what it holds", Quantity::Force, 0.0, 5.0,
     [](GrabSettings& it) -> double& { return it.weight; }},
};

/// Is the value allowed? False for NaN.
bool in_range(const NumberEntry& entry, double value) { return value >= entry.least && value <= entry.most; }

std::string range_of(const NumberEntry& entry) {
  const auto text = [&](double value) {
    return QString("%1 %2").arg(number_text(value, entry.quantity), unit_of(entry.quantity));
  };
  return QString("Choose from %1 to %2.").arg(text(entry.least), text(entry.most)).toStdString();
}

}  // namespace

MoveActions::MoveActions(session::Session& session, QSettings& settings)
    : session_(session), settings_(settings) {
  load();
  apply();
}

void MoveActions::load() {
  for (const SwitchEntry& it : kSwitches) it.of(grab_) = settings_.value(it.name, it.of(grab_)).toBool();
  for (const NumberEntry& it : kNumbers) {
    bool good = false;
    const double value = settings_.value(it.name).toDouble(&good);
    if (good && in_range(it, value)) it.of(grab_) = value;
  }
}

void MoveActions::apply() {
  grab_.snaps.middles = grab_.snaps.edges;
  session_.hands().set_grab(grab_);
}

void MoveActions::fill(QMenu& menu, QWidget& window) {
  menu.setToolTipsVisible(true);
  for (const SwitchEntry& it : kSwitches) {
    QAction* action = menu.addAction(it.text);
    action->setObjectName(it.name);
    action->setToolTip(tip_of(it.tip));
    action->setStatusTip(it.tip);
    action->setCheckable(true);
    action->setChecked(it.of(grab_));
    QObject::connect(action, &QAction::toggled, action, [this, &it](bool on) {
      it.of(grab_) = on;
      settings_.setValue(it.name, on);
      apply();
    });
  }
  menu.addSeparator();
  add_action(menu, "move.numbers", "&Distances and Forces…", {}, [this, &window] { show_numbers(window); });
}

void MoveActions::show_numbers(QWidget& window) {
  auto* box = new QDialog(&window);
  box->setObjectName("move.box");
  box->setWindowTitle("Moving");
  box->setAttribute(Qt::WA_DeleteOnClose);
  auto* section = new PanelSection({}, box);
  for (const NumberEntry& it : kNumbers) {
    auto* field = new QuantityField(it.quantity, section);
    field->setObjectName(it.name);
    field->show_value(it.of(grab_));
    field->on_refusal([section](const QString& why) {
      why.isEmpty() ? section->note().clear() : section->note().say(why);
    });
    field->on_commit([this, &it](std::optional<double> value, bool) -> base::Result<void> {
      if (!value || !in_range(it, *value)) return base::fail(range_of(it));
      it.of(grab_) = *value;
      settings_.setValue(it.name, *value);
      apply();
      return {};
    });
    section->add_row(QString("%1, %2").arg(it.text, unit_of(it.quantity)), it.tip, {field});
  }
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, box);
  QObject::connect(buttons, &QDialogButtonBox::rejected, box, &QDialog::close);
  auto* rows = new QVBoxLayout(box);
  rows->setContentsMargins(0, 2 * kGrid, 3 * kGrid, 3 * kGrid);
  rows->addWidget(section);
  rows->addWidget(buttons);
  box->show();
}

}  // namespace icome::ui
