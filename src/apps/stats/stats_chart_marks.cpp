#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "apps/stats/stats_chart_page.h"
#include "apps/stats/stats_text.h"
#include "charts/plot.h"
#include "stats/tables/descriptives.h"
#include "stats/tables/sums.h"
#include "stats/tests/correlation.h"
#include "stats/tests/tails.h"

namespace icome::apps {

using base::Vector2;
using charts::Area;
using charts::Canvas;
using charts::Colour;

namespace {

constexpr std::size_t kMostDots = 300;      // of a group; with more, only values outside the whiskers
constexpr std::size_t kMostPoints = 4'000;  // of a scatter; with more, one for each spot of the page
constexpr double kWidestBox = 96.0;

/// Groups without series have colours of their own, as long as there are enough.
Colour colour_of(const StatsChart& chart, std::size_t series, std::size_t group) {
  if (chart.series.size() > 1) return charts::series_colour(series);
  return charts::series_colour(chart.groups.size() <= 6 ? group : 0);
}

/// The middle and width of a series' place in a group's slot.
struct Place {
  double middle = 0.0, width = 0.0;
};

Place place_of(const StatsChart& chart, const ChartFrame& frame, std::size_t series, std::size_t group) {
  const auto count = double(chart.series.size());
  const double step = std::min(0.78 * frame.slot / count, kWidestBox * 1.2);
  return {frame.slot_middle(group) + step * (double(series) - 0.5 * (count - 1.0)), step / 1.2};
}

void vertical(Canvas& canvas, double x, double from, double to, const charts::Stroke& stroke) {
  const Vector2 points[] = {{x, from}, {x, to}};
  canvas.line(points, stroke);
}

void level(Canvas& canvas, double y, double from, double to, const charts::Stroke& stroke) {
  const Vector2 points[] = {{from, y}, {to, y}};
  canvas.line(points, stroke);
}

/// A whisker with ends.
void interval_mark(Canvas& canvas, double x, double low, double high, double half,
                   const charts::Stroke& stroke) {
  vertical(canvas, x, low, high, stroke);
  level(canvas, low, x - half, x + half, stroke);
  level(canvas, high, x - half, x + half, stroke);
}

/// Offsets in -0.5 ... 0.5, evenly spread and the same each time (the golden ratio's multiples).
double spread(std::size_t i) {
  const double turn = 0.61803398874989485 * double(i + 1);
  return turn - std::floor(turn) - 0.5;
}

struct BoxFigures {
  double lower = 0.0, median = 0.0, upper = 0.0, low = 0.0, high = 0.0;
};

BoxFigures box_of(const std::vector<double>& values) {
  BoxFigures box{stats::quantile(values, 0.25), stats::quantile(values, 0.5), stats::quantile(values, 0.75),
                 0, 0};
  const double reach = 1.5 * (box.upper - box.lower);
  box.low = box.lower;
  box.high = box.upper;
  for (const double value : values) {
    if (value >= box.lower - reach) box.low = std::min(box.low, value);
    if (value <= box.upper + reach) box.high = std::max(box.high, value);
  }
  return box;
}

void draw_dots(Canvas& canvas, const ChartFrame& frame, const Place& place, const std::vector<double>& values,
               const BoxFigures& box, const Colour& colour) {
  const bool all = values.size() <= kMostDots;
  std::set<long> drawn;  // spots of values outside the whiskers, each once
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double y = frame.y(values[i]);
    if (!all &&
        ((values[i] >= box.low && values[i] <= box.high) || !drawn.insert(std::lround(2.0 * y)).second))
      continue;
    const double x = place.middle + 0.52 * place.width * (all ? spread(i) : 0.0);
    canvas.fill_disc({x, y}, all && values.size() > 60 ? 2.4 : 3.2, colour.with_alpha(0.55));
  }
}

void draw_box(Canvas& canvas, const ChartFrame& frame, const Place& place, const std::vector<double>& values,
              const Colour& colour) {
  const BoxFigures box = box_of(values);
  const double left = place.middle - 0.5 * place.width, right = place.middle + 0.5 * place.width;
  vertical(canvas, place.middle, frame.y(box.low), frame.y(box.lower), {colour, 1.6, {}});
  vertical(canvas, place.middle, frame.y(box.upper), frame.y(box.high), {colour, 1.6, {}});
  for (const double end : {box.low, box.high})
    level(canvas, frame.y(end), place.middle - 0.2 * place.width, place.middle + 0.2 * place.width,
          {colour, 1.6, {}});
  canvas.fill({left, frame.y(box.upper), place.width, frame.y(box.lower) - frame.y(box.upper)},
              colour.with_alpha(0.20));
  draw_dots(canvas, frame, place, values, box, colour);
  const Vector2 outline[] = {{left, frame.y(box.lower)},
                             {left, frame.y(box.upper)},
                             {right, frame.y(box.upper)},
                             {right, frame.y(box.lower)},
                             {left, frame.y(box.lower)}};
  canvas.line(outline, {colour, 1.6, {}});
  level(canvas, frame.y(box.median), left, right, {colour, 3.4, {}});
  const double middle = frame.y(stats::mean(values)), half = std::min(6.5, 0.3 * place.width);
  const Vector2 diamond[] = {{place.middle - half, middle},
                             {place.middle, middle - half},
                             {place.middle + half, middle},
                             {place.middle, middle + half},
                             {place.middle - half, middle}};
  canvas.fill_polygon(diamond, charts::kPaper);
  canvas.line(diamond, {charts::kInk, 1.5, {}});
}

}  // namespace

