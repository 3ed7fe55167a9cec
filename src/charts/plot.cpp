#include "charts/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace icome::charts {
namespace {

using base::Vector2;

constexpr double kTextSize = 16.0;

/// Maps the plotted quantities to places on the page.
struct Axes {
  Area frame;
  Span x_range;
  double y_max;

  double x(double value) const {
    return frame.x + frame.width * (value - x_range.from) / (x_range.to - x_range.from);
  }
  double y(double value) const { return frame.bottom() - frame.height * value / y_max; }
};

/// The lowest and highest of the points that fall on one column of the page, in the order they came.
struct Column {
  int index = -1;
  Vector2 low, high;

  void add(const Vector2& p) {
    if (p.y() < low.y()) low = p;
    if (p.y() > high.y()) high = p;
  }
  void append_to(std::vector<Vector2>& line) const {
    const bool low_first = low.x() <= high.x();
    line.push_back(low_first ? low : high);
    if (low != high) line.push_back(low_first ? high : low);
  }
};

/// The points on the page: at most two for each half page unit, so that no peak is lost.
std::vector<Vector2> thinned(const Axes& axes, std::span<const Vector2> points) {
  std::vector<Vector2> line;
  Column column;
  for (const Vector2& point : points) {
    if (!point.allFinite()) continue;
    const Vector2 at(axes.x(point.x()), axes.y(point.y()));
    const int index = static_cast<int>(std::clamp(2.0 * (at.x() - axes.frame.x), 0.0, 1e6));
    if (index == column.index) {
      column.add(at);
      continue;
    }
    if (column.index >= 0) column.append_to(line);
    column = {index, at, at};
  }
  if (column.index >= 0) column.append_to(line);
  return line;
}

void draw_x_axis(Canvas& canvas, const Axes& axes, const std::string& label) {
  const Ticks ticks = nice_ticks(axes.x_range.from, axes.x_range.to, 10);
  const double base = axes.frame.bottom();
  for (const double value : ticks.at) {
    const Vector2 mark[] = {{axes.x(value), base}, {axes.x(value), base + 5.0}};
    canvas.line(mark, {kAxisInk, 1.0, {}});
    canvas.text({axes.x(value), base + 24.0}, tick_label(value, ticks.step),
                {kTextSize, kAxisInk, false, 0.5});
  }
  canvas.text({axes.frame.x + 0.5 * axes.frame.width, base + 50.0}, label,
              {kTextSize + 1.0, kAxisInk, false, 0.5});
  const Vector2 line[] = {{axes.frame.x, base}, {axes.frame.right(), base}};
  canvas.line(line, {kAxisInk, 1.2, {}});
}

void draw_y_axis(Canvas& canvas, const Axes& axes, const std::string& label) {
  const Ticks ticks = nice_ticks(0.0, axes.y_max, 5);
  for (const double value : ticks.at) {
    const Vector2 grid[] = {{axes.frame.x, axes.y(value)}, {axes.frame.right(), axes.y(value)}};
    if (value > 0.0) canvas.line(grid, {kGridLine, 1.0, {}});
    canvas.text({axes.frame.x - 10.0, axes.y(value) + 0.36 * kTextSize}, tick_label(value, ticks.step),
                {kTextSize, kAxisInk, false, 1.0});
  }
  canvas.text({axes.frame.x - 58.0, axes.frame.y + 0.5 * axes.frame.height}, label,
              {kTextSize + 1.0, kAxisInk, false, 0.5, 0.5 * M_PI});
}

void draw_shades(Canvas& canvas, const Axes& axes, const std::vector<Span>& shaded) {
  for (const Span& span : shaded) {
    const double from = std::max(axes.x(span.from), axes.frame.x);
    const double to = std::min(axes.x(span.to), axes.frame.right());
    if (to >= from) canvas.fill({from, axes.frame.y, std::max(to - from, 0.5), axes.frame.height}, kShade);
  }
}

void draw_line(Canvas& canvas, const Axes& axes, const TimePlot& plot) {
  const std::vector<Vector2> line = thinned(axes, plot.points);
  if (line.empty()) return;
  if (!plot.fill.empty()) {
    std::vector<Vector2> area = line;
    area.emplace_back(line.back().x(), axes.frame.bottom());
    area.emplace_back(line.front().x(), axes.frame.bottom());
    canvas.fill_gradient(area, axes.frame, plot.fill);
  }
  canvas.line(line, {plot.line, 1.6, {}});
  if (!plot.mark_peak) return;
  const auto peak = std::min_element(line.begin(), line.end(),
                                     [](const Vector2& a, const Vector2& b) { return a.y() < b.y(); });
  canvas.fill_disc(*peak, 5.5, kPaper);
  canvas.circle(*peak, 5.5, {plot.line, 2.0, {}});
}

}  // namespace

Ticks nice_ticks(double low, double high, int count) {
  const double range = high - low;
  if (!(range > 0.0) || !std::isfinite(range) || count < 1) return {1.0, {low}};
  const double rough = range / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double ratio = rough / power;
  Ticks ticks;
  ticks.step = power * (ratio <= 1.5 ? 1.0 : ratio <= 3.5 ? 2.0 : ratio <= 7.5 ? 5.0 : 10.0);
  const double slack = 1e-9 * ticks.step;
  for (double n = std::ceil(low / ticks.step - 1e-9); n * ticks.step <= high + slack; n += 1.0) {
    ticks.at.push_back(n * ticks.step);
    // Beyond the digits of a double the steps no longer move.
    if (n + 1.0 == n) break;
  }
  return ticks;
}

std::string tick_label(double value, double step) {
  constexpr int kMostDigits = 17;  // of a double
  const double size = std::abs(value);
  // Very small and very large steps read better as powers of ten.
  const bool plain = step < 1e6 && step > 0.9e-6;
  const auto decimals = static_cast<int>(std::ceil(-std::log10(step) - 1e-9));
  const double steps = std::max(1.0, size / step);
  const int figures = std::clamp(2 + static_cast<int>(std::log10(steps)), 3, kMostDigits);
  const std::string digits =
      plain ? fmt::format("{:.{}f}", size, std::max(0, decimals)) : fmt::format("{:.{}g}", size, figures);
  const bool zero = digits.find_first_of("123456789") == std::string::npos;
  return fmt::format("{}{}", std::signbit(value) && !zero ? "\u2212" : "", digits);
}

void draw_time_plot(Canvas& canvas, const Area& area, const TimePlot& plot) {
  const Area frame{area.x + 78.0, area.y + 12.0, area.width - 84.0, area.height - 72.0};
  const Axes axes{frame, plot.x_range, plot.y_max};
  draw_shades(canvas, axes, plot.shaded);
  draw_y_axis(canvas, axes, plot.y_label);
  draw_line(canvas, axes, plot);
  draw_x_axis(canvas, axes, plot.x_label);
}

}  // namespace icome::charts
