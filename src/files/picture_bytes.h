#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"

namespace icome::files {

/// "image/png", "image/jpeg" or "image/gif" by how the bytes of such files begin; empty for all else.
std::string_view picture_type(std::string_view bytes);

/// A picture that a design holds as numbers.
struct PixelPicture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t channels = 0;    // 1: grey, 2: and opacity, 3: red, green, blue, 4: and opacity
  std::string_view pixels = {};  // bytes, row after row from the bottom
};

/// The picture as a PNG file. Fails when it is empty, larger than kMostPixelSide or not whole.
base::Result<std::string> png_of(const PixelPicture& picture);
inline constexpr std::uint32_t kMostPixelSide = 16384;

}  // namespace icome::files
