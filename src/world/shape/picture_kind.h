#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace icome::world {

/// How much a picture lets be seen through it.
enum class PictureOpacity : std::uint8_t {
  Opaque,
  CutOut,  // pixels are seen or not, as leaves are
  Blended  // some are seen through
};

/// Of pixels as red, green, blue, opacity. Leaves have hard edges with some pixels between; what has more
/// between is glass or smoke.
PictureOpacity opacity_of(std::span<const std::uint8_t> rgba);

/// Does a PNG or JPEG file hold greys alone, one number a pixel, as VRML 2.0's textures of one or two
/// components? By its header: a coloured picture of something grey is none.
bool is_grey_picture(std::string_view bytes);

/// May a PNG or GIF file have pixels that are not opaque? By its header.
bool may_be_clear(std::string_view bytes);

}  // namespace icome::world
