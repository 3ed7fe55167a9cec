#include "files/pictures/picture_bytes.h"

#include <fmt/format.h>
#include <png.h>
#include <turbojpeg.h>

#include <memory>
#include <vector>

#include "io/byte_order.h"

namespace icome::files {
namespace {

/// Does a graphics control extension (GIF89a, 23) declare a clear colour?
bool gif_has_clear_colour(std::string_view bytes) {
  constexpr std::string_view kControl("\x21\xf9\x04", 3);
  const std::size_t at = bytes.find(kControl);
  return at != std::string_view::npos && at + kControl.size() < bytes.size() &&
         (static_cast<unsigned char>(bytes[at + kControl.size()]) & 1U) != 0;
}

/// Red, green, blue, opacity of a PNG file's pixels; empty if it is no PNG file, damaged or too large.
std::vector<std::uint8_t> png_pixels(std::string_view bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, decltype(&png_image_free)> owned(&image, png_image_free);
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) return {};
  constexpr std::uint64_t kMostPixels = 64'000'000;
  if (image.width > kMostPixelSide || image.height > kMostPixelSide ||
      std::uint64_t{image.width} * image.height > kMostPixels)
    return {};
  // Without this flag the library takes numbers of 16 bits for linear ones, and makes them brighter, unless a
  // gAMA part says otherwise. With it only such a part changes them, as it does those of 8 bits.
  image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  image.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) == 0) return {};
  return pixels;
}

using Jpeg = std::unique_ptr<void, decltype(&tjDestroy)>;

const unsigned char* jpeg_data(std::string_view bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

/// Width and height declared by a JPEG file; none if it is no such file.
std::optional<std::array<int, 2>> jpeg_size(const Jpeg& jpeg, std::string_view bytes) {
  int width = 0, height = 0, subsampling = 0, colours = 0;
  if (!jpeg || tjDecompressHeader3(jpeg.get(), jpeg_data(bytes), bytes.size(), &width, &height, &subsampling,
                                   &colours) != 0)
    return {};
  if (width < 1 || height < 1) return {};
  return {{width, height}};
}

/// The pixels of a JPEG file as means of squares of eight pixels, which are quick to compute.
std::vector<std::uint8_t> jpeg_squares(std::string_view bytes) {
  const Jpeg jpeg(tjInitDecompress(), tjDestroy);
  const auto size = jpeg_size(jpeg, bytes);
  if (!size) return {};
  const auto [width, height] = *size;
  constexpr int kMostSide = int(kMostPixelSide);
  if (width > kMostSide || height > kMostSide) return {};
  constexpr tjscalingfactor kEighth = {1, 8};
  const int columns = TJSCALED(width, kEighth), rows = TJSCALED(height, kEighth);
  std::vector<std::uint8_t> pixels(4 * std::size_t(columns) * std::size_t(rows));
  const int done = tjDecompress2(jpeg.get(), jpeg_data(bytes), bytes.size(), pixels.data(), columns, 0, rows,
                                 TJPF_RGBA, TJFLAG_LIMITSCANS);
  if (done != 0) return {};
  return pixels;
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

std::uint64_t pixel_count(std::string_view bytes) {
  const std::string_view type = picture_type(bytes);
  constexpr std::size_t kPngSizes = 16;  // offset of the sizes in its first part
  if (type == "image/png" && bytes.size() >= kPngSizes + 8) {
    const char* const sizes = bytes.data() + kPngSizes;
    return std::uint64_t{io::load<std::uint32_t>(sizes, io::ByteOrder::BigEndian)} *
           io::load<std::uint32_t>(sizes + 4, io::ByteOrder::BigEndian);
  }
  if (type != "image/jpeg") return 0;
  const auto size = jpeg_size(Jpeg(tjInitDecompress(), tjDestroy), bytes);
  return size ? std::uint64_t((*size)[0]) * std::uint64_t((*size)[1]) : 0;
}

world::PictureOpacity picture_opacity(std::string_view bytes) {
  using world::PictureOpacity;
  if (!world::may_be_clear(bytes)) return PictureOpacity::Opaque;
  // The pixels of a GIF are opaque or clear.
  if (picture_type(bytes) == "image/gif")
    return gif_has_clear_colour(bytes) ? PictureOpacity::CutOut : PictureOpacity::Opaque;
  const std::vector<std::uint8_t> pixels = png_pixels(bytes);
  return pixels.empty() ? PictureOpacity::Opaque : world::opacity_of(pixels);
}

std::optional<std::array<double, 3>> picture_mean(std::string_view bytes) {
  const bool jpeg = picture_type(bytes) == "image/jpeg";
  const std::vector<std::uint8_t> pixels = jpeg ? jpeg_squares(bytes) : png_pixels(bytes);
  if (pixels.empty()) return {};
  std::array<std::uint64_t, 3> sums{};
  constexpr std::size_t kChannels = 4;
  for (std::size_t i = 0; i + kChannels <= pixels.size(); i += kChannels) {
    for (std::size_t c = 0; c < 3; ++c) sums[c] += pixels[i + c];
  }
  const double all = 255.0 * double(pixels.size() / kChannels);
  return {{double(sums[0]) / all, double(sums[1]) / all, double(sums[2]) / all}};
}

}  // namespace icome::files
