#pragma once
#include <vector>

#include "cutout/tracker/table_view.h"

namespace icome::cutout {

/// From pixels to millimetres as TableView does, but in a few nanoseconds: what the lens bends is looked up
/// in a grid, exact to some 0.01 pixels for usual lenses.
class Rectifier {
 public:
  explicit Rectifier(TableView view);

  const TableView& view() const { return view_; }
  /// mm. Real-time safe.
  base::Vector2 to_table(double x, double y) const {
    if (!shifts_.empty()) {
      const base::Vector2 shift = shift_at(x, y);
      x += shift.x();
      y += shift.y();
    }
    const double w = m20_ * x + m21_ * y + m22_;
    return {(m00_ * x + m01_ * y + m02_) / w, (m10_ * x + m11_ * y + m12_) / w};
  }
  /// Is what turns to the right in the frame turning to the left on the table?
  bool mirrors() const { return mirrors_; }
  /// Is the place at most half the table's size beyond its border?
  bool near_table(const base::Vector2& mm) const {
    const double wide = view_.table_width(), high = view_.table_height();
    return mm.x() > -0.5 * wide && mm.x() < 1.5 * wide && mm.y() > -0.5 * high && mm.y() < 1.5 * high;
  }
  /// Millimetres to a pixel about a place of the table: the geometric mean of both ways.
  double mm_per_pixel(const base::Vector2& mm) const;

 private:
  base::Vector2 shift_at(double x, double y) const;

  TableView view_;
  double m00_, m01_, m02_, m10_, m11_, m12_, m20_, m21_, m22_;
  bool mirrors_ = false;
  double cell_ = 8;  // pixels between nodes
  int columns_ = 0, rows_ = 0;
  std::vector<base::Vector2> shifts_;  // pixels, at the nodes; empty for a lens that does not bend
};

}  // namespace icome::cutout
