#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "world/shape/fixture.h"

namespace icome::interaction {

/// The reason why an effect with this text (such as one of a newer program) is not felt; empty: it is felt.
std::string trouble_with_effect(const std::string& text);

/// The effect of a text, as haptics::make_effect takes it; else an error that says what is wrong with it.
base::Result<world::FixturePointer> make_effect_fixture(const std::string& text, bool on);

/// A number of the effects of a kind, set with a dial.
struct EffectDial {
  std::string kind;  // "well"
  std::string name;  // "RADIUS"
  std::string unit;  // "m"; empty: none
  std::size_t index = 0;
  double least = 0.0, most = 0.0;              // the allowed range
  double usual_least = 0.0, usual_most = 0.0;  // the usual range
};
/// The dials of all kinds of effects that take numbers alone.
const std::vector<EffectDial>& effect_dials();

/// The dial's value in an effect with this text; nothing where the effect is of another kind, or none.
std::optional<double> dial_value(const EffectDial& dial, const std::string& text);
/// The text with that number set; precondition: dial_value() has one.
std::string with_dial(const EffectDial& dial, const std::string& text, double value);

}  // namespace icome::interaction
