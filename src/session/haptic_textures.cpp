#include "session/haptic_textures.h"

namespace icome::session {

std::shared_ptr<const haptics::HapticTexture> standard_texture(std::string_view name) {
  if (name == "grooves")
    return std::make_shared<haptics::GrooveTexture>(base::Vector3::UnitX(), 2e-3, 0.2e-3);
  if (name == "bumps") return std::make_shared<haptics::BumpTexture>(3e-3, 0.3e-3);
  if (name == "grain") return std::make_shared<haptics::GrainTexture>(1e-3, 0.1e-3, 1);
  return nullptr;
}

}  // namespace icome::session