AxisRange axis_over(double low, double high, int count) {
  if (!std::isfinite(low) || !std::isfinite(high) || low > high) return axis_over(0.0, 1.0, count);
  if (low == high) {
    const double room = low == 0.0 ? 1.0 : 0.05 * std::abs(low);
    return axis_over(low - room, high + room, count);
  }
  const charts::Ticks ticks = charts::nice_ticks(low, high, count);
  AxisRange range;
  range.low = low;
  range.high = high;
  range.step = ticks.step;
  range.at = ticks.at;
  return range;
}

ChartMean chart_mean(const std::vector<double>& values, double confidence) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  if (values.empty()) return {none, none, none};
  const auto it = stats::describe(values, confidence);
  return it ? ChartMean{it->mean, it->mean_low, it->mean_high} : ChartMean{none, none, none};
}

std::string with_minus(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char next = i + 1 < text.size() ? text[i + 1] : ' ';
    const bool number = next == '.' || (next >= '0' && next <= '9');
    const bool begins = i == 0 || text[i - 1] == ' ' || text[i - 1] == '[' || text[i - 1] == '(';
    if (text[i] == '-' && number && begins)
      result += "\u2212";
    else
      result += text[i];
  }
  return result;
}

void draw_boxes(Canvas& canvas, const StatsChart& chart, const ChartFrame& frame) {
  for (std::size_t s = 0; s < chart.series.size(); ++s)
    for (std::size_t g = 0; g < chart.groups.size(); ++g)
      if (!chart.values[s][g].empty())
        draw_box(canvas, frame, place_of(chart, frame, s, g), chart.values[s][g], colour_of(chart, s, g));
}

void draw_bars(Canvas& canvas, const StatsChart& chart, const ChartFrame& frame) {
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    for (std::size_t g = 0; g < chart.groups.size(); ++g) {
      const ChartMean it = chart_mean(chart.values[s][g], chart.confidence);
      if (std::isnan(it.mean)) continue;
      const Place place = place_of(chart, frame, s, g);
      const Colour colour = colour_of(chart, s, g);
      const double top = frame.y(std::max(it.mean, 0.0)), bottom = frame.y(std::min(it.mean, 0.0));
      canvas.fill({place.middle - 0.5 * place.width, top, place.width, bottom - top},
                  colour.with_alpha(0.32));
      level(canvas, frame.y(it.mean), place.middle - 0.5 * place.width, place.middle + 0.5 * place.width,
            {colour, 3.0, {}});
      if (!std::isnan(it.low))
        interval_mark(canvas, place.middle, frame.y(it.low), frame.y(it.high),
                      std::min(9.0, 0.25 * place.width), {charts::kInk, 1.6, {}});
    }
  }
  if (frame.y.low < 0.0)
    level(canvas, frame.y(0.0), frame.area.x, frame.area.right(), {charts::kInk, 1.2, {}});
}

