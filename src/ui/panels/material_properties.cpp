#include "ui/panels/material_properties.h"

#include <algorithm>
#include <cmath>

#include "interaction/operations/looks/material_library.h"
#include "ui/panels/object_look.h"

namespace icome::ui {

using base::Result;
using world::Material;
using world::ObjectId;
using world::World;

namespace {

/// `read` gives a value of a material; `write` sets one, or returns the reason why it cannot.
template <typename Value, typename Read, typename Write>
Property<Value> material_property(const Read& read, const Write& write) {
  return {[read](const World& world, ObjectId id) -> std::optional<Value> {
            const Material* material = world.find(world.find(id)->material);
            if (!material) return std::nullopt;
            return std::optional<Value>(std::in_place, read(*material));
          },
          [write](const World& world, ObjectId id, const Value& value) -> Result<world::Edit> {
            const world::MaterialId material = world.find(id)->material;
            Material changed = *world.find(material);
            const char* complaint = write(changed, value);
            if (complaint) return base::fail(complaint);
            return world::Edit(world::ChangeMaterial{material, std::move(changed)});
          }};
}

template <typename Value>
Property<Value> plain(Value Material::*member) {
  return material_property<Value>([member](const Material& it) { return it.*member; },
                                  [member](Material& it, const Value& value) -> const char* {
                                    it.*member = value;
                                    return nullptr;
                                  });
}

Property<double> share(float Material::*member) {
  return material_property<double>([member](const Material& it) { return double(it.*member); },
                                   [member](Material& it, double value) -> const char* {
                                     if (!(value >= 0.0 && value <= 1.0))
                                       return "A share goes from 0 to 100 %.";
                                     it.*member = float(value);
                                     return nullptr;
                                   });
}

bool is_usable(double value) { return std::isfinite(value) && value >= 0.0; }

Property<MaybeNumber> touch_number(MaybeNumber world::TouchProperties::*member, double most,
                                   const char* complaint) {
  return material_property<MaybeNumber>([member](const Material& it) { return it.touch.*member; },
                                        [=](Material& it, const MaybeNumber& value) -> const char* {
                                          if (value && !(is_usable(*value) && *value <= most))
                                            return complaint;
                                          it.touch.*member = value;
                                          return nullptr;
                                        });
}

constexpr double kMostFriction = 10.0;  // beyond rubber on rubber
const char* const kFrictionRange = "Friction goes from 0 (ice) to 10; wood on wood has about 0.4.";

}  // namespace

Property<std::string> material_name() { return plain(&Material::name); }
Property<world::Colour> diffuse_colour() { return plain(&Material::diffuse); }
Property<world::Colour> specular_colour() { return plain(&Material::specular); }
Property<world::Colour> emission_colour() { return plain(&Material::emission); }
Property<double> shininess() { return share(&Material::shininess); }
Property<double> transparency() { return share(&Material::transparency); }

Property<MaybeNumber> stiffness() {
  return touch_number(&world::TouchProperties::stiffness, 1e6,
                      "Stiffness goes from 0 to 1,000,000 N/m; devices render 500 to 4,000 well.");
}
Property<MaybeNumber> damping() {
  return touch_number(&world::TouchProperties::damping, 1e4,
                      "Damping goes from 0 to 10,000 N s/m; devices render up to about 10 well.");
}

Property<double> static_friction() {
  return material_property<double>([](const Material& it) { return it.touch.static_friction; },
                                   [](Material& it, double value) -> const char* {
                                     if (!(is_usable(value) && value <= kMostFriction)) return kFrictionRange;
                                     it.touch.static_friction = value;
                                     it.touch.dynamic_friction = std::min(it.touch.dynamic_friction, value);
                                     return nullptr;
                                   });
}
Property<double> dynamic_friction() {
  return material_property<double>([](const Material& it) { return it.touch.dynamic_friction; },
                                   [](Material& it, double value) -> const char* {
                                     if (!(is_usable(value) && value <= kMostFriction)) return kFrictionRange;
                                     if (value > it.touch.static_friction)
                                       return "What slides is held less than what rests: raise the static "
                                              "friction first.";
                                     it.touch.dynamic_friction = value;
                                     return nullptr;
                                   });
}

Property<std::string> haptic_texture() {
  return material_property<std::string>([](const Material& it) { return it.touch.texture; },
                                        [](Material& it, const std::string& name) -> const char* {
                                          it.touch.texture = name;
                                          return nullptr;
                                        });
}

QString haptic_texture_words(const std::string& text) {
  if (text.empty()) return "Smooth";
  QString words = QString::fromStdString(interaction::texture_words(text));
  if (words.isEmpty()) return one_line(text) + " (not known)";
  words[0] = words[0].toUpper();
  return words;
}

}  // namespace icome::ui
