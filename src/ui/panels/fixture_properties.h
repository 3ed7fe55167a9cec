#pragma once
#include "interaction/operations/looks/effect_making.h"
#include "ui/panels/property.h"

namespace icome::ui {

// Of objects that are lights.
Property<int> light_kind();  // the number of a world::Light::Kind
Property<bool> light_on();
Property<world::Colour> light_colour();
Property<double> light_intensity();
Property<double> light_ambient();
// Of lights with an end only.
Property<double> light_radius();
// Of spots only.
Property<double> light_cut_off();
Property<double> light_beam();

// Of objects that are viewpoints.
Property<double> field_of_view();

// Of objects that are effects.
Property<std::string> effect_text();
Property<bool> effect_on();
/// A number of those that are of the dial's kind.
Property<double> effect_number(const interaction::EffectDial& dial);

}  // namespace icome::ui
