#pragma once
#include <memory>
#include <string>
#include <vector>

#include "apps/touch/touch_models.h"
#include "apps/touch/touch_options.h"
#include "base/result.h"
#include "haptics/effects/haptic_texture.h"
#include "haptics/servo/servo.h"

namespace icome::apps {

/// Fails, saying which --texture or --effect is wrong, and where in it.
base::Result<void> check_effects(const TouchOptions& options);

/// The effects that the options ask for, which check_effects() accepted, and those of designs.
std::vector<haptics::PlacedEffect> effects_of(const std::vector<TouchModel>& models,
                                              const TouchOptions& options);
/// The texture that the options ask for, which check_effects() accepted; null: none.
std::shared_ptr<const haptics::HapticTexture> texture_of(const TouchOptions& options);

/// Surfaces and effects that the servo feels softer than they were asked for, as its device could not render
/// them stably at the rate: a sentence for each.
std::vector<std::string> capped_feel(const std::vector<TouchModel>& models, const TouchOptions& options,
                                     const haptics::Servo& servo);

/// Every texture and effect with its numbers, for the help of `icome touch`.
std::string effects_help();

}  // namespace icome::apps
