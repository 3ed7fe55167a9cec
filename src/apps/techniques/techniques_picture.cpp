#include "apps/techniques/techniques_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/techniques/techniques_report.h"
#include "charts/canvas.h"
#include "charts/palette.h"
#include "charts/plot.h"

namespace icome::apps {
namespace {

using base::Vector2;
using charts::Area;
using charts::Canvas;
using charts::Colour;
using charts::Hue;
using interaction::BenchResult;
using interaction::ConditionResult;
using interaction::Selecting;
using interaction::TechniqueResult;

constexpr int kPageWidth = 1600;
constexpr int kPageHeight = 1240;
constexpr double kPageMargin = 56.0;

Colour technique_colour(Selecting selecting) {
  switch (selecting) {
    case Selecting::VirtualHand:
      return charts::colour_of(Hue::Orange);
    case Selecting::GoGo:
      return charts::colour_of(Hue::Vermilion);
    case Selecting::RayPointer:
      return charts::colour_of(Hue::Blue);
    case Selecting::Spotlight:
      return charts::colour_of(Hue::Sky);
    case Selecting::Miniature:
      return charts::colour_of(Hue::Green);
    case Selecting::LookAt:
      return charts::colour_of(Hue::Purple);
  }
  return charts::kInk;
}

std::string capitalised(std::string_view name) {
  std::string text(name);
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = char(text[0] - 'a' + 'A');
  return text;
}

void panel_title(Canvas& canvas, const Area& area, const std::string& title, const std::string& below) {
  canvas.text({area.x, area.y + 20.0}, title, {21.0, charts::kInk, true});
  canvas.text({area.x, area.y + 44.0}, below, {15.5, charts::kQuietInk});
}

/// Maps a quantity to a stretch of the page.
struct PageScale {
  double low, high, from, to;
  double operator()(double value) const { return from + (to - from) * (value - low) / (high - low); }
};

/// The end of an axis: the next tick above the greatest value.
double axis_end(double greatest) {
  const double step = charts::nice_ticks(0.0, std::max(greatest, 1e-3), 5).step;
  return step * std::ceil(greatest / step + 1e-9);
}

// ------------------------------------------------------------ the ranking

/// A disc for the nearest distance, a ring within for farther ones.
void distance_mark(Canvas& canvas, const Vector2& at, std::size_t which, const Colour& colour) {
  canvas.fill_disc(at, 7.5, charts::kPaper);
  if (which == 0) {
    canvas.fill_disc(at, 6.5, colour);
  } else {
    canvas.circle(at, 5.6, {colour, 2.4, {}});
    if (which == 1) canvas.fill_disc(at, 2.6, colour);
  }
}

double greatest_throughput(const BenchResult& result) {
  double greatest = 0.0;
  for (const TechniqueResult& technique : result.techniques)
    for (const double distance : result.settings.distances)
      greatest = std::max(greatest, throughput_at(technique, distance).value_or(0.0));
  return greatest;
}

void ranking_row(Canvas& canvas, const BenchResult& result, std::size_t rank, double y, double height,
                 const PageScale& scale) {
  const TechniqueResult& technique = result.techniques[rank];
  const Colour colour = technique_colour(technique.selecting);
  const double middle = y + 0.5 * height;
  canvas.text({scale.from - 16.0, middle - 1.0}, capitalised(name_of(technique.selecting)),
              {18.0, charts::kInk, true, 1.0});
  const std::string figures =
      technique.reached == 0
          ? std::string("out of reach")
          : fmt::format("{:.2f} s   {:.1f} % errors", technique.time.mean, 100.0 * technique.error_rate);
  canvas.text({scale.from - 16.0, middle + 19.0}, figures, {13.5, charts::kQuietInk, false, 1.0});
  canvas.fill({scale.from, middle - 12.0, scale(technique.score) - scale.from, 24.0},
              colour.with_alpha(0.28));
  const Vector2 end[] = {{scale(technique.score), middle - 15.0}, {scale(technique.score), middle + 15.0}};
  canvas.line(end, {colour, 3.0, {}});
  for (std::size_t i = result.settings.distances.size(); i-- > 0;) {
    const auto throughput = throughput_at(technique, result.settings.distances[i]);
    if (throughput) distance_mark(canvas, {scale(*throughput), middle}, i, colour);
  }
}

void draw_ranking(Canvas& canvas, const Area& area, const BenchResult& result) {
  panel_title(canvas, area, "Ranking",
              "bar: mean over all conditions, none for what is out of reach; marks: by distance");
  const PageScale scale{0.0, axis_end(greatest_throughput(result)), area.x + 212.0, area.right() - 20.0};
  const double top = area.y + 96.0, bottom = area.bottom() - 56.0;
  const charts::Ticks ticks = charts::nice_ticks(0.0, scale.high, 6);
  for (const double value : ticks.at) {
    const Vector2 grid[] = {{scale(value), top}, {scale(value), bottom}};
    canvas.line(grid, {charts::kGridLine, 1.0, {}});
    canvas.text({scale(value), bottom + 22.0}, charts::tick_label(value, ticks.step),
                {15.0, charts::kInk, false, 0.5});
  }
  canvas.text({0.5 * (scale.from + scale.to), bottom + 46.0}, "effective throughput (bit/s)",
              {16.0, charts::kInk, false, 0.5});
  const double height = (bottom - top) / double(result.techniques.size());
  for (std::size_t i = 0; i < result.techniques.size(); ++i)
    ranking_row(canvas, result, i, top + height * double(i), height, scale);
  double x = scale.from;
  for (std::size_t i = 0; i < result.settings.distances.size(); ++i) {
    const std::string label = fmt::format("{:g} m", result.settings.distances[i]);
    distance_mark(canvas, {x + 8.0, area.y + 74.0}, i, charts::kInk);
    canvas.text({x + 22.0, area.y + 79.5}, label, {15.0, charts::kInk});
    x += 46.0 + canvas.text_width(label, {15.0, charts::kInk});
  }
}

// ------------------------------------------------------------ time over difficulty

struct Extent {
  double least_id = 1e9, greatest_id = 0.0, greatest_time = 0.0;
};

Extent extent_of_laws(const BenchResult& result) {
  Extent extent;
  for (const TechniqueResult& technique : result.techniques) {
    for (const ConditionResult& it : technique.conditions) {
      extent.least_id = std::min(extent.least_id, it.id);
      extent.greatest_id = std::max(extent.greatest_id, it.id);
      if (it.reachable) extent.greatest_time = std::max(extent.greatest_time, it.time.mean);
    }
  }
  return extent;
}

void law_axes(Canvas& canvas, const Area& frame, const PageScale& x, const PageScale& y) {
  const charts::Ticks times = charts::nice_ticks(0.0, y.high, 6);
  for (const double value : times.at) {
    const Vector2 grid[] = {{frame.x, y(value)}, {frame.right(), y(value)}};
    canvas.line(grid, {charts::kGridLine, 1.0, {}});
    canvas.text({frame.x - 10.0, y(value) + 5.4}, charts::tick_label(value, times.step),
                {15.0, charts::kInk, false, 1.0});
  }
  const charts::Ticks ids = charts::nice_ticks(x.low, x.high, 7);
  for (const double value : ids.at)
    canvas.text({x(value), frame.bottom() + 22.0}, charts::tick_label(value, ids.step),
                {15.0, charts::kInk, false, 0.5});
  const Vector2 base[] = {{frame.x, frame.bottom()}, {frame.right(), frame.bottom()}};
  canvas.line(base, {charts::kInk, 1.2, {}});
  canvas.text({frame.x + 0.5 * frame.width, frame.bottom() + 46.0}, "index of difficulty (bit)",
              {16.0, charts::kInk, false, 0.5});
  canvas.text({frame.x - 46.0, frame.y + 0.5 * frame.height}, "movement time (s)",
              {16.0, charts::kInk, false, 0.5, 0.5 * M_PI});
}

void law_of(Canvas& canvas, const TechniqueResult& technique, const PageScale& x, const PageScale& y) {
  const Colour colour = technique_colour(technique.selecting);
  double least = 1e9, greatest = 0.0;
  for (const ConditionResult& it : technique.conditions) {
    if (!it.reachable) continue;
    canvas.fill_disc({x(it.id), y(it.time.mean)}, 4.0, colour.with_alpha(0.45));
    least = std::min(least, it.id);
    greatest = std::max(greatest, it.id);
  }
  if (!technique.line) return;
  const auto at = [&](double id) {
    return Vector2(x(id), y(technique.line->intercept + technique.line->slope * id));
  };
  const Vector2 line[] = {at(least), at(greatest)};
  canvas.line(line, {charts::kPaper.with_alpha(0.85), 6.0, {}});
  canvas.line(line, {colour, 3.0, {}});
}

void draw_laws(Canvas& canvas, const Area& area, const BenchResult& result) {
  panel_title(canvas, area, "Movement time over difficulty",
              "a dot is a condition; lines by least squares, MT = a + b ID");
  const Area frame{area.x + 62.0, area.y + 64.0, area.width - 330.0, area.height - 120.0};
  const Extent extent = extent_of_laws(result);
  const PageScale x{std::floor(extent.least_id), std::ceil(extent.greatest_id), frame.x, frame.right()};
  const PageScale y{0.0, axis_end(extent.greatest_time), frame.bottom(), frame.y};
  law_axes(canvas, frame, x, y);
  canvas.clip({frame.x - 6.0, frame.y - 6.0, frame.width + 12.0, frame.height + 6.0});
  for (const TechniqueResult& technique : result.techniques) law_of(canvas, technique, x, y);
  canvas.unclip();
  double row = frame.y + 18.0;
  for (const TechniqueResult& technique : result.techniques) {
    const Vector2 sample[] = {{frame.right() + 30.0, row - 5.0}, {frame.right() + 58.0, row - 5.0}};
    canvas.line(sample, {technique_colour(technique.selecting), 3.5, {}});
    canvas.text({frame.right() + 70.0, row}, capitalised(name_of(technique.selecting)),
                {16.0, charts::kInk, true});
    const std::string law =
        technique.line ? fmt::format("{:.2f} {} {:.2f} ID   r\u00b2 {:.2f}", technique.line->intercept,
                                     technique.line->slope < 0.0 ? "\u2212" : "+",
                                     std::abs(technique.line->slope), technique.line->r_squared)
                       : std::string("no line");
    canvas.text({frame.right() + 70.0, row + 20.0}, law, {14.0, charts::kQuietInk});
    row += 56.0;
  }
}

// ------------------------------------------------------------ every condition

struct TimeRange {
  double least = 1e9, greatest = 0.0;

