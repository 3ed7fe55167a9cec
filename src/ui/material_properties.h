#pragma once
#include "ui/property.h"

namespace icome::ui {

// Of an object's material; objects without one have none of these. Setting changes the material for all
// that share it.

/// A nullopt within is "the device's best".
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

/// The names that haptic_texture() takes, beside the empty one for smooth.
const std::vector<std::string>& haptic_texture_names();

}  // namespace icome::ui
