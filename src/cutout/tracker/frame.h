#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace icome::cutout {

/// A colour picture of a camera, seen but not owned: 8 bits a channel in the order blue, green, red, which is
/// that of OpenCV; rows from the top.
struct FrameView {
  const std::uint8_t* pixels = nullptr;
  int width = 0;              ///< pixels
  int height = 0;             ///< pixels
  std::size_t row_bytes = 0;  ///< from one row to the next; at least 3 * width

  const std::uint8_t* row(int y) const { return pixels + static_cast<std::size_t>(y) * row_bytes; }
};

/// A picture that owns its pixels.
struct Frame {
  int width = 0;                  ///< pixels
  int height = 0;                 ///< pixels
  std::vector<std::uint8_t> bgr;  ///< 3 * width * height bytes
  double time = 0;                ///< s, since the source began

  FrameView view() const { return {bgr.data(), width, height, 3 * static_cast<std::size_t>(width)}; }
};

}  // namespace icome::cutout