  /// 1 for the quickest; logarithmic, as a second more is much for a short time and little for a long one.
  double quickness(double time) const {
    if (!(greatest > least)) return 1.0;
    return std::log(greatest / time) / std::log(greatest / least);
  }
};

TimeRange time_range(const BenchResult& result) {
  TimeRange range;
  for (const TechniqueResult& technique : result.techniques) {
    for (const ConditionResult& it : technique.conditions) {
      if (!it.reachable) continue;
      range.least = std::min(range.least, it.time.mean);
      range.greatest = std::max(range.greatest, it.time.mean);
    }
  }
  return range;
}

Colour time_colour(const TimeRange& range, double time) {
  return charts::magnitude_colour(0.12 + 0.83 * range.quickness(time));
}

void condition_cell(Canvas& canvas, const Area& cell, const ConditionResult& it, const TimeRange& range) {
  const Area inner{cell.x + 1.0, cell.y + 1.0, cell.width - 2.0, cell.height - 2.0};
  const Vector2 middle(cell.x + 0.5 * cell.width, cell.y + 0.5 * cell.height + 5.0);
  if (!it.reachable) {
    canvas.fill(inner, {0.925, 0.93, 0.94});
    canvas.text(middle, "\u2013", {14.0, charts::kQuietInk, false, 0.5});
    return;
  }
  const Colour colour = time_colour(range, it.time.mean);
  canvas.fill(inner, colour);
  const Colour ink = charts::lightness(colour) > 0.6 ? charts::kInk : charts::kPaper;
  canvas.text(middle, fmt::format("{:.1f}", it.time.mean), {14.0, ink, false, 0.5});
  // Each dot stands for a started 5 % of errors, up to four dots.
  const int dots = std::min(4, int(std::ceil(20.0 * it.error_rate - 1e-9)));
  for (int i = 0; i < dots; ++i) canvas.fill_disc({inner.right() - 4.5 - 6.0 * i, inner.y + 5.0}, 1.9, ink);
}

/// Conditions are in the order of distances, sizes and distractors.
void condition_grid(Canvas& canvas, const Area& area, const BenchResult& result,
                    const TechniqueResult& technique, const TimeRange& range) {
  const auto& settings = result.settings;
  const std::size_t sizes = settings.sizes.size(), densities = settings.distractors.size();
  constexpr double kGap = 8.0;
  const double left = area.x + 52.0;
  const double block = (area.right() - left + kGap) / double(settings.distances.size());
  const double width = (block - kGap) / double(densities);
  const double top = area.y + 58.0;
  const double height = (area.bottom() - top) / double(sizes);
  canvas.fill_disc({area.x + 7.0, area.y + 10.0}, 6.5, technique_colour(technique.selecting));
  canvas.text({area.x + 20.0, area.y + 16.0}, capitalised(name_of(technique.selecting)),
              {17.0, charts::kInk, true});
  for (std::size_t s = 0; s < sizes; ++s)
    canvas.text({left - 8.0, top + height * (double(s) + 0.5) + 5.0},
                fmt::format("{:g} cm", 100.0 * settings.sizes[s]), {13.5, charts::kQuietInk, false, 1.0});
  for (std::size_t d = 0; d < settings.distances.size(); ++d) {
    const double x = left + block * double(d);
    canvas.text({x + 0.5 * (block - kGap), area.y + 36.0}, fmt::format("{:g} m", settings.distances[d]),
                {13.5, charts::kInk, false, 0.5});
    for (std::size_t n = 0; n < densities; ++n) {
      canvas.text({x + width * (double(n) + 0.5), area.y + 53.0}, fmt::format("+{}", settings.distractors[n]),
                  {12.0, charts::kQuietInk, false, 0.5});
      for (std::size_t s = 0; s < sizes; ++s)
        condition_cell(canvas, {x + width * double(n), top + height * double(s), width, height},
                       technique.conditions[(d * sizes + s) * densities + n], range);
    }
  }
}

void time_key(Canvas& canvas, const Area& area, const TimeRange& range) {
  std::vector<Colour> colours;
  for (int i = 0; i <= 32; ++i) {
    const double time = range.greatest * std::pow(range.least / range.greatest, 1.0 - i / 32.0);
    colours.push_back(time_colour(range, time));
  }
  canvas.fill_gradient(area, colours, false);
  canvas.text({area.x - 10.0, area.y + 12.0}, fmt::format("{:.1f} s", range.least),
              {14.0, charts::kInk, false, 1.0});
  canvas.text({area.right() + 10.0, area.y + 12.0}, fmt::format("{:.1f} s", range.greatest),
              {14.0, charts::kInk});
}

void draw_conditions(Canvas& canvas, const Area& area, const BenchResult& result) {
  panel_title(canvas, area, "Every condition",
              "mean movement time (s) by target size, distance and distractors around each target; a dot for "
              "every started 5 % of errors; \u2013: cannot be selected");
  const TimeRange range = time_range(result);
  if (range.greatest > 0.0) time_key(canvas, {area.right() - 270.0, area.y + 6.0, 200.0, 14.0}, range);
  constexpr std::size_t kColumns = 3;
  constexpr double kColumnGap = 34.0, kRowGap = 20.0;
  const std::size_t rows = (result.techniques.size() + kColumns - 1) / kColumns;
  const double width = (area.width - kColumnGap * (kColumns - 1)) / kColumns;
  const double height = (area.height - 62.0 - kRowGap * double(rows - 1)) / double(rows);
  for (std::size_t i = 0; i < result.techniques.size(); ++i) {
    const Area cell{area.x + (width + kColumnGap) * double(i % kColumns),
                    area.y + 62.0 + (height + kRowGap) * double(i / kColumns), width, height};
    condition_grid(canvas, cell, result, result.techniques[i], range);
  }
}

void draw_head(Canvas& canvas, const BenchResult& result) {
  canvas.text({kPageMargin, 60.0}, "Selecting with six techniques, simulated", {31.0, charts::kInk, true});
  const auto& settings = result.settings;
  canvas.text({kPageMargin, 94.0},
              fmt::format("{} simulated people \u00d7 {} movements \u00d7 {} conditions with every technique "
                          "\u00b7 seed {}",
                          settings.users, settings.trials, result.techniques.front().conditions.size(),
                          settings.seed),
              {18.0, charts::kQuietInk});
}

}  // namespace

charts::Image draw_techniques(const BenchResult& result) {
  Canvas canvas(kPageWidth, kPageHeight, 1.0);
  const double wide = kPageWidth - 2.0 * kPageMargin;
  draw_head(canvas, result);
  draw_ranking(canvas, {kPageMargin, 128.0, 690.0, 500.0}, result);
  draw_laws(canvas, {kPageMargin + 740.0, 128.0, wide - 740.0, 500.0}, result);
  draw_conditions(canvas, {kPageMargin, 664.0, wide, 500.0}, result);
  canvas.fill({0.0, kPageHeight - 50.0, double(kPageWidth), 50.0}, charts::kPanel);
  canvas.text({kPageMargin, kPageHeight - 19.0},
              std::string("A simulation. ") + kSimulationNotice +
                  " The assumptions are listed by icome techniques --json.",
              {16.0, charts::kQuietInk});
  return canvas.snapshot();
}

}  // namespace icome::apps
