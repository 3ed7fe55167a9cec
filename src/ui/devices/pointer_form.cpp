#include "ui/devices/pointer_form.h"

#include <QAbstractItemView>
#include <QHBoxLayout>
#include <QVBoxLayout>
#include <utility>

#include "devices/device_news.h"
#include "devices/mapping_file.h"
#include "ui/look/theme.h"
#include "ui/panels/object_look.h"

namespace icome::ui {
namespace {

constexpr int kButtons = 8;  // offered as a clutch

void show_text(QLabel& label, const QString& text) {
  if (label.text() != text) label.setText(text);
}

/// The sentences that a device says of itself, one a line.
QString sentences(const std::string& condition) {
  QStringList lines;
  for (const QString& line : QString::fromStdString(condition).split('\n', Qt::SkipEmptyParts)) {
    const QString shown = one_line(line.toStdString());
    lines << (shown.endsWith('.') ? shown : shown + ".");
  }
  return lines.join('\n');
}

/// The state of a device in words.
QString condition_words(const session::PointerView& view, const session::PointerUse& use) {
  const QString why = sentences(use.condition);
  if (view.time == 0) return "It is being taken in.";
  if (view.status == devices::DeviceStatus::Lost)
    return why.isEmpty() ? QString("It does not answer; it is used again as soon as it does.") : why;
  if (!why.isEmpty()) return why;
  return use.clutched ? "The clutch is held: the hand is free." : "It is ready.";
}

QString place_words(const session::PointerView& view) {
  const base::Vector3 place = 1000.0 * view.device_from_stylus.translation();
  const auto number = [](double value) { return QString::number(value, 'f', 1); };
  return QString("%1, %2, %3 mm").arg(number(place.x()), number(place.y()), number(place.z()));
}

}  // namespace

PointerForm::PointerForm(session::Session& session, std::size_t pointer, QWidget* parent)
    : QWidget(parent), session_(session), number_(session.hands().use(pointer).number) {
  const session::PointerUse use = session.hands().use(pointer);
  const QString name = one_line(session.hands().pointer_info(pointer).name);
  const QString address = one_line(use.address);
  section_ =
      new PanelSection(address.isEmpty() || address == name ? name : name + " \u2013 " + address, this);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->addWidget(section_);
  setAccessibleName(name);
  add_live();
  if (use.mapping) add_mapping();
  add_buttons(use);
  refresh();
}

/// The present index of the pointer; nothing: it has been disconnected.
std::optional<std::size_t> PointerForm::pointer() const {
  for (std::size_t i = 0; i < session_.hands().pointers(); ++i)
    if (session_.hands().use(i).number == number_) return i;
  return std::nullopt;
}

void PointerForm::add_live() {
  const auto line = [this](const char* name) {
    auto* label = new QLabel(section_->body());
    label->setTextFormat(Qt::PlainText);
    label->setAccessibleName(name);
    return label;
  };
  condition_ = new WrappedLabel({}, section_->body());
  condition_->setAccessibleName("Condition");
  section_->add_wide(condition_);
  force_ = line("Force");
  place_ = line("Place");
  section_->add_row("Force", "That the device gives to the hand now", {force_});
  section_->add_row("Place", "Of the tip, from the middle of its workspace: right, up, to the user",
                    {place_});
}

void PointerForm::add_mapping() {
  QWidget* const body = section_->body();
  const auto hear = [this](const QString& why) { section_->note().keep(why); };
  scale_ = new QuantityField(Quantity::Plain, body);
  scale_->on_refusal(hear);
  scale_->on_commit([this](std::optional<double> value, bool) {
    return change([value](auto& mapping) { mapping.scale = value.value_or(1.0); });
  });
  section_->add_row("Scale", "Metres that the tip moves for each metre of the hand", {scale_});
  follows_ = new QCheckBox("follows the view", body);
  follows_->setAccessibleName("Scale follows the view");
  follows_->setToolTip("The workspace spans what is seen: nearer views are touched more finely");
  section_->add_below(follows_);
  connect(follows_, &QCheckBox::clicked, this,
          [this](bool on) { try_change([on](auto& mapping) { mapping.scale_follows_view = on; }); });
  most_force_ = new QuantityField(Quantity::Force, body);
  most_force_->allow_none("device's own");
  most_force_->on_refusal(hear);
  most_force_->on_commit([this](std::optional<double> value, bool) {
    return change([value](auto& mapping) { mapping.max_force = value.value_or(0.0); });
  });
  section_->add_row("Most force, N", "The device never gives more than this", {most_force_});
  clutch_ = new QuietComboBox(body);
  clutch_->addItem("none", -1);
  for (int i = 0; i < kButtons; ++i) clutch_->addItem(QString("button %1").arg(i), i);
  section_->add_row("Clutch", "While this button is down the tip stays and the hand is free; counted from 0",
                    {clutch_});
  connect(clutch_, &QComboBox::activated, this, [this](int row) {
    const int button = clutch_->itemData(row).toInt();
    try_change([button](auto& mapping) { mapping.clutch_button = button; });
  });
  reach_ = new QLabel(body);
  section_->add_row("Reach", "Radius of the sphere that the tip can reach in the scene", {reach_});
  shown_ = new QCheckBox("shown in the scene", body);
  shown_->setAccessibleName("Workspace shown in the scene");
  shown_->setToolTip(
      "Draws that sphere; in any case it is seen for two seconds after a change, and while the clutch is "
      "held");
  section_->add_below(shown_);
  connect(shown_, &QCheckBox::clicked, this, [this](bool on) {
    if (const auto index = pointer()) session_.hands().show_workspace(*index, on);
  });
}

void PointerForm::add_buttons(const session::PointerUse& use) {
  auto* row = new QWidget(section_->body());
  auto* buttons = new QHBoxLayout(row);
  buttons->setContentsMargins(0, kGrid, 0, 0);
  if (use.mapping && !use.address.empty()) {
    auto* save_button = new QPushButton("Save", row);
    save_button->setToolTip("Keeps these settings in the device's profile: " +
                            QString::fromStdString(devices::mapping_path(use.address).string()));
    buttons->addWidget(save_button);
    connect(save_button, &QPushButton::clicked, this, [this] { save(); });
  }
  auto* leave = new QPushButton("Disconnect", row);
  buttons->addWidget(leave);
  buttons->addStretch(1);
  // The panel makes its forms anew after this, and not while the button is at work.
  connect(leave, &QPushButton::clicked, this, [this] {
    if (const auto index = pointer()) (void)session_.hands().disconnect(*index);
  });
  section_->add_wide(row);
}

void PointerForm::refresh() {
  const auto index = pointer();
  if (!index) return;
  const session::PointerView& view = session_.hands().pointer(*index);
  const session::PointerUse use = session_.hands().use(*index);
  const bool there = view.time != 0 && view.status != devices::DeviceStatus::Lost;
  condition_->say(condition_words(view, use));
  // What the servo asks for goes nowhere while the device may not push.
  const double force = devices::gives_no_force(use.condition) ? 0.0 : view.force.norm();
  const double most = session_.hands().pointer_info(*index).max_force;
  show_text(*force_,
            there ? QString("%1 of %2 N").arg(force, 0, 'f', 2).arg(most, 0, 'f', 1) : QString("\u2013"));
  show_text(*place_, there ? place_words(view) : QString("\u2013"));
  if (use.mapping) refresh_mapping(use);
}

void PointerForm::refresh_mapping(const session::PointerUse& use) {
  scale_->show_value(use.mapping->scale.value_or(1.0));
  scale_->setReadOnly(use.mapping->scale_follows_view);
  follows_->setChecked(use.mapping->scale_follows_view);
  most_force_->show_value(use.mapping->max_force > 0.0 ? std::optional(use.mapping->max_force)
                                                       : std::nullopt);
  const int button = use.mapping->clutch_button;
  if (clutch_->findData(button) < 0) clutch_->addItem(QString("button %1").arg(button), button);
  if (!clutch_->view()->isVisible()) clutch_->setCurrentIndex(clutch_->findData(button));
  show_text(*reach_, QString("%1 mm").arg(number_text(use.mapping->scale.value_or(1.0) * use.own_radius,
                                                      Quantity::Length, 0)));
  shown_->setChecked(use.shows_workspace);
}

base::Result<void> PointerForm::change(const std::function<void(devices::DeviceMapping&)>& edit) {
  const auto index = pointer();
  if (!index) return {};
  devices::DeviceMapping mapping = *session_.hands().use(*index).mapping;
  edit(mapping);
  const auto done = session_.hands().set_mapping(*index, mapping);
  if (done) section_->note().clear();
  return done;
}

void PointerForm::try_change(const std::function<void(devices::DeviceMapping&)>& edit) {
  if (const auto done = change(edit); !done)
    section_->note().say(QString::fromStdString(done.error().message));
  refresh();
}

bool PointerForm::finish_typing() {
  return (!scale_ || scale_->finish()) && (!most_force_ || most_force_->finish());
}

void PointerForm::save() {
  const auto index = pointer();
  if (!index || !finish_typing()) return;
  const session::PointerUse use = session_.hands().use(*index);
  const auto done = devices::write_mapping(use.address, *use.mapping, "icome, the window's Devices");
  if (!done) return section_->note().say(QString::fromStdString(done.error().message));
  section_->note().remark("Kept in " + QString::fromStdString(devices::mapping_path(use.address).string()));
}

}  // namespace icome::ui
