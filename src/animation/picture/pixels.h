#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "charts/image.h"

namespace icome::animation {

/// Pixels that are owned: words 0xAARRGGBB in the processor's byte order, whose colours are premultiplied by
/// their opacity; rows from the top, without gaps. That is cairo's CAIRO_FORMAT_ARGB32, Qt's
/// QImage::Format_ARGB32_Premultiplied and, on little-endian processors, BGRA in memory.
struct Pixels {
  int width = 0, height = 0;  ///< px
  std::vector<std::uint32_t> words;

  Pixels() = default;
  /// Clear ones.
  Pixels(int wide, int high) : width(wide), height(high), words(std::size_t(wide) * std::size_t(high)) {}

  const std::uint32_t* row(int y) const { return words.data() + std::size_t(y) * std::size_t(width); }
  std::uint32_t* row(int y) { return words.data() + std::size_t(y) * std::size_t(width); }
  std::size_t bytes() const { return words.size() * sizeof(std::uint32_t); }
};

/// Pixels of the same format that another owns, such as a window's picture.
struct PixelsView {
  std::uint32_t* words = nullptr;
  int width = 0, height = 0;     ///< px
  std::ptrdiff_t row_words = 0;  ///< from one row to the next

  PixelsView() = default;
  PixelsView(std::uint32_t* first, int wide, int high, std::ptrdiff_t words_of_row)
      : words(first), width(wide), height(high), row_words(words_of_row) {}
  PixelsView(Pixels& pixels)  // NOLINT: pixels are seen wherever a view is asked for
      : PixelsView(pixels.words.data(), pixels.width, pixels.height, pixels.width) {}

  std::uint32_t* row(int y) const { return words + y * row_words; }
};

/// One of the four parts of a pixel, 0 to 255.
constexpr std::uint32_t alpha_of(std::uint32_t word) { return word >> 24U; }

/// A pixel of a colour that is not premultiplied, 0 to 255 each.
constexpr std::uint32_t premultiplied(std::uint32_t red, std::uint32_t green, std::uint32_t blue,
                                      std::uint32_t alpha) {
  const auto part = [&](std::uint32_t channel) { return (channel * alpha + 127) / 255; };
  return alpha << 24U | part(red) << 16U | part(green) << 8U | part(blue);
}

/// From and to pictures whose colours are not premultiplied.
Pixels pixels_of(const charts::Image& image);
charts::Image image_of(const Pixels& pixels);

/// A picture as it was seen when it was taken, by its io::exif_orientation(), 1 to 8.
Pixels upright(Pixels pixels, int orientation);

/// The picture made smaller by means over areas, which all pixels take part in. Sides from 1 to its own.
Pixels shrunk(const Pixels& pixels, int width, int height);

}  // namespace icome::animation
