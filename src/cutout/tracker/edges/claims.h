#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vector.h"

namespace icome::cutout {

/// Places of a frame whose edge belongs to a triangle: cells of 4 x 4 pixels.
class Claims {
 public:
  static constexpr int kCell = 4;  ///< pixels

  Claims(int frame_width, int frame_height)
      : columns_(frame_width / kCell + 1),
        rows_(frame_height / kCell + 1),
        taken_(std::size_t(columns_) * std::size_t(rows_), 0) {}

  void clear() { std::fill(taken_.begin(), taken_.end(), std::uint8_t(0)); }
  /// Claims the cells about a pixel.
  void take(const base::Vector2& pixel) {
    for (int dy = -2; dy <= 2; dy += 2)
      for (int dx = -2; dx <= 2; dx += 2)
        if (std::uint8_t* cell = at(pixel.x() + dx, pixel.y() + dy)) *cell = 1;
  }
  bool taken(double x, double y) const {
    const std::uint8_t* cell = const_cast<Claims*>(this)->at(x, y);
    return cell && *cell;
  }

 private:
  std::uint8_t* at(double x, double y) {
    if (!(x >= 0 && y >= 0 && x < double(columns_) * kCell && y < double(rows_) * kCell)) return nullptr;
    return &taken_[std::size_t(int(y) / kCell) * std::size_t(columns_) + std::size_t(int(x) / kCell)];
  }

  int columns_, rows_;
  std::vector<std::uint8_t> taken_;
};

}  // namespace icome::cutout