void draw_interaction(Canvas& canvas, const StatsChart& chart, const ChartFrame& frame) {
  // Series stand a little beside each other, so that no interval hides another.
  const double step = std::min(16.0, 0.5 * frame.slot / double(chart.series.size()));
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    const Colour colour = charts::series_colour(s);
    const double aside = step * (double(s) - 0.5 * (double(chart.series.size()) - 1.0));
    std::vector<Vector2> means;
    for (std::size_t g = 0; g < chart.groups.size(); ++g) {
      const ChartMean it = chart_mean(chart.values[s][g], chart.confidence);
      if (std::isnan(it.mean)) continue;
      const double x = frame.slot_middle(g) + aside;
      if (!std::isnan(it.low))
        interval_mark(canvas, x, frame.y(it.low), frame.y(it.high), 5.0, {colour.with_alpha(0.75), 1.7, {}});
      means.emplace_back(x, frame.y(it.mean));
    }
    canvas.line(means, {colour, 2.8, {}});
    for (const Vector2& mean : means) {
      canvas.fill_disc(mean, 6.4, charts::kPaper);
      canvas.fill_disc(mean, 5.2, colour);
    }
  }
}

namespace {

/// The line of least squares, and the figures for its interval.
struct Fit {
  double centre = 0.0, height = 0.0;  // means of x and y
  double slope = 0.0;
  double sxx = 0.0;    // squared deviations of x
  double error = 0.0;  // standard error of the estimate
  double count = 0.0;
  double at(double x) const { return height + slope * (x - centre); }
  /// Half the interval of the mean at `x`, for the quantile `t` of Student's distribution.
  double half(double x, double t) const {
    return t * error * std::sqrt(1.0 / count + (x - centre) * (x - centre) / sxx);
  }
};

Fit fit_of(const std::vector<Vector2>& points) {
  std::vector<double> xs, ys, products, squares;
  for (const Vector2& point : points) {
    xs.push_back(point.x());
    ys.push_back(point.y());
  }
  Fit fit;
  fit.count = double(points.size());
  fit.centre = stats::mean(xs);
  fit.height = stats::mean(ys);
  for (const Vector2& point : points) products.push_back((point.x() - fit.centre) * (point.y() - fit.height));
  fit.sxx = stats::squared_deviations(xs);
  fit.slope = stats::sum(products) / fit.sxx;
  for (const Vector2& point : points) {
    const double off = point.y() - fit.at(point.x());
    squares.push_back(off * off);
  }
  fit.error = std::sqrt(stats::sum(squares) / std::max(1.0, fit.count - 2.0));
  return fit;
}

void draw_fit(Canvas& canvas, const StatsChart& chart, const ChartFrame& frame, const Colour& colour) {
  const FittedLine line = fitted_line(chart);
  if (line.lower.empty()) return;
  const auto placed = [&](const Vector2& point) { return Vector2(frame.x(point.x()), frame.y(point.y())); };
  std::vector<Vector2> band;
  std::ranges::transform(line.upper, std::back_inserter(band), placed);
  std::transform(line.lower.rbegin(), line.lower.rend(), std::back_inserter(band), placed);
  canvas.fill_polygon(band, colour.with_alpha(0.15));
  const Vector2 ends[] = {placed(line.from), placed(line.to)};
  canvas.line(ends, {colour, 2.6, {}});
}

/// Red, paper, blue for -1, 0, 1.
Colour correlation_colour(double r) {
  const Colour end = r < 0.0 ? Colour{0.78, 0.28, 0.16} : charts::colour_of(charts::Hue::Blue);
  const double share = std::pow(std::min(1.0, std::abs(r)), 1.2);
  const auto mix = [&](double paper, double ink) { return paper + share * (ink - paper); };
  return {mix(0.965, end.red), mix(0.97, end.green), mix(0.975, end.blue)};
}

void draw_correlation(Canvas& canvas, const Area& cell, double r, double p) {
  if (std::isnan(r)) {
    canvas.fill(cell, charts::kGridLine);
    return;
  }
  const Colour colour = correlation_colour(r);
  canvas.fill(cell, colour);
  const Colour ink = charts::lightness(colour) > 0.66 ? charts::kInk : charts::kPaper;
  const char* const stars = p < 0.001 ? "***" : p < 0.01 ? "**" : p < 0.05 ? "*" : "";
  const double size = std::clamp(0.24 * cell.width, 6.0, 17.0);
  const double x = cell.x + 0.5 * cell.width, y = cell.y + 0.5 * cell.height;
  canvas.text({x, y + 0.36 * size}, with_minus(share_text(r)), {size, ink, false, 0.5});
  canvas.text({x, y + 1.3 * size}, stars, {0.8 * size, ink, false, 0.5});
}

}  // namespace

