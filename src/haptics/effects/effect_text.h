#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "haptics/effects/effect.h"

namespace icome::haptics {

/// A kind of effect that can be written as text.
struct EffectKind {
  std::string_view name;
  std::string usage;   // what follows the colon
  std::string ranges;  // of these numbers: units, limits, usual values
  std::string_view summary;
  std::string_view example;  // the whole text of one
};
const std::vector<EffectKind>& effect_kinds();

/// A number of an effect's text.
struct EffectNumber {
  std::string_view name;  // in capitals, as the usage has it: "RADIUS"
  std::string_view unit;  // "m"; empty: none
  double least = 0.0;     // limits of the value, both ends included
  double most = 0.0;
  double value = 0.0;
};
/// The numbers of an effect's text, with usual values for those that it leaves out; none where the text
/// makes no effect, or its kind has no fixed count of numbers (curve, field).
std::vector<EffectNumber> effect_numbers(std::string_view text);

/// The text of an effect of this kind with these numbers: "viscous:2".
std::string effect_of_numbers(std::string_view kind, const std::vector<double>& numbers);

/// The points of a curve's text, m; none if the text is no curve.
std::vector<Vector3> curve_points(std::string_view text);

/// The effect of a text such as "viscous:2" or "well:0,0,0.05,0.01,1.5"; see effect_kinds(). Places are m in
/// the caller's frame. Fails with a sentence that names the number that is wrong.
base::Result<std::unique_ptr<Effect>> make_effect(std::string_view text);

}  // namespace icome::haptics
