#include "cutout/tracker/edges/rectifier.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace icome::cutout {

Rectifier::Rectifier(TableView view) : view_(std::move(view)) {
  const base::Matrix3& m = view_.mm_from_pixels();
  m00_ = m(0, 0), m01_ = m(0, 1), m02_ = m(0, 2);
  m10_ = m(1, 0), m11_ = m(1, 1), m12_ = m(1, 2);
  m20_ = m(2, 0), m21_ = m(2, 1), m22_ = m(2, 2);
  const base::Vector2 middle(view_.frame_width() / 2.0, view_.frame_height() / 2.0);
  const base::Vector2 at = view_.to_table(middle);
  const base::Vector2 right = view_.to_table(middle + base::Vector2(1, 0)) - at;
  const base::Vector2 down = view_.to_table(middle + base::Vector2(0, 1)) - at;
  mirrors_ = right.x() * down.y() - right.y() * down.x() < 0;
  if (!view_.bends()) return;
  cell_ = std::max(8.0, std::max(view_.frame_width(), view_.frame_height()) / 160.0);
  columns_ = int(std::ceil(view_.frame_width() / cell_)) + 2;
  rows_ = int(std::ceil(view_.frame_height() / cell_)) + 2;
  shifts_.reserve(std::size_t(columns_) * std::size_t(rows_));
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const base::Vector2 pixel(column * cell_, row * cell_);
      shifts_.push_back(view_.undistorted(pixel) - pixel);
    }
}

base::Vector2 Rectifier::shift_at(double x, double y) const {
  const double u = std::clamp(x / cell_, 0.0, columns_ - 1.001);
  const double v = std::clamp(y / cell_, 0.0, rows_ - 1.001);
  const int column = int(u), row = int(v);
  const double right = u - column, down = v - row;
  const base::Vector2* node = &shifts_[std::size_t(row) * std::size_t(columns_) + std::size_t(column)];
  const base::Vector2* below = node + columns_;
  return (1 - down) * ((1 - right) * node[0] + right * node[1]) +
         down * ((1 - right) * below[0] + right * below[1]);
}

double Rectifier::mm_per_pixel(const base::Vector2& mm) const {
  const base::Vector2 at = view_.to_pixel(mm), right = view_.to_pixel(mm + base::Vector2(1, 0)),
                      down = view_.to_pixel(mm + base::Vector2(0, 1));
  const base::Vector2 a = right - at, b = down - at;
  const double area = std::abs(a.x() * b.y() - a.y() * b.x());  // pixels that a square mm covers
  return area > 1e-12 ? 1 / std::sqrt(area) : 1e6;
}

}  // namespace icome::cutout
