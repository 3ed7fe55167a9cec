#include "world/shape/picture_kind.h"

namespace icome::world {
namespace {

constexpr std::string_view kPng = "\x89PNG\r\n\x1a\n";
constexpr std::size_t kPngColourType = 25;  // its offset in the file
constexpr unsigned char kPngColour = 2, kPngPalette = 3, kPngAlpha = 4;

unsigned char byte_at(std::string_view bytes, std::size_t place) {
  return place < bytes.size() ? static_cast<unsigned char>(bytes[place]) : 0;
}

/// The number of components in a JPEG file's frame header; 0: there is none.
int jpeg_components(std::string_view bytes) {
  constexpr std::size_t kComponents = 9;  // in the frame header
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && byte_at(bytes, at) == 0xff) {
    const unsigned char marker = byte_at(bytes, at + 1);
    if (marker == 0xff) {  // padding
      ++at;
      continue;
    }
    const bool is_frame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (is_frame) return byte_at(bytes, at + kComponents);
    at += 2 + 256 * std::size_t{byte_at(bytes, at + 2)} + byte_at(bytes, at + 3);
  }
  return 0;
}

}  // namespace

PictureOpacity opacity_of(std::span<const std::uint8_t> rgba) {
  constexpr int kNearlyOpaque = 250, kNearlyClear = 5;
  std::size_t clear = 0, between = 0;
  for (std::size_t i = 3; i < rgba.size(); i += 4) {
    const int alpha = rgba[i];
    if (alpha < kNearlyOpaque) ++(alpha > kNearlyClear ? between : clear);
  }
  if (clear + between == 0) return PictureOpacity::Opaque;
  return 4 * between > rgba.size() / 4 ? PictureOpacity::Blended : PictureOpacity::CutOut;
}

bool is_grey_picture(std::string_view bytes) {
  if (bytes.starts_with(kPng)) return (byte_at(bytes, kPngColourType) & kPngColour) == 0;
  return bytes.starts_with("\xff\xd8\xff") && jpeg_components(bytes) == 1;
}

bool may_be_clear(std::string_view bytes) {
  if (bytes.starts_with(kPng)) {
    const unsigned char type = byte_at(bytes, kPngColourType);
    return (type & kPngAlpha) != 0 || type == kPngPalette || bytes.find("tRNS") != std::string_view::npos;
  }
  return bytes.starts_with("GIF8");
}

}  // namespace icome::world
