#pragma once
#include <QString>
#include <optional>
#include <string>

#include "ui/panels/property.h"

namespace icome::ui {

// Properties of an object's material; objects without a material have none of them. Setting one changes the
// material for all objects that share it.

/// A number of a material; a nullopt within is "the device's best".
using MaybeNumber = std::optional<double>;

Property<std::string> material_name();
Property<world::Colour> diffuse_colour();
Property<world::Colour> specular_colour();
Property<world::Colour> emission_colour();
Property<double> shininess();
Property<double> transparency();

Property<MaybeNumber> stiffness();
Property<MaybeNumber> damping();
Property<double> static_friction();
Property<double> dynamic_friction();
Property<std::string> haptic_texture();
/// Words for a text of haptic_texture(), for people: "Bumps, 0.3 mm deep every 3 mm".
QString haptic_texture_words(const std::string& text);

}  // namespace icome::ui
