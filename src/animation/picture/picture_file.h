#pragma once
#include <filesystem>
#include <string>
#include <variant>

#include "animation/picture/svg_picture.h"

namespace icome::animation {

/// Longest side of a picture, px.
inline constexpr int kLargestPicture = 8192;
/// The most bytes of a picture's file.
inline constexpr std::uint64_t kLargestPictureFile = 256U << 20U;

/// A picture as its file has it.
using PictureContent = std::variant<Pixels, SvgPicture>;

/// The place of a picture among files: "parts/arm.png", or "parts.icome" and the name of a drawing in it.
struct PicturePlace {
  std::filesystem::path file;
  std::string drawing;  ///< empty: the only one

  bool is_design = false;
};
PicturePlace picture_place(const std::string& picture);

/// Reads a PNG with its opacity, a JPEG or an SVG file by its first bytes, or a drawing of an ICOME design as
/// SVG. `name` begins the errors: missing, damaged, of no such kind, too large; SVG that takes longer than
/// `seconds` to be read.
base::Result<PictureContent> read_picture(const PicturePlace& place, const std::string& name, double seconds);

}  // namespace icome::animation
