#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "haptics/effects/haptic_texture.h"

namespace icome::haptics {

/// A kind of haptic texture that can be written as text.
struct TextureKind {
  std::string_view name;
  std::string usage;   // what follows the colon
  std::string ranges;  // of these numbers: units, limits, usual values
  std::string_view summary;
};
const std::vector<TextureKind>& texture_kinds();

/// Depth and spacing of the waves, bumps or grains of a texture's text, m.
struct TextureSize {
  double depth = 0.0, spacing = 0.0;
};
/// Fails as make_texture() does.
base::Result<TextureSize> texture_size(std::string_view text);

/// The texture of "ridges:0.0005,0.002" (depth and spacing in m) or, in the size that a finger knows from
/// cloth and stone (1 to 3 mm), of "ridges"; see texture_kinds(). Command line and materials write it so.
/// Fails with a sentence that names what is wrong.
base::Result<std::shared_ptr<const HapticTexture>> make_texture(std::string_view text);

}  // namespace icome::haptics
