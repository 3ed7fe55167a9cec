#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "haptics/effects/effect.h"

namespace icome::haptics {

/// A kind of effect that can be written.
struct EffectKind {
  std::string_view name;
  std::string usage;   // what follows the colon
  std::string ranges;  // of these numbers: units, limits, usual values
  std::string_view summary;
  std::string_view example;  // the whole text of one
};
const std::vector<EffectKind>& effect_kinds();

/// The effect of a text such as "viscous:2" or "well:0,0,0.05,0.01,1.5"; see effect_kinds(). Places are m in
/// the frame of who asks. Fails with a sentence that names the number that is wrong.
base::Result<std::unique_ptr<Effect>> make_effect(std::string_view text);

}  // namespace icome::haptics
