#include "ui/panels/property_binder.h"

#include <QCheckBox>
#include <QSignalBlocker>
#include <QSlider>
#include <algorithm>
#include <cmath>

#include "ui/forms/colour_button.h"
#include "ui/forms/quiet_combo_box.h"
#include "ui/forms/text_field.h"
#include "ui/panels/object_look.h"

namespace icome::ui {

using base::Result;
using world::ObjectId;

namespace {

QString noun_of(PropertyBinder::Of of) {
  switch (of) {
    case PropertyBinder::Of::Shapes:
      return "shapes";
    case PropertyBinder::Of::Materials:
      return "materials";
    case PropertyBinder::Of::Lights:
      return "lights";
    case PropertyBinder::Of::Viewpoints:
      return "viewpoints";
    case PropertyBinder::Of::Effects:
      return "effects";
    case PropertyBinder::Of::Objects:
      break;
  }
  return "objects";
}

/// A function that shows refusals in the section's note.
auto told_to(const PanelSection& section) {
  return [&note = section.note()](const QString& why) { note.say(why); };
}

}  // namespace

const std::vector<ObjectId>& PropertyBinder::list(Of of) const {
  switch (of) {
    case Of::Shapes:
      return subjects_.shapes;
    case Of::Materials:
      return subjects_.materials;
    case Of::Lights:
      return subjects_.lights;
    case Of::Viewpoints:
      return subjects_.viewpoints;
    case Of::Effects:
      return subjects_.effects;
    case Of::Objects:
      break;
  }
  return subjects_.objects;
}

std::string PropertyBinder::action(const QString& verb, Of of) const {
  const std::vector<ObjectId>& all = list(of);
  if (all.size() != 1) return action_name(verb, QString("%1 %2").arg(all.size()).arg(noun_of(of)));
  const world::World& world = session_.world();
  return action_name(verb, of == Of::Materials ? shown_name(world, world.find(all.front())->material)
                                               : shown_name(world, all.front()));
}

void PropertyBinder::refresh() {
  subjects_ = subjects_of(session_.world(), session_.selection());
  for (const auto& refresher : refreshers_) refresher();
}

template <typename Value>
Result<void> PropertyBinder::set(const void* control, const Row& row, const Property<Value>& property,
                                 const Value& value, bool more) {
  subjects_ = subjects_of(session_.world(), session_.selection());  // brings them up to date
  const std::vector<ObjectId>& objects = list(row.of);
  const Common<Value> now = common(session_.world(), objects, property);
  if (!now.shared_by_all) return base::fail("What is selected now has no such value.");
  if (now.value && *now.value == value) return {};
  const auto edit = edit_all(session_.world(), objects, property, value);
  if (!edit) return tl::unexpected(edit.error());
  return perform(control, *edit, action(row.verb, row.of), more);
}

QuantityField* PropertyBinder::number_field(PanelSection& section, const Row& row, Quantity quantity,
                                            const Property<double>& property) {
  auto* field = new QuantityField(quantity, section.body());
  field->on_refusal(told_to(section));
  field->on_commit([this, field, row, property](std::optional<double> value, bool more) -> Result<void> {
    return value ? set(field, row, property, *value, more) : Result<void>();
  });
  return field;
}

void PropertyBinder::number(PanelSection& section, const Row& row, Quantity quantity,
                            const Property<double>& property) {
  QuantityField* field = number_field(section, row, quantity, property);
  const PanelSection::Row shown = section.add_row(row.label, row.tip, {field});
  follow([this, field, shown, row, property] {
    const Common<double> now = common(session_.world(), list(row.of), property);
    shown.set_visible(now.shared_by_all);
    now.value || !now.shared_by_all ? field->show_value(now.value) : field->show_mixed();
  });
}

void PropertyBinder::slider(PanelSection& section, const Row& row, Quantity quantity,
                            const Property<double>& property, double least, double most) {
  constexpr int kSteps = 500;
  QuantityField* field = number_field(section, row, quantity, property);
  auto* slider = new QSlider(Qt::Horizontal, section.body());
  slider->setRange(0, kSteps);
  slider->setPageStep(kSteps / 20);
  slider->setAccessibleName(row.label);
  const auto told = told_to(section);
  const auto dragged = std::make_shared<bool>(false);  // has this drag changed anything yet?
  QObject::connect(slider, &QSlider::sliderPressed, slider, [dragged] { *dragged = false; });
  QObject::connect(slider, &QSlider::valueChanged, slider, [=, this](int step) {
    const double exact = least + (most - least) * step / kSteps;
    const double value = QString::number(exact, 'g', 4).toDouble();  // as a person would write it
    const auto done = set(slider, row, property, value, slider->isSliderDown() && *dragged);
    *dragged = true;
    told(done ? QString() : QString::fromStdString(done.error().message));
  });
  const PanelSection::Row shown = section.add_row(row.label, row.tip, {field, slider});
  follow([=, this] {
    const Common<double> now = common(session_.world(), list(row.of), property);
    shown.set_visible(now.shared_by_all);
    now.value || !now.shared_by_all ? field->show_value(now.value) : field->show_mixed();
    if (!now.value || slider->isSliderDown()) return;
    const QSignalBlocker quiet(slider);
    slider->setValue(int(std::lround(std::clamp((*now.value - least) / (most - least), 0.0, 1.0) * kSteps)));
  });
}

void PropertyBinder::triple(PanelSection& section, const Row& row, Quantity quantity,
                            const std::array<Property<double>, 3>& properties) {
  std::vector<QWidget*> widgets;
  std::array<QuantityField*, 3> fields{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    fields[axis] = number_field(section, row, quantity, properties[axis]);
    fields[axis]->setAccessibleName(QString("%1 %2").arg(row.label, QChar("xyz"[axis])));
    widgets.push_back(fields[axis]);
  }
  const PanelSection::Row shown = section.add_row(row.label, row.tip, widgets);
  follow([this, fields, shown, row, properties] {
    bool any = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Common<double> now = common(session_.world(), list(row.of), properties[axis]);
      now.value || !now.shared_by_all ? fields[axis]->show_value(now.value) : fields[axis]->show_mixed();
      fields[axis]->setEnabled(now.shared_by_all);
      any = any || now.shared_by_all;
    }
    shown.set_visible(any);
  });
}