FittedLine fitted_line(const StatsChart& chart) {
  FittedLine line;
  if (!chart.line || chart.points.size() < 3) return line;
  const Fit fit = fit_of(chart.points);
  if (!(fit.sxx > 0.0)) return line;
  const auto [least, greatest] =
      std::ranges::minmax(chart.points, {}, [](const Vector2& p) { return p.x(); });
  const double t = stats::t_quantile(0.5 + 0.5 * chart.confidence, fit.count - 2.0);
  constexpr int kSteps = 60;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = least.x() + (greatest.x() - least.x()) * i / kSteps;
    line.lower.emplace_back(x, fit.at(x) - fit.half(x, t));
    line.upper.emplace_back(x, fit.at(x) + fit.half(x, t));
  }
  line.from = {least.x(), fit.at(least.x())};
  line.to = {greatest.x(), fit.at(greatest.x())};
  return line;
}

void draw_scatter(Canvas& canvas, const StatsChart& chart, const ChartFrame& frame) {
  canvas.clip({frame.area.x, frame.area.y - 4.0, frame.area.width, frame.area.height + 4.0});
  const Colour colour = charts::colour_of(charts::Hue::Blue);
  const bool thin = chart.points.size() > kMostPoints;
  const double alpha = chart.points.size() > 600 ? 0.35 : 0.6;
  std::set<std::pair<long, long>> drawn;
  for (const Vector2& point : chart.points) {
    const Vector2 at(frame.x(point.x()), frame.y(point.y()));
    if (thin && !drawn.emplace(std::lround(0.5 * at.x()), std::lround(0.5 * at.y())).second) continue;
    canvas.fill_disc(at, chart.points.size() > 600 ? 3.0 : 4.4, colour.with_alpha(alpha));
  }
  draw_fit(canvas, chart, frame, charts::colour_of(charts::Hue::Vermilion));
  canvas.unclip();
}

void draw_curve(Canvas& canvas, const StatsChart& chart, const ChartFrame& frame) {
  std::vector<Vector2> curve;
  for (const Vector2& point : chart.points) curve.emplace_back(frame.x(point.x()), frame.y(point.y()));
  canvas.clip({frame.area.x, frame.area.y - 4.0, frame.area.width, frame.area.height + 4.0});
  canvas.line(curve, {charts::colour_of(charts::Hue::Blue), 3.0, {}});
  canvas.unclip();
  for (const Vector2& mark : chart.marks) {
    const Vector2 at(frame.x(mark.x()), frame.y(mark.y()));
    const charts::Stroke guide{charts::kQuietInk, 1.2, {4.0, 5.0}};
    vertical(canvas, at.x(), at.y(), frame.area.bottom(), guide);
    level(canvas, at.y(), frame.area.x, at.x(), guide);
    canvas.fill_disc(at, 7.0, charts::kPaper);
    canvas.circle(at, 6.5, {charts::colour_of(charts::Hue::Vermilion), 2.8, {}});
    canvas.text({at.x() + 14.0, at.y() + 22.0},
                fmt::format("{:g}: {}", mark.x(), with_minus(share_text(mark.y(), 3))),
                {15.0, charts::kInk, true});
  }
}

