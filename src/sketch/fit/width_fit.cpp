#include "sketch/fit/width_fit.h"

#include <algorithm>
#include <limits>

namespace icome::sketch {

void WidthFit::begin(double place, double width) {
  from_ = last_ = place;
  from_width_ = width;
  low_ = -std::numeric_limits<double>::infinity();
  high_ = std::numeric_limits<double>::infinity();
  squares_ = 0.0;
  products_ = 0.0;
}

void WidthFit::add(double place, double width) {
  if (!begun_) {
    begin(0.0, width);
    begun_ = true;
  }
  if (!(place > last_)) return;
  double way = place - from_;
  if (std::max(low_, (width - tolerance_ - from_width_) / way) >
      std::min(high_, (width + tolerance_ - from_width_) / way)) {
    const double to_width = std::max(0.0, from_width_ + slope() * (last_ - from_));
    finished_.push_back({from_, from_width_, last_, to_width});
    begin(last_, to_width);
    way = place - from_;
  }
  low_ = std::max(low_, (width - tolerance_ - from_width_) / way);
  high_ = std::min(high_, (width + tolerance_ - from_width_) / way);
  squares_ += way * way;
  products_ += way * (width - from_width_);
  last_ = place;
}

double WidthFit::slope() const {
  return squares_ > 0.0 ? std::clamp(products_ / squares_, low_, high_) : 0.0;
}

std::vector<WidthSegment> WidthFit::widths(double end) const {
  std::vector<WidthSegment> pieces = finished_;
  const double to_width = std::max(0.0, from_width_ + slope() * (last_ - from_));
  pieces.push_back({from_, from_width_, last_, to_width});
  if (last_ == from_) pieces.back().to = end;
  if (pieces.back().to < end) {
    // The rest, behind the last width, is as wide as it.
    pieces.push_back({last_, to_width, end, to_width});
  }
  return pieces;
}

}  // namespace icome::sketch