void PropertyBinder::maybe_number(PanelSection& section, const Row& row, Quantity quantity,
                                  const Property<std::optional<double>>& property, const QString& none) {
  auto* field = new QuantityField(quantity, section.body());
  field->allow_none(none);
  field->on_refusal(told_to(section));
  field->on_commit([this, field, row, property](std::optional<double> value, bool more) {
    return set(field, row, property, value, more);
  });
  const PanelSection::Row shown = section.add_row(row.label, row.tip, {field});
  follow([this, field, shown, row, property] {
    const Common<std::optional<double>> now = common(session_.world(), list(row.of), property);
    shown.set_visible(now.shared_by_all);
    now.value || !now.shared_by_all ? field->show_value(now.value.value_or(std::nullopt))
                                    : field->show_mixed();
  });
}

void PropertyBinder::text(PanelSection& section, const Row& row, const Property<std::string>& property) {
  auto* field = new TextField(section.body());
  field->on_refusal(told_to(section));
  field->on_commit(
      [this, field, row, property](const std::string& text) { return set(field, row, property, text); });
  const PanelSection::Row shown = section.add_row(row.label, row.tip, {field});
  follow([this, field, shown, row, property] {
    const Common<std::string> now = common(session_.world(), list(row.of), property);
    shown.set_visible(now.shared_by_all);
    field->show_text(now.value);
  });
}

void PropertyBinder::colour(PanelSection& section, const Row& row, const Property<world::Colour>& property) {
  auto* button = new ColourButton(row.label, section.body());
  const auto told = told_to(section);
  button->on_choice([this, button, row, property, told](const world::Colour& colour) {
    const auto done = set(button, row, property, colour);
    told(done ? QString() : QString::fromStdString(done.error().message));
  });
  const PanelSection::Row shown = section.add_row(row.label, row.tip, {button});
  follow([this, button, shown, row, property] {
    const Common<world::Colour> now = common(session_.world(), list(row.of), property);
    shown.set_visible(now.shared_by_all);
    button->show_colour(now.value);
  });
}

void PropertyBinder::check(PanelSection& section, const Row& row, const Property<bool>& property) {
  auto* box = new QCheckBox(section.body());
  const auto told = told_to(section);
  QObject::connect(box, &QCheckBox::clicked, box, [this, box, row, property, told](bool on) {
    box->setTristate(false);
    const auto done = set(box, row, property, on);
    told(done ? QString() : QString::fromStdString(done.error().message));
  });
  const PanelSection::Row shown = section.add_row(row.label, row.tip, {box});
  follow([this, box, shown, row, property] {
    const Common<bool> now = common(session_.world(), list(row.of), property);
    shown.set_visible(now.shared_by_all);
    box->setTristate(!now.value);
    box->setCheckState(!now.value ? Qt::PartiallyChecked : *now.value ? Qt::Checked : Qt::Unchecked);
  });
}

void PropertyBinder::choice(PanelSection& section, const Row& row, const Property<int>& property,
                            const QStringList& items) {
  auto* box = new QuietComboBox(section.body());
  box->addItems(items);
  box->setPlaceholderText("mixed");
  const auto told = told_to(section);
  QObject::connect(box, &QComboBox::activated, box, [this, box, row, property, told](int chosen) {
    const auto done = set(box, row, property, chosen);
    told(done ? QString() : QString::fromStdString(done.error().message));
  });
  const PanelSection::Row shown = section.add_row(row.label, row.tip, {box});
  follow([this, box, shown, row, property] {
    const Common<int> now = common(session_.world(), list(row.of), property);
    shown.set_visible(now.shared_by_all);
    box->setCurrentIndex(now.value.value_or(-1));
  });
}

void PropertyBinder::text_choice(PanelSection& section, const Row& row, const Property<std::string>& property,
                                 const std::vector<std::string>& texts,
                                 QString (*words)(const std::string& text)) {
  auto* box = new QuietComboBox(section.body());
  box->setPlaceholderText("mixed");
  for (const std::string& text : texts) box->addItem(words(text), QString::fromStdString(text));
  const auto told = told_to(section);
  QObject::connect(box, &QComboBox::activated, box, [this, box, row, property, told](int chosen) {
    const auto done = set(box, row, property, box->itemData(chosen).toString().toStdString());
    told(done ? QString() : QString::fromStdString(done.error().message));
  });
  const PanelSection::Row shown = section.add_row(row.label, row.tip, {box});
  const int known = box->count();
  follow([this, box, shown, row, property, known, words] {
    const Common<std::string> now = common(session_.world(), list(row.of), property);
    shown.set_visible(now.shared_by_all);
    while (box->count() > known) box->removeItem(box->count() - 1);
    const QString text = QString::fromStdString(now.value.value_or(""));
    if (now.value && box->findData(text) < 0) box->addItem(words(*now.value), text);
    box->setCurrentIndex(now.value ? box->findData(text) : -1);
  });
}

}  // namespace icome::ui
