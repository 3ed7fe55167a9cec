#pragma once
#include <vector>

#include "sketch/drawn.h"

namespace icome::sketch {

/// Fits a width that is linear piece by piece to widths at places (thesis 4.8): each piece begins where and
/// as wide as the last one ended, and a new one begins when no line from there comes within the tolerance of
/// all widths since. The line is the one of least squares of those that do. Constant time for each width.
class WidthFit {
 public:
  /// `tolerance` in m.
  explicit WidthFit(double tolerance) : tolerance_(tolerance) {}

  /// The next width (m). Places do not go back; of widths at one place the first counts.
  void add(double place, double width);

  /// The pieces, the last one up to `end`. One of width 0 where nothing was added. Precondition: end is not
  /// before the last place.
  std::vector<WidthSegment> widths(double end) const;

 private:
  double slope() const;
  void begin(double place, double width);

  double tolerance_;
  bool begun_ = false;
  double from_ = 0.0;
  double from_width_ = 0.0;
  double last_ = 0.0;  // place of the last width
  double low_ = 0.0;   // slopes of the lines that are near enough
  double high_ = 0.0;
  double squares_ = 0.0;   // of places from `from_`
  double products_ = 0.0;  // of these and widths
  std::vector<WidthSegment> finished_;
};

}  // namespace icome::sketch
