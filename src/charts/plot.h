#pragma once
#include <span>
#include <string>
#include <vector>

#include "base/vector.h"
#include "charts/canvas.h"
#include "charts/palette.h"

namespace icome::charts {

/// Marks of an axis, at multiples of 1, 2 or 5 times a power of ten.
struct Ticks {
  double step = 1.0;
  std::vector<double> at;  ///< ascending, within the range asked for
};

/// About `count` ticks in low ... high. A range that is empty or not finite gives a single tick at `low`.
Ticks nice_ticks(double low, double high, int count);

/// The number with the digits that tell it from its neighbours, a `step` away, and a real minus sign.
std::string tick_label(double value, double step);

/// A stretch of the horizontal axis.
struct Span {
  double from, to;
};

/// One quantity over time (or any growing quantity), drawn as a line over a filled area.
struct TimePlot {
  std::string x_label;                    ///< such as "time (s)"
  std::string y_label;                    ///< such as "force (N)"
  std::span<const base::Vector2> points;  ///< x never falls; any number, thinned to what the page resolves
  std::vector<Span> shaded;               ///< stretches marked behind the line
  Span x_range{0.0, 1.0};
  double y_max = 1.0;        ///< the axis begins at 0; > 0
  std::vector<Colour> fill;  ///< from 0 to y_max, under the line; may be empty
  Colour line = kInk;
  bool mark_peak = false;  ///< a ring on the highest point
};

/// Draws the plot with its axes and labels inside the area.
void draw_time_plot(Canvas& canvas, const Area& area, const TimePlot& plot);

}  // namespace icome::charts