void draw_shares(Canvas& canvas, const StatsChart& chart, const ChartFrame& frame) {
  const double width = std::min(0.7 * frame.slot, 150.0);
  const bool stacked = chart.series.size() > 1;
  for (std::size_t g = 0; g < chart.groups.size(); ++g) {
    double total = 0.0, below = 0.0;
    for (const auto& series : chart.values) total += series[g].empty() ? 0.0 : series[g].front();
    for (std::size_t s = 0; s < chart.series.size(); ++s) {
      const double count = chart.values[s][g].empty() ? 0.0 : chart.values[s][g].front();
      const double part = stacked ? count / std::max(total, 1e-300) : count;
      const double top = frame.y(below + part), bottom = frame.y(below);
      const double left = frame.slot_middle(g) - 0.5 * width;
      canvas.fill({left, top, width, bottom - top}, colour_of(chart, s, stacked ? g : 0).with_alpha(0.40));
      if (part > 0.0) level(canvas, top, left, left + width, {colour_of(chart, s, stacked ? g : 0), 2.0, {}});
      if (stacked && bottom - top > 18.0 && width > 24.0)
        canvas.text({frame.slot_middle(g), 0.5 * (top + bottom) + 5.0}, fmt::format("{:.10g}", count),
                    {14.0, charts::kInk, false, 0.5});
      below += part;
    }
  }
}

void draw_matrix(Canvas& canvas, const StatsChart& chart, const Area& area) {
  const auto count = double(chart.groups.size());
  constexpr double kNames = 190.0;
  const double side = std::min((area.height - 8.0) / count, (area.width - 2.0 * kNames) / count);
  const charts::TextStyle row{std::clamp(0.3 * side, 7.0, 15.5), charts::kInk, false, 1.0};
  const charts::TextStyle column{row.size, charts::kQuietInk};
  // Centred, unless the names of rows need the room that the names of columns leave.
  const double spare = area.width - count * side;
  double for_rows = 0.0, for_columns = 0.0;
  for (std::size_t i = 0; i < chart.groups.size(); ++i) {
    const double width = canvas.text_width(chart.groups[i], row) + 12.0;
    for_rows = std::max(for_rows, width);
    if (i + 1 < chart.groups.size()) for_columns = std::max(for_columns, width - (count - double(i)) * side);
  }
  const double left = area.x + std::max(0.5 * spare, std::min(for_rows, spare - for_columns));
  for (std::size_t i = 0; i < chart.groups.size(); ++i) {
    const double top = area.y + 4.0 + side * double(i), text = top + 0.5 * side + 0.36 * row.size;
    // The first name has no row, the last no column.
    if (i > 0)
      canvas.text({left - 12.0, text}, fitted(canvas, chart.groups[i], row, left - 12.0 - area.x), row);
    for (std::size_t k = 0; k < i; ++k)
      draw_correlation(canvas, {left + side * double(k) + 1.0, top + 1.0, side - 2.0, side - 2.0},
                       chart.matrix(Eigen::Index(i), Eigen::Index(k)),
                       chart.p(Eigen::Index(i), Eigen::Index(k)));
    const double x = left + side * double(i) + 6.0;
    if (i + 1 < chart.groups.size())
      canvas.text({x, text}, fitted(canvas, chart.groups[i], column, area.right() - x), column);
  }
}

}  // namespace icome::apps
