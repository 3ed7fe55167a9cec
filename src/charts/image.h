#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/result.h"

namespace icome::charts {

/// An opaque or translucent picture: sRGB, 8 bits a channel, not premultiplied, rows from the top.
struct Image {
  int width = 0;                   ///< pixels
  int height = 0;                  ///< pixels
  std::vector<std::uint8_t> rgba;  ///< 4 * width * height bytes

  /// The four bytes of the pixel in column `x` and row `y` (0 is the top row).
  const std::uint8_t* pixel(int x, int y) const {
    return rgba.data() +
           4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
};

/// The picture as the bytes of a PNG file. Fails when memory runs out or a side is not in 1 ... 32767.
base::Result<std::vector<std::uint8_t>> encode_png(const Image& image);

/// Writes the picture as a PNG file. The file appears whole or not at all: it is written beside
/// `path` and renamed. The error names the file and gives the system's message.
base::Result<void> write_png(const Image& image, const std::filesystem::path& path);

}  // namespace icome::charts
