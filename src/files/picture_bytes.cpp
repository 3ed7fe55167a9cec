#include "files/picture_bytes.h"

#include <fmt/format.h>
#include <png.h>

#include <memory>
#include <vector>

namespace icome::files {
namespace {

/// Does a graphics control extension (GIF89a, 23) say so?
bool gif_has_clear_colour(std::string_view bytes) {
  constexpr std::string_view kControl("\x21\xf9\x04", 3);
  const std::size_t at = bytes.find(kControl);
  return at != std::string_view::npos && at + kControl.size() < bytes.size() &&
         (static_cast<unsigned char>(bytes[at + kControl.size()]) & 1U) != 0;
}

}  // namespace

std::string_view picture_type(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return "image/png";
  if (bytes.starts_with("\xff\xd8\xff")) return "image/jpeg";
  if (bytes.starts_with("GIF87a") || bytes.starts_with("GIF89a")) return "image/gif";
  return {};
}

base::Result<std::string> png_of(const PixelPicture& picture) {
  const auto [width, height, channels, pixels] = picture;
  if (width == 0 || height == 0) return base::fail("it has no pixels");
  if (width > kMostPixelSide || height > kMostPixelSide)
    return base::fail(fmt::format("it is {} x {} pixels large; {} x {} are the most that can be read", width,
                                  height, kMostPixelSide, kMostPixelSide));
  constexpr png_uint_32 kFormats[] = {PNG_FORMAT_GRAY, PNG_FORMAT_GA, PNG_FORMAT_RGB, PNG_FORMAT_RGBA};
  if (channels < 1 || channels > 4)
    return base::fail(fmt::format("it has {} channels, not 1 to 4", channels));
  if (pixels.size() != std::size_t{width} * height * channels) return base::fail("pixels of it are missing");

  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = kFormats[channels - 1];
  const auto row = static_cast<png_int_32>(width * channels);
  // A negative row stride: the first row in memory is the lowest.
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), -row, nullptr) == 0)
    return base::fail(std::string("it cannot be made a PNG: ") + image.message);
  bytes.resize(size);
  bytes.shrink_to_fit();
  return bytes;
}

world::PictureOpacity picture_opacity(std::string_view bytes) {
  using world::PictureOpacity;
  if (!world::may_be_clear(bytes)) return PictureOpacity::Opaque;
  // The pixels of a GIF are seen or not.
  if (picture_type(bytes) == "image/gif")
    return gif_has_clear_colour(bytes) ? PictureOpacity::CutOut : PictureOpacity::Opaque;
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, decltype(&png_image_free)> owned(&image, png_image_free);
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0)
    return PictureOpacity::Opaque;
  constexpr std::uint64_t kMostPixels = 64'000'000;
  if (image.width > kMostPixelSide || image.height > kMostPixelSide ||
      std::uint64_t{image.width} * image.height > kMostPixels)
    return PictureOpacity::Opaque;
  image.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) == 0) return PictureOpacity::Opaque;
  return world::opacity_of(pixels);
}

}  // namespace icome::files
