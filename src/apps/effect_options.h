#pragma once
#include <memory>
#include <string>

#include "apps/touch_options.h"
#include "base/result.h"
#include "haptics/effects/effect.h"
#include "haptics/haptic_texture.h"

namespace icome::apps {

/// Says which --texture or --effect is wrong, and where in it.
base::Result<void> check_effects(const TouchOptions& options);

/// What the options ask for, which check_effects() accepted.
haptics::EffectSet effects_of(const TouchOptions& options);
std::shared_ptr<const haptics::HapticTexture> texture_of(const TouchOptions& options);

/// Every texture and effect with its numbers, for the help of `icome touch`.
std::string effects_help();

}  // namespace icome::apps
