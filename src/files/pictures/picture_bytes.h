#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"
#include "world/shape/picture_kind.h"

namespace icome::files {

/// "image/png", "image/jpeg" or "image/gif" by the first bytes of such files; empty for all else.
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

/// The mean of a PNG's or JPEG's pixels: red, green and blue as stored in the file, 0 ... 1. None for
/// other files, and for unreadable ones, as above.
std::optional<std::array<double, 3>> picture_mean(std::string_view bytes);

/// Number of pixels that a PNG or JPEG file declares; 0 for other files.
std::uint64_t pixel_count(std::string_view bytes);

/// Degree to which one can see through a picture; one that cannot be read, or is larger than
/// kMostPixelSide, counts as opaque.
world::PictureOpacity picture_opacity(std::string_view bytes);

}  // namespace icome::files
