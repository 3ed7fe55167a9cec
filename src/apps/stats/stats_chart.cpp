#include "apps/stats/stats_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/stats/stats_chart_page.h"
#include "apps/stats/stats_text.h"
#include "charts/image.h"
#include "charts/plot.h"
#include "io/new_file.h"

namespace icome::apps {
namespace {

using base::Vector2;
using charts::Area;
using charts::Canvas;

constexpr double kPixelScale = 2.0;
constexpr double kSideMargin = 40.0;
constexpr double kHeadHeight = 104.0;
constexpr double kFootHeight = 46.0;
constexpr double kWidestLegend = 210.0;
constexpr double kLabelSize = 15.5;
constexpr double kLabelTurn = 0.55;  // rad, of names that are too long to lie
constexpr double kLongestTurned = 210.0;
constexpr std::size_t kMostGroups = 60;
constexpr std::size_t kMostLegendSeries = 20;
constexpr std::size_t kMostMatrixSides = 40;

bool has_groups(const StatsChart& chart) {
  return chart.kind != ChartKind::Scatter && chart.kind != ChartKind::Curve &&
         chart.kind != ChartKind::Matrix;
}

bool has_legend(const StatsChart& chart) { return has_groups(chart) && chart.series.size() > 1; }

/// The heading: the content of the page in a few words.
std::string heading_of(const StatsChart& chart) {
  switch (chart.kind) {
    case ChartKind::Scatter:
      return fmt::format("{} and {}", chart.y_label, chart.x_label);
    case ChartKind::Matrix:
      return chart.title;
    case ChartKind::Curve:
      return "Power over sample size";
    case ChartKind::Shares: {
      const std::string& counted = chart.series.size() > 1 ? chart.series_label : chart.x_label;
      return chart.series.size() > 1 ? fmt::format("{} by {}", counted, chart.x_label) : counted;
    }
    default:
      break;
  }
  if (chart.x_label.empty() && chart.series.size() == 1) {  // columns side by side
    std::string names;
    for (const std::string& name : chart.groups)
      names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
    return names;
  }
  std::string text = chart.y_label;
  if (!chart.x_label.empty()) text += fmt::format(" by {}", chart.x_label);
  if (!chart.series_label.empty()) text += fmt::format(" and {}", chart.series_label);
  return text;
}

/// A key to the marks.
std::string reading_key(const StatsChart& chart) {
  const std::string interval = fmt::format("{} {}confidence interval", percent_text(chart.confidence),
                                           chart.within_people ? "within-subject " : "");
  switch (chart.kind) {
    case ChartKind::Box:
      return "Box: quartiles and median. Whiskers: farthest values within 1.5 box lengths. Diamond: mean. "
             "Dots: "
             "values.";
    case ChartKind::Bars:
      return fmt::format("Bars: means. Whiskers: {} of the mean.", interval);
    case ChartKind::Interaction:
      return fmt::format("Dots: means. Whiskers: {} of the mean.", interval);
    case ChartKind::Scatter:
      return chart.line ? fmt::format("Line of least squares with the {} of its mean.", interval)
                        : std::string();
    case ChartKind::Matrix:
      return "Blue: one grows with the other. Red: one falls as the other grows. * p < .05, ** p < .01, *** "
             "p < "
             ".001, not adjusted.";
    case ChartKind::Shares:
      return chart.series.size() > 1 ? "Numbers: counts." : "";
    case ChartKind::Curve:
      return "Ring: what was asked for.";
  }
  return {};
}

struct Extremes {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

Extremes extremes_of(const StatsChart& chart) {
  Extremes extremes;
  for (const auto& series : chart.values) {
    for (const std::vector<double>& values : series) {
      if (chart.kind == ChartKind::Box) {
        for (const double value : values) extremes.add(value);
        continue;
      }
      const ChartMean it = chart_mean(values, chart.confidence);
      for (const double value : {it.mean, it.low, it.high}) extremes.add(value);
    }
  }
  for (const Vector2& point : chart.points) extremes.add(point.y());
  if (chart.kind == ChartKind::Scatter) {
    const FittedLine line = fitted_line(chart);
    for (const auto* const limit : {&line.lower, &line.upper})
      for (const Vector2& point : *limit) extremes.add(point.y());
  }
  if (chart.kind == ChartKind::Bars || chart.kind == ChartKind::Shares) extremes.add(0.0);
  return extremes;
}

/// The axis with room beyond the extremes, but not across zero.
AxisRange roomy_axis(const Extremes& extremes, double share, int count) {
  const double room = share * (extremes.high - extremes.low);
  double low = extremes.low - room, high = extremes.high + room;
  if (extremes.low > 0.0) low = std::max(low, 0.0);
  if (extremes.high < 0.0) high = std::min(high, 0.0);
  return axis_over(low, high, count);
}

AxisRange y_range(const StatsChart& chart) {
  const bool shares = chart.kind == ChartKind::Shares && chart.series.size() > 1;
  if (chart.kind == ChartKind::Curve || shares) return axis_over(0.0, 1.0, 5);
  const Extremes extremes = extremes_of(chart);
  const bool stand_on_zero = chart.kind == ChartKind::Bars || chart.kind == ChartKind::Shares;
  // With zeros alone both ends would be zero.
  if (stand_on_zero && extremes.low == 0.0 && extremes.high == 0.0) return axis_over(0.0, 1.0, 6);
  AxisRange range = roomy_axis(extremes, 0.05, 6);
  if (stand_on_zero && extremes.low == 0.0) range.low = 0.0;
  if (stand_on_zero && extremes.high == 0.0) range.high = 0.0;
  return range;
}

std::string y_tick(const StatsChart& chart, double value, double step) {
  const bool shares = chart.kind == ChartKind::Shares && chart.series.size() > 1;
  if (shares) return charts::tick_label(100.0 * value, 100.0 * step) + " %";
  return charts::tick_label(value, step);
}

/// "n = 12", or "n = 6, 5" of several series.
std::string counts_below(const StatsChart& chart, std::size_t group) {
  if (chart.kind == ChartKind::Shares) {
    double total = 0.0;
    for (const auto& series : chart.values)
      if (!series[group].empty()) total += series[group].front();
    return fmt::format("n = {:.10g}", total);
  }
  std::string text;
  bool same = true;
  for (const auto& series : chart.values) {
    same = same && series[group].size() == chart.values.front()[group].size();
    text += fmt::format("{}{}", text.empty() ? "n = " : ", ", series[group].size());
  }
  if (!same) return text;
  return fmt::format("n = {}{}", chart.values.front()[group].size(), chart.series.size() > 1 ? " each" : "");
}

/// The layout of the groups' names below the axis.
struct GroupLabels {
  bool turned = false;
  double height = 0.0;
};

GroupLabels labels_of(const Canvas& canvas, const StatsChart& chart, double slot) {
  GroupLabels labels{false, 48.0};
  double widest = 0.0;
  for (std::size_t i = 0; i < chart.groups.size(); ++i) {
    widest = std::max(widest, canvas.text_width(chart.groups[i], {kLabelSize, {}}));
    widest = std::max(widest, canvas.text_width(counts_below(chart, i), {13.0, {}}));
  }
  if (widest + 8.0 <= slot) return labels;
  return {true, 26.0 + std::sin(kLabelTurn) * std::min(widest + 60.0, kLongestTurned)};
}

/// The names of the series' factors, a line each.
std::vector<std::string> legend_heads(const StatsChart& chart) {
  std::vector<std::string> heads;
  for (std::size_t from = 0; from <= chart.series_label.size();) {
    const std::size_t comma = std::min(chart.series_label.find(", ", from), chart.series_label.size());
    heads.push_back(chart.series_label.substr(from, comma - from));
    from = comma + 2;
  }
  return heads;
}

double legend_width(const Canvas& canvas, const StatsChart& chart) {
  if (!has_legend(chart)) return 0.0;
  double widest = 0.0;
  for (const std::string& name : legend_heads(chart))
    widest = std::max(widest, canvas.text_width(name, {14.0, {}}));
  for (const std::string& name : chart.series)
    widest = std::max(widest, 22.0 + canvas.text_width(name, {kLabelSize, {}}));
  return 28.0 + std::min(widest, kWidestLegend);
}

/// Lays out the frame, with room for the labels of the axes.
ChartFrame frame_of(const Canvas& canvas, const StatsChart& chart, const AxisRange& y, const AxisRange& x,
                    GroupLabels& labels) {
  double widest = 0.0;
  for (const double value : y.at)
    widest = std::max(widest, canvas.text_width(y_tick(chart, value, y.step), {kLabelSize, {}}));
  ChartFrame frame;
  const double left = kSideMargin + 40.0 + widest;
  const double right = kChartWidth - kSideMargin - legend_width(canvas, chart);
  frame.slot = has_groups(chart) ? (right - left) / double(chart.groups.size()) : 0.0;
  labels = has_groups(chart) ? labels_of(canvas, chart, frame.slot) : GroupLabels{false, 28.0};
  const double label = chart.x_label.empty() ? 0.0 : 26.0;
  const double bottom = kChartHeight - kFootHeight - label - labels.height;
  frame.area = {left, kHeadHeight, right - left, bottom - kHeadHeight};
  frame.y = {y.low, y.high, frame.area.bottom(), frame.area.y};
  frame.x = {x.low, x.high, frame.area.x, frame.area.right()};
  return frame;
}

void draw_y_axis_of(Canvas& canvas, const StatsChart& chart, const ChartFrame& frame, const AxisRange& y) {
  for (const double value : y.at) {
    const Vector2 grid[] = {{frame.area.x, frame.y(value)}, {frame.area.right(), frame.y(value)}};
    canvas.line(grid, {charts::kGridLine, 1.0, {}});
    canvas.text({frame.area.x - 10.0, frame.y(value) + 0.36 * kLabelSize}, y_tick(chart, value, y.step),
                {kLabelSize, charts::kInk, false, 1.0});
  }
  const charts::TextStyle style{kLabelSize + 1.0, charts::kInk, false, 0.5, 0.5 * M_PI};
  canvas.text({kSideMargin + 12.0, frame.area.y + 0.5 * frame.area.height},
              fitted(canvas, chart.y_label, style, frame.area.height + 60.0), style);
}

void draw_group_labels(Canvas& canvas, const StatsChart& chart, const ChartFrame& frame, bool turned) {
  const double base = frame.area.bottom();
  for (std::size_t i = 0; i < chart.groups.size(); ++i) {
    const double x = frame.slot_middle(i);
    if (turned) {
      const charts::TextStyle style{13.5, charts::kInk, false, 1.0, kLabelTurn};
      const std::string count = fmt::format(" ({})", counts_below(chart, i));
      const double room =
          std::min(kLongestTurned, (x - 12.0) / std::cos(kLabelTurn)) - canvas.text_width(count, style);
      canvas.text({x + 5.0, base + 18.0}, fitted(canvas, chart.groups[i], style, room) + count, style);
      continue;
    }
    canvas.text({x, base + 23.0}, chart.groups[i], {kLabelSize, charts::kInk, false, 0.5});
    canvas.text({x, base + 41.0}, counts_below(chart, i), {13.0, charts::kQuietInk, false, 0.5});
  }
}

void draw_x_axis_of(Canvas& canvas, const StatsChart& chart, const ChartFrame& frame, const AxisRange& x,
                    const GroupLabels& labels) {
  const Vector2 base[] = {{frame.area.x, frame.area.bottom()}, {frame.area.right(), frame.area.bottom()}};
  const bool below_zero = chart.kind == ChartKind::Bars && frame.y.low < 0.0;  // bars stand on their own line
  if (!below_zero) canvas.line(base, {charts::kInk, 1.2, {}});
  if (has_groups(chart)) {
    draw_group_labels(canvas, chart, frame, labels.turned);
  } else {
    for (const double value : x.at) {
      const Vector2 mark[] = {{frame.x(value), frame.area.bottom()},
                              {frame.x(value), frame.area.bottom() + 5.0}};
      canvas.line(mark, {charts::kInk, 1.0, {}});
      canvas.text({frame.x(value), frame.area.bottom() + 23.0}, charts::tick_label(value, x.step),
                  {kLabelSize, charts::kInk, false, 0.5});
    }
  }
  const charts::TextStyle style{kLabelSize + 1.0, charts::kInk, false, 0.5};
  canvas.text({frame.area.x + 0.5 * frame.area.width, frame.area.bottom() + labels.height + 20.0},
              fitted(canvas, chart.x_label, style, frame.area.width), style);
}

void draw_legend(Canvas& canvas, const StatsChart& chart, const ChartFrame& frame) {
  const double x = frame.area.right() + 26.0, width = kChartWidth - kSideMargin - x;
  double y = frame.area.y - 4.0;
  const charts::TextStyle head{14.0, charts::kQuietInk}, style{kLabelSize, charts::kInk};
  for (const std::string& name : legend_heads(chart))
    canvas.text({x, y += 19.0}, fitted(canvas, name, head, width), head);
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    y += 26.0;
    canvas.fill_disc({x + 7.0, y - 5.0}, 6.5, charts::series_colour(i));
    canvas.text({x + 22.0, y}, fitted(canvas, chart.series[i], style, width - 22.0), style);
  }
}

void draw_head_of(Canvas& canvas, const StatsChart& chart) {
  const double width = kChartWidth - 2.0 * kSideMargin;
  const charts::TextStyle head{21.0, charts::kInk, true}, below{16.0, charts::kQuietInk},
      foot{12.5, charts::kQuietInk};
  canvas.text({kSideMargin, 44.0}, fitted(canvas, heading_of(chart), head, width), head);
  if (chart.kind != ChartKind::Matrix)
    canvas.text({kSideMargin, 72.0}, fitted(canvas, with_minus(chart.title), below, width), below);
  canvas.text({kSideMargin, kChartHeight - 18.0}, fitted(canvas, reading_key(chart), foot, width), foot);
}

AxisRange x_range(const StatsChart& chart) {
  Extremes extremes;
  for (const Vector2& point : chart.points) extremes.add(point.x());
  if (extremes.low > extremes.high) return {};
  if (chart.kind == ChartKind::Curve) return axis_over(0.0, extremes.high, 8);
  return roomy_axis(extremes, 0.03, 8);
}

void draw_marks(Canvas& canvas, const StatsChart& chart, const ChartFrame& frame) {
  switch (chart.kind) {
    case ChartKind::Box:
      return draw_boxes(canvas, chart, frame);
    case ChartKind::Bars:
      return draw_bars(canvas, chart, frame);
    case ChartKind::Interaction:
      return draw_interaction(canvas, chart, frame);
    case ChartKind::Scatter:
      return draw_scatter(canvas, chart, frame);
    case ChartKind::Shares:
      return draw_shares(canvas, chart, frame);
    case ChartKind::Curve:
      return draw_curve(canvas, chart, frame);
    case ChartKind::Matrix:
      return;
  }
}

void draw_chart(Canvas& canvas, const StatsChart& chart) {
  draw_head_of(canvas, chart);
  if (chart.kind == ChartKind::Matrix) {
    draw_matrix(canvas, chart,
                {kSideMargin, kHeadHeight - 30.0, kChartWidth - 2.0 * kSideMargin,
                 kChartHeight - kHeadHeight + 30.0 - kFootHeight});
    return;
  }
  const AxisRange y = y_range(chart), x = x_range(chart);
  GroupLabels labels;
  const ChartFrame frame = frame_of(canvas, chart, y, x, labels);
  draw_y_axis_of(canvas, chart, frame, y);
  draw_marks(canvas, chart, frame);
  draw_x_axis_of(canvas, chart, frame, x, labels);
  if (has_legend(chart)) draw_legend(canvas, chart, frame);
}

base::Result<void> check_size(const StatsChart& chart) {
  const std::size_t most = chart.kind == ChartKind::Matrix ? kMostMatrixSides : kMostGroups;
  if (chart.groups.size() > most)
    return base::fail(
        fmt::format("a page can show {} groups, and there are {}; draw fewer.", most, chart.groups.size()));
  if (chart.series.size() > kMostLegendSeries)
    return base::fail(fmt::format("a page can tell {} levels of {} apart, and there are {}; draw fewer.",
                                  kMostLegendSeries, chart.series_label, chart.series.size()));
  return {};
}

std::string lower_ending(const std::filesystem::path& out) {
  std::string ending = out.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return ending;
}

}  // namespace

bool is_chart_name(const std::filesystem::path& out) {
  const std::string ending = lower_ending(out);
  return ending == ".svg" || ending == ".png";
}

base::Result<std::string> chart_svg(const StatsChart& chart) {
  if (const auto checked = check_size(chart); !checked) return tl::unexpected(checked.error());
  Canvas canvas = Canvas::of_lines(kChartWidth, kChartHeight);
  draw_chart(canvas, chart);
  return canvas.svg();
}

base::Result<std::vector<std::uint8_t>> chart_png(const StatsChart& chart) {
  if (const auto checked = check_size(chart); !checked) return tl::unexpected(checked.error());
  Canvas canvas(int(kPixelScale * kChartWidth), int(kPixelScale * kChartHeight), kPixelScale);
  draw_chart(canvas, chart);
  return charts::encode_png(canvas.snapshot());
}

base::Result<void> write_chart(const StatsChart& chart, const std::filesystem::path& out) {
  std::string bytes;
  if (lower_ending(out) == ".png") {
    const auto png = chart_png(chart);
    if (!png) return tl::unexpected(png.error());
    bytes.assign(png->begin(), png->end());
  } else {
    auto svg = chart_svg(chart);
    if (!svg) return tl::unexpected(svg.error());
    bytes = std::move(*svg);
  }
  auto file = io::NewFile::create(out);
  if (!file) return tl::unexpected(file.error());
  file->write(bytes);
  return file->finish();
}

}  // namespace icome::apps
