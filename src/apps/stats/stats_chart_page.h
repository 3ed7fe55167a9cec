#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "apps/stats/stats_chart.h"
#include "charts/canvas.h"
#include "charts/palette.h"

namespace icome::apps {

// Parts that the drawings of stats_chart have in common; lengths in page units.

inline constexpr double kChartWidth = 960.0;
inline constexpr double kChartHeight = 640.0;

/// Maps a quantity to a stretch of the page.
struct ChartScale {
  double low = 0.0, high = 1.0, from = 0.0, to = 1.0;
  double operator()(double value) const { return from + (to - from) * (value - low) / (high - low); }
};

/// The place of the marks, and the scales from quantities to places.
struct ChartFrame {
  charts::Area area{};
  ChartScale x, y;
  double slot = 0.0;  // width of a group's place
  double slot_middle(std::size_t group) const { return area.x + slot * (double(group) + 0.5); }
};

/// An axis and its ticks.
struct AxisRange {
  double low = 0.0, high = 1.0;
  std::vector<double> at;
  double step = 1.0;
};
/// The axis from `low` to `high`, a little wider where they are equal.
AxisRange axis_over(double low, double high, int count);

/// Mean and interval of a group, as charts show them. NaN where there are too few values.
struct ChartMean {
  double mean = 0.0, low = 0.0, high = 0.0;
};
ChartMean chart_mean(const std::vector<double>& values, double confidence);

/// The line of least squares and the interval of its mean, as the chart of a scatter shows them.
struct FittedLine {
  base::Vector2 from, to;                   // its ends, above the first and the last point
  std::vector<base::Vector2> lower, upper;  // the interval's limits from left to right
};
/// Empty `lower` where there is none: less than three points, or all at one x.
FittedLine fitted_line(const StatsChart& chart);

/// The text with a minus sign for every hyphen that stands for one.
std::string with_minus(std::string_view text);

// Draw the marks of each kind in a frame that is laid out.
void draw_boxes(charts::Canvas& canvas, const StatsChart& chart, const ChartFrame& frame);
void draw_bars(charts::Canvas& canvas, const StatsChart& chart, const ChartFrame& frame);
void draw_interaction(charts::Canvas& canvas, const StatsChart& chart, const ChartFrame& frame);
void draw_scatter(charts::Canvas& canvas, const StatsChart& chart, const ChartFrame& frame);
void draw_curve(charts::Canvas& canvas, const StatsChart& chart, const ChartFrame& frame);
void draw_shares(charts::Canvas& canvas, const StatsChart& chart, const ChartFrame& frame);
/// Draws the whole page but its head.
void draw_matrix(charts::Canvas& canvas, const StatsChart& chart, const charts::Area& area);

}  // namespace icome::apps
