#pragma once
#include "interaction/operations/looks/effect_making.h"
#include "ui/panels/property.h"

namespace icome::ui {

// Properties of objects that are lights.
Property<int> light_kind();  // the number of a world::Light::Kind
Property<bool> light_on();
Property<world::Colour> light_colour();
Property<double> light_intensity();
Property<double> light_ambient();
// Property of lights that are not directional.
Property<double> light_radius();
// Properties of spots only.
Property<double> light_cut_off();
Property<double> light_beam();

// Property of objects that are viewpoints.
Property<double> field_of_view();

// Properties of objects that are effects.
Property<std::string> effect_text();
Property<bool> effect_on();
/// The number of a dial, for effects of the dial's kind.
Property<double> effect_number(const interaction::EffectDial& dial);

}  // namespace icome::ui
