#include "ui/panels/property_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QTimer>
#include <QVBoxLayout>

#include "interaction/operations/looks/effect_making.h"
#include "interaction/operations/looks/material_library.h"
#include "ui/forms/quiet_combo_box.h"
#include "ui/forms/text_field.h"
#include "ui/look/theme.h"
#include "ui/panels/column_area.h"
#include "ui/panels/fixture_properties.h"
#include "ui/panels/material_properties.h"
#include "ui/panels/object_look.h"
#include "ui/panels/object_properties.h"
#include "ui/panels/property_binder.h"
#include "ui/panels/shape_properties.h"
#include "ui/panels/sharing_edits.h"
#include "world/sharing.h"

namespace icome::ui {

using Of = PropertyBinder::Of;
using world::ObjectId;

namespace {

constexpr int kSoftnessEvery = 250;  // ms

/// The quantity of an effect's number that has this unit.
Quantity quantity_in(const std::string& unit) {
  if (unit == "m") return Quantity::Length;
  if (unit == "N") return Quantity::Force;
  if (unit == "N/m") return Quantity::Stiffness;
  if (unit == "N s/m") return Quantity::Damping;
  return Quantity::Plain;
}

/// Lets a label show plain text on several lines. A name without a space in it does not widen the panel.
void wrap(QLabel& label) {
  label.setTextFormat(Qt::PlainText);
  label.setWordWrap(true);
  QSizePolicy policy = label.sizePolicy();
  policy.setHorizontalPolicy(QSizePolicy::Ignored);
  label.setSizePolicy(policy);
}

/// Adds a label for a remark, where there is nothing to change.
QLabel* remark(PanelSection& section) {
  auto* label = new QLabel(section.body());
  wrap(*label);
  section.add_wide(label);
  return label;
}

void say(QLabel& label, const QString& text) {
  label.setText(text);
  label.setVisible(!text.isEmpty());
}

/// Text on the sharing of a shape or material, or on several selected ones; empty where none is shared.
template <typename AnyId>
QString shared_words(const world::World& world, const std::vector<ObjectId>& representatives,
                     AnyId world::PhysicalObject::*member, const char* several) {
  if (representatives.size() > 1) return QString(several).arg(representatives.size());
  if (representatives.empty()) return {};
  const AnyId shared = world.find(representatives.front())->*member;
  return world.find(shared)->users > 1 ? QString::fromStdString(world::sharing(world, shared)) : QString();
}

}  // namespace

struct PropertyPanel::Parts {
  Parts(session::Session& session, PropertyPanel& of);

  void build_object();
  void build_shape();
  void build_material();
  void build_material_choice(PanelSection& section);
  void build_touch();
  void build_light();
  void build_viewpoint();
  void build_effect();
  QString effect_trouble() const;
  PanelSection& add_section(const char* title, const std::vector<ObjectId> Subjects::*list);
  QPushButton* add_button(PanelSection& section, const char* text, const char* tip,
                          const std::function<base::Result<void>()>& act);
  void list_materials();
  void refresh_soon();
  void refresh();

