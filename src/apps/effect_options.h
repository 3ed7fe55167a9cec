#pragma once
#include <memory>
#include <string>
#include <vector>

#include "apps/touch_models.h"
#include "apps/touch_options.h"
#include "base/result.h"
#include "devices/pointer_device.h"
#include "haptics/effects/effect.h"
#include "haptics/haptic_texture.h"

namespace icome::apps {

/// Says which --texture or --effect is wrong, and where in it.
base::Result<void> check_effects(const TouchOptions& options);

/// What the options ask for, which check_effects() accepted.
haptics::EffectSet effects_of(const TouchOptions& options);
std::shared_ptr<const haptics::HapticTexture> texture_of(const TouchOptions& options);

/// Surfaces and effects that are felt softer than they were asked for, as `device` could not render them
/// stably at the rate: a sentence for each.
std::vector<std::string> capped_feel(const std::vector<TouchModel>& models, const TouchOptions& options,
                                     const devices::DeviceInfo& device);

/// Every texture and effect with its numbers, for the help of `icome touch`.
std::string effects_help();

}  // namespace icome::apps
