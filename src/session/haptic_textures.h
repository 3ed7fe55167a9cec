#pragma once
#include <memory>
#include <string_view>

#include "haptics/haptic_texture.h"

namespace icome::session {

/// The haptic texture that a material names: "grooves", "bumps" or "grain", of the size that a finger knows
/// from cloth and stone (1 to 3 mm). Null for other names.
std::shared_ptr<const haptics::HapticTexture> standard_texture(std::string_view name);

}  // namespace icome::session