  PropertyPanel& panel;
  PropertyBinder binder;
  PlaceProperties place{};
  QWidget* sheet;
  QVBoxLayout* column;
  QLabel* title;
  QLabel* hint;
  QComboBox* materials = nullptr;
  bool materials_are_new = true;
  QTimer* soon;
  std::shared_ptr<bool> alive = std::make_shared<bool>(true);  // listeners may outlive us
};

PropertyPanel::Parts::Parts(session::Session& session, PropertyPanel& of)
    : panel(of),
      binder(session),
      sheet(new QWidget(&of)),
      column(new QVBoxLayout(sheet)),
      title(new QLabel(sheet)),
      hint(new QLabel(sheet)),
      soon(new QTimer(&of)) {
  column->setContentsMargins(0, 2 * kGrid, 0, 2 * kGrid);
  column->setSpacing(0);
  QFont large = title->font();
  large.setPointSizeF(large.pointSizeF() * 1.15);
  large.setWeight(QFont::DemiBold);
  title->setFont(large);
  wrap(*title);
  title->setContentsMargins(4 * kGrid, kGrid, 3 * kGrid, kGrid);
  hint->setText("Select an object, in the scene or in the tree, to see and change what it is made of.");
  hint->setWordWrap(true);
  hint->setForegroundRole(QPalette::PlaceholderText);
  hint->setContentsMargins(4 * kGrid, 2 * kGrid, 4 * kGrid, 0);
  column->addWidget(title);
  column->addWidget(hint);
  build_object();
  build_shape();
  build_material();
  build_touch();
  build_light();
  build_viewpoint();
  build_effect();
  column->addStretch(1);
  soon->setSingleShot(true);
  QObject::connect(soon, &QTimer::timeout, &of, [this] { refresh(); });
  const std::weak_ptr<bool> guard = alive;
  session.on_change([this, guard](const world::Changes* changes) {
    if (guard.expired()) return;
    materials_are_new = materials_are_new || !changes || !changes->materials.empty();
    refresh_soon();
  });
  session.on_selection([this, guard] {
    if (guard.expired()) return;
    place.forget();
    refresh_soon();
  });
  refresh();
}

PanelSection& PropertyPanel::Parts::add_section(const char* text,
                                                const std::vector<ObjectId> Subjects::*list) {
  auto* section = new PanelSection(text, sheet);
  column->addWidget(section);
  binder.follow([this, section, list] { section->setVisible(!(binder.subjects().*list).empty()); });
  return *section;
}

QPushButton* PropertyPanel::Parts::add_button(PanelSection& section, const char* text, const char* tip,
                                              const std::function<base::Result<void>()>& act) {
  auto* button = new QPushButton(text, section.body());
  button->setToolTip(tip);
  section.add_wide(button);
  QObject::connect(button, &QPushButton::clicked, button, [act, &section] {
    const auto done = act();
    section.note().say(done ? QString() : QString::fromStdString(done.error().message));
  });
  return button;
}

void PropertyPanel::Parts::build_object() {
  PanelSection& section = add_section("Object", &Subjects::objects);
  binder.text(section, {"Name", "What the object is called", "Rename"}, name_property());
  binder.triple(section,
                {"Position, mm",
                 "Where it is, with respect to what it is under: x, y, z. You can also type 3 cm or "
                 "0.2 m.",
                 "Move"},
                Quantity::Length, {place.position(0), place.position(1), place.position(2)});
  binder.triple(section, {"Rotation, °", "Turned about x, then y, then z of what it is under", "Turn"},
                Quantity::Angle, {place.turn(0), place.turn(1), place.turn(2)});
  binder.triple(
      section,
      {"Size, mm", "Along its own x, y, z, with all that is below it; a change stretches it", "Resize"},
      Quantity::Length, {place.size(0), place.size(1), place.size(2)});
}

void PropertyPanel::Parts::build_shape() {
  PanelSection& section = add_section("Shape", &Subjects::shapes);
  QLabel* kind = remark(section);
  for (const ShapeSize& size : shape_sizes()) {
    const QString label = size.label;
    binder.number(section,
                  {label + ", mm", "A size of the shape, for all objects that share it",
                   "Change " + label.toLower() + " of", Of::Shapes},
                  Quantity::Length, size.property);
  }
  binder.text(section,
              {"Formula", "The solid is where this is negative; x, y, z in m, t in s", "Change formula of",
               Of::Shapes},
              formula_property());
  QLabel* users = remark(section);
  users->setForegroundRole(QPalette::PlaceholderText);
  QPushButton* own = add_button(section, "Make own copy",
                                "Gives the selected objects a shape of their own: others "
                                "that share it now do not change with it any more",
                                [this] { return make_own_shapes(binder.session()); });
  binder.follow([this, kind, users, own] {
    const world::World& world = binder.session().world();
    const std::vector<ObjectId>& shapes = binder.subjects().shapes;
    if (shapes.empty()) return;
    const world::Geometry& first = *world.find(world.find(shapes.front())->geometry)->shape;
    const QString figures = figures_of(first);
    say(*kind, shapes.size() > 1   ? QString("%1 shapes").arg(shapes.size())
               : figures.isEmpty() ? kind_of(first)
                                   : QString("%1: %2").arg(kind_of(first), figures));
    say(*users, shared_words(world, shapes, &world::PhysicalObject::geometry, "%1 shapes are selected"));
    own->setVisible(shares_shapes(binder.session()));
  });
}

void PropertyPanel::Parts::build_material() {
  PanelSection& section = add_section("Material", &Subjects::dressed);
  build_material_choice(section);
  binder.text(section, {"Name", "What the material is called", "Rename material", Of::Materials},
              material_name());
  binder.colour(section, {"Colour", "What it looks like in white light", "Change colour of", Of::Materials},
                diffuse_colour());
  binder.colour(section, {"Highlight", "Of the shine on it", "Change highlight of", Of::Materials},
                specular_colour());
  binder.colour(section, {"Glow", "What it looks like without light", "Change glow of", Of::Materials},
                emission_colour());
  binder.number(
      section, {"Shininess, %", "How small and sharp the highlight is", "Change shininess of", Of::Materials},
      Quantity::Share, shininess());
  binder.number(section,
                {"Transparency, %", "At 100 % it is not seen", "Change transparency of", Of::Materials},
                Quantity::Share, transparency());
  QLabel* picture = remark(section);
  QLabel* users = remark(section);
  users->setForegroundRole(QPalette::PlaceholderText);
  QPushButton* own =
      add_button(section, "Make own material", "Gives the selected objects a material of their own",
                 [this] { return make_own_materials(binder.session()); });
  binder.follow([this, picture, users, own] {
    const world::World& world = binder.session().world();
    const std::vector<ObjectId>& objects = binder.subjects().materials;
    const bool one = objects.size() == 1;
    const world::Material* material = one ? world.find(world.find(objects.front())->material) : nullptr;
    const world::Texture* texture = material ? world.find(material->texture) : nullptr;
    say(*picture, texture ? QString("Picture: %1").arg(one_line(texture->name)) : QString());
    say(*users, shared_words(world, objects, &world::PhysicalObject::material, "%1 materials are selected"));
    own->setVisible(needs_own_materials(binder.session()));
  });
}

void PropertyPanel::Parts::build_material_choice(PanelSection& section) {
  materials = new QuietComboBox(section.body());
  materials->setPlaceholderText("mixed");
  section.add_row("Made of", "The material of the object; several may share one", {materials});
  QObject::connect(materials, &QComboBox::activated, materials, [this, &section](int row) {
    const world::MaterialId id{materials->itemData(row).toULongLong()};
    const auto done = choose_material(binder.session(), id);
    section.note().say(done ? QString() : QString::fromStdString(done.error().message));
  });
  binder.follow([this] {
    if (materials_are_new) list_materials();
    const std::vector<ObjectId>& made = binder.subjects().materials;
    const bool all = binder.subjects().all_have_materials;
    const world::World& world = binder.session().world();
    const bool mixed = made.size() > 1 || (made.size() == 1 && !all);
    const world::MaterialId id = made.empty() ? world::MaterialId{} : world.find(made.front())->material;
    materials->setCurrentIndex(mixed ? -1 : materials->findData(qulonglong(id.value)));
  });
}

void PropertyPanel::Parts::list_materials() {
  materials_are_new = false;
  const world::World& world = binder.session().world();
  std::vector<std::pair<QString, world::MaterialId>> all;
  for (const auto& [id, it] : world.materials()) all.emplace_back(shown_name(world, id), id);
  std::sort(all.begin(), all.end());
  materials->clear();
  materials->addItem("Default", qulonglong(0));
  for (const auto& [name, id] : all) materials->addItem(name, qulonglong(id.value));
}

void PropertyPanel::Parts::build_touch() {
  PanelSection& section = add_section("Touch", &Subjects::materials);
  binder.maybe_number(section,
                      {"Stiffness, N/m",
                       "How hard the surface pushes back; empty: as hard as the device "
                       "renders well",
                       "Change stiffness of", Of::Materials},
                      Quantity::Stiffness, stiffness(), "device's best");
  binder.maybe_number(section,
                      {"Damping, N s/m",
                       "How much it slows the hand that goes into it; empty: as the device "
                       "likes it",
                       "Change damping of", Of::Materials},
                      Quantity::Damping, damping(), "device's best");
  binder.number(section,
                {"Static friction",
                 "What holds a resting hand: a share of how hard it presses. It is never "
                 "less than the dynamic one.",
                 "Change static friction of", Of::Materials},
                Quantity::Plain, static_friction());
  binder.number(section,
                {"Dynamic friction", "What slows a sliding hand: a share of how hard it presses",
                 "Change dynamic friction of", Of::Materials},
                Quantity::Plain, dynamic_friction());
  std::vector<std::string> texts{""};
  const std::vector<std::string>& names = interaction::haptic_texture_names();
  texts.insert(texts.end(), names.begin(), names.end());
  binder.text_choice(
      section,
      {"Texture", "Fine relief that the hand feels when it slides", "Change texture of", Of::Materials},
      haptic_texture(), texts, haptic_texture_words);
}

void PropertyPanel::Parts::build_light() {
  PanelSection& section = add_section("Light", &Subjects::lights);
  binder.choice(section,
                {"Kind", "Directional: from far away, like the sun. Point: to all sides. Spot: in a cone.",
                 "Change kind of", Of::Lights},
                light_kind(), {"Directional", "Point", "Spot"});
  binder.check(section, {"On", "Off, it gives no light", "Switch", Of::Lights}, light_on());
  binder.colour(section, {"Colour", "Of its light", "Change colour of", Of::Lights}, light_colour());
  binder.number(section, {"Intensity, %", "How bright it is", "Change intensity of", Of::Lights},
                Quantity::Share, light_intensity());
  binder.number(
      section,
      {"Ambient, %", "Light that it gives to all sides of everything", "Change ambient light of", Of::Lights},
      Quantity::Share, light_ambient());
  binder.number(section, {"Reach, mm", "How far its light goes", "Change reach of", Of::Lights},
                Quantity::Length, light_radius());
  binder.number(section, {"Cone, °", "From the middle to where the light ends", "Change cone of", Of::Lights},
                Quantity::Angle, light_cut_off());
  binder.number(
      section, {"Beam, °", "From the middle to where the light begins to fade", "Change beam of", Of::Lights},
      Quantity::Angle, light_beam());
}

void PropertyPanel::Parts::build_viewpoint() {
  PanelSection& section = add_section("Viewpoint", &Subjects::viewpoints);
  binder.number(section,
                {"View, °", "How much is seen: the angle across the shorter side of the picture",
                 "Change view of", Of::Viewpoints},
                Quantity::Angle, field_of_view());
}

void PropertyPanel::Parts::build_effect() {
  PanelSection& section = add_section("Effect", &Subjects::effects);
  binder.text(
      section,
      {"Force", "What it does, such as well:0,0,0,0.01,1.5: lengths in m, forces in N, from where it stands",
       "Change force of", Of::Effects},
      effect_text());
  binder.check(section, {"On", "Off, it is not felt", "Switch", Of::Effects}, effect_on());
  for (const interaction::EffectDial& dial : interaction::effect_dials()) {
    const QString name = QString::fromStdString(dial.name);
    const Quantity quantity = quantity_in(dial.unit);
    const QString unit = quantity == Quantity::Plain ? QString::fromStdString(dial.unit) : unit_of(quantity);
    const QString label = name.left(1) + name.mid(1).toLower();
    binder.slider(section,
                  {unit.isEmpty() ? label : label + ", " + unit,
                   QString("%1 of its text; felt while it is dragged").arg(name),
                   QString("Change %1 of").arg(name.toLower()), Of::Effects},
                  quantity, effect_number(dial), dial.usual_least, dial.usual_most);
  }
  QLabel* trouble = remark(section);
  binder.follow([this, trouble] { say(*trouble, effect_trouble()); });
  // The servo reports on an effect some time after the effect was changed.
  auto* later = new QTimer(trouble);
  QObject::connect(later, &QTimer::timeout, trouble, [this, trouble] {
    if (trouble->parentWidget()->isVisible()) say(*trouble, effect_trouble());
  });
  later->start(kSoftnessEvery);
}

/// Why the first of the selected effects is not felt as its text says; empty where it is.
QString PropertyPanel::Parts::effect_trouble() const {
  const std::vector<ObjectId>& effects = binder.subjects().effects;
  const world::PhysicalObject* object =
      effects.empty() ? nullptr : binder.session().world().find(effects.front());
  const auto* effect =
      object && object->fixture ? std::get_if<world::ForceEffect>(object->fixture.get()) : nullptr;
  if (!effect) return {};
  const std::string wrong = interaction::trouble_with_effect(effect->text);
  if (!wrong.empty()) return "It is not felt: " + one_line(wrong);
  for (const haptics::CappedEffect& capped : binder.session().hands().capped_effects())
    if (capped.id == effects.front().value)
      return "Beside all else that acts, its " + one_line(capped.what) +
             ", the most that is stable on this device.";
  return {};
}

void PropertyPanel::Parts::refresh_soon() {
  if (panel.isVisible() && !soon->isActive()) soon->start(0);
}

void PropertyPanel::Parts::refresh() {
  binder.refresh();
  const std::vector<ObjectId>& objects = binder.subjects().objects;
  const world::World& world = binder.session().world();
  hint->setVisible(objects.empty());
  title->setVisible(!objects.empty());
  if (objects.size() == 1) {
    const QString kind = kind_of(world, *world.find(objects.front()));
    const QString name = shown_name(world, objects.front());
    title->setText(name.startsWith(kind) ? name : QString("%1 – %2").arg(name, kind));
  } else {
    title->setText(QString("%1 objects").arg(objects.size()));
  }
}

PropertyPanel::PropertyPanel(session::Session& session, QWidget* parent)
    : QWidget(parent), parts_(std::make_unique<Parts>(session, *this)) {
  setAccessibleName("Properties of what is selected");
  auto* scroll = new ColumnArea(this);
  scroll->setWidget(parts_->sheet);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->addWidget(scroll);
}

PropertyPanel::~PropertyPanel() = default;

bool PropertyPanel::finish_typing() {
  // The window remembers its focus widget, also while another window is active.
  QWidget* const focus = window()->focusWidget();
  if (!focus || !isAncestorOf(focus)) return true;
  if (auto* number = dynamic_cast<QuantityField*>(focus)) return number->finish();
  if (auto* text = dynamic_cast<TextField*>(focus)) return text->finish();
  return true;
}

void PropertyPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  parts_->refresh();
}

}  // namespace icome::ui
