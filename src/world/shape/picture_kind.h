#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace icome::world {

/// Degree to which one can see through a picture.
enum class PictureOpacity : std::uint8_t {
  Opaque,
  CutOut,  // pixels are opaque or clear, as of leaves
  Blended  // some pixels are translucent
};

/// The opacity of pixels given as red, green, blue, opacity. Leaves have hard edges with some translucent
/// pixels; pictures with more of them are glass or smoke.
PictureOpacity opacity_of(std::span<const std::uint8_t> rgba);

/// Does a PNG or JPEG file hold greys alone, one number a pixel, as VRML 2.0's textures of one or two
/// components? Judged by its header: a coloured picture of something grey counts as coloured.
bool is_grey_picture(std::string_view bytes);

/// May a PNG or GIF file have pixels that are not opaque? Judged by its header.
bool may_be_clear(std::string_view bytes);

}  // namespace icome::world
