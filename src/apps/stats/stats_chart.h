#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vector.h"

namespace icome::apps {

/// The kind of a chart.
enum class ChartKind {
  Box,          // quartiles, values and means of groups
  Bars,         // means of groups with confidence intervals
  Interaction,  // means joined by lines, a line a series
  Scatter,      // two quantities, with the line of least squares and its confidence band
  Matrix,       // correlations of each with each
  Shares,       // counts as shares, a bar a group
  Curve,        // power over sample size
};

/// The content of a chart, in the words and units of the data.
struct StatsChart {
  ChartKind kind = ChartKind::Box;
  std::string title;
  std::string x_label, y_label;
  std::string series_label;                              // over the legend
  std::vector<std::string> groups;                       // along x
  std::vector<std::string> series;                       // by colour; one of them: no legend
  std::vector<std::vector<std::vector<double>>> values;  // [series][group]; of Shares one count each
  std::vector<base::Vector2> points;                     // of Scatter and Curve
  bool line = true;                                      // of Scatter
  std::vector<base::Vector2> marks;                      // of Curve, ringed
  Eigen::MatrixXd matrix, p;                             // of Matrix; named by `groups`
  double confidence = 0.95;                              // of intervals and bands
  bool within_people = false;                            // the intervals are within-subject ones
};

/// The values of --plot-kind, in the order of ChartKind.
inline constexpr const char* kChartKinds[] = {"box",    "bars",   "interaction", "scatter",
                                              "matrix", "shares", "curve"};

/// The chart as an SVG file, and as the bytes of a PNG file of 1920 x 1280 pixels. Fail for more groups or
/// series than a page can show.
base::Result<std::string> chart_svg(const StatsChart& chart);
base::Result<std::vector<std::uint8_t>> chart_png(const StatsChart& chart);

/// Writes the chart as a PNG file if `out` ends in .png, else as an SVG file. Fails as those do, and when the
/// file cannot be written.
base::Result<void> write_chart(const StatsChart& chart, const std::filesystem::path& out);

/// Does the path end in .svg or .png?
bool is_chart_name(const std::filesystem::path& out);

}  // namespace icome::apps
