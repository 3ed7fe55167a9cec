#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/techniques/menus_report.h"
#include "apps/techniques/techniques_report.h"
#include "charts/canvas.h"
#include "charts/palette.h"
#include "charts/plot.h"

namespace icome::apps {
namespace {

using base::Vector2;
using charts::Area;
using charts::Canvas;
using interaction::ElementKind;
using study::MenuBenchResult;
using study::MenuConditionResult;
using study::MenuFeel;

constexpr int kMenusWidth = 1600, kMenusHeight = 1000;
constexpr double kMenusMargin = 56.0;
constexpr std::array kMenuKinds{ElementKind::Menu, ElementKind::Pie, ElementKind::Daisy};
constexpr std::array kMenuFeels{MenuFeel::None, MenuFeel::Well, MenuFeel::Recess, MenuFeel::Groove};

using Quantity = double (*)(const MenuConditionResult&);
double seconds_of(const MenuConditionResult& it) { return it.time.mean; }
double percent_of(const MenuConditionResult& it) { return 100.0 * it.error_rate; }

charts::Stroke stroke_of(MenuFeel feel, bool by_push) {
  const charts::Hue hues[] = {charts::Hue::Grey, charts::Hue::Blue, charts::Hue::Vermilion,
                              charts::Hue::Green};
  const std::vector<double> dashes = by_push ? std::vector<double>{9.0, 7.0} : std::vector<double>{};
  return {charts::colour_of(hues[std::size_t(feel)]), 3.0, dashes};
}

/// One plot: eight lines over the number of items, whose steps are drawn alike as their ratios are.
class MenusPlot {
 public:
  MenusPlot(Canvas& canvas, const Area& area, const MenuBenchResult& result, Quantity quantity, double most)
      : canvas_(canvas), area_(area), result_(result), quantity_(quantity), most_(most) {}

  void draw(ElementKind kind, const std::string& y_label) {
    draw_axes(y_label);
    for (const MenuFeel feel : kMenuFeels)
      for (const bool by_push : {false, true}) draw_line(kind, feel, by_push);
  }

 private:
  double x_of(std::size_t items) const {
    const double share = std::log(double(items) / 5.0) / std::log(40.0 / 5.0);
    return area_.x + (0.06 + 0.88 * share) * area_.width;
  }
  double y_of(double value) const { return area_.bottom() - area_.height * value / most_; }

  void draw_axes(const std::string& y_label) {
    const charts::Ticks ticks = charts::nice_ticks(0.0, most_, 5);
    for (const double value : ticks.at) {
      const Vector2 grid[] = {{area_.x, y_of(value)}, {area_.right(), y_of(value)}};
      canvas_.line(grid, {charts::kGridLine, 1.0, {}});
      canvas_.text({area_.x - 10.0, y_of(value) + 5.0}, charts::tick_label(value, ticks.step),
                   {14.0, charts::kInk, false, 1.0});
    }
    for (const std::size_t items : {5U, 12U, 40U})
      canvas_.text({x_of(items), area_.bottom() + 20.0}, fmt::format("{}", items),
                   {14.0, charts::kInk, false, 0.5});
    canvas_.text({area_.x + 0.5 * area_.width, area_.bottom() + 42.0}, "items",
                 {15.0, charts::kInk, false, 0.5});
    if (!y_label.empty())
      canvas_.text({area_.x - 52.0, area_.y + 0.5 * area_.height}, y_label,
                   {15.0, charts::kInk, false, 0.5, 0.5 * M_PI});
  }

  void draw_line(ElementKind kind, MenuFeel feel, bool by_push) {
    std::vector<Vector2> points;
    for (const MenuConditionResult& it : result_.conditions)
      if (it.condition.kind == kind && it.condition.feel == feel && it.condition.by_push == by_push)
        points.emplace_back(x_of(it.condition.items), y_of(quantity_(it)));
    const charts::Stroke stroke = stroke_of(feel, by_push);
    canvas_.line(points, stroke);
    for (const Vector2& point : points) {
      canvas_.fill_disc(point, 5.5, by_push ? charts::kPaper : stroke.colour);
      canvas_.circle(point, 5.5, {stroke.colour, 2.2, {}});
    }
  }

  Canvas& canvas_;
  Area area_;
  const MenuBenchResult& result_;
  Quantity quantity_;
  double most_;
};

double axis_end_of(const MenuBenchResult& result, Quantity quantity) {
  double greatest = 0.0;
  for (const MenuConditionResult& it : result.conditions) greatest = std::max(greatest, quantity(it));
  const double step = charts::nice_ticks(0.0, std::max(greatest, 1e-3), 5).step;
  return step * std::ceil(greatest / step + 1e-9);
}

void draw_key(Canvas& canvas, double y) {
  double x = kMenusMargin;
  for (const bool by_push : {false, true})
    for (const MenuFeel feel : kMenuFeels) {
      const Vector2 sample[] = {{x, y}, {x + 44.0, y}};
      canvas.line(sample, stroke_of(feel, by_push));
      const char* const feels[] = {"without feel", "well", "recess", "groove"};
      const std::string label = fmt::format("{}, {}", by_push ? "push" : "click", feels[std::size_t(feel)]);
      canvas.text({x + 54.0, y + 5.0}, label, {15.0, charts::kInk});
      x += 84.0 + canvas.text_width(label, {15.0, charts::kInk});
    }
}

}  // namespace

charts::Image draw_menus(const MenuBenchResult& result) {
  Canvas canvas(kMenusWidth, kMenusHeight, 1.0);
  canvas.text({kMenusMargin, 60.0}, "Choosing from menus that are felt, simulated",
              {31.0, charts::kInk, true});
  canvas.text({kMenusMargin, 94.0},
              fmt::format("{} simulated people \u00d7 {} choices in each condition \u00b7 seed {}",
                          result.settings.users, result.settings.trials, result.settings.seed),
              {18.0, charts::kQuietInk});
  draw_key(canvas, 130.0);
  const char* const titles[] = {"List", "Pie", "Daisy"};
  const double width = (kMenusWidth - 2.0 * kMenusMargin) / double(kMenuKinds.size());
  for (std::size_t i = 0; i < kMenuKinds.size(); ++i) {
    const double left = kMenusMargin + double(i) * width + 60.0;
    canvas.text({left, 186.0}, titles[i], {20.0, charts::kInk, true});
    MenusPlot(canvas, {left, 204.0, width - 90.0, 300.0}, result, seconds_of, axis_end_of(result, seconds_of))
        .draw(kMenuKinds[i], i == 0 ? "time (s)" : "");
    MenusPlot(canvas, {left, 586.0, width - 90.0, 270.0}, result, percent_of, axis_end_of(result, percent_of))
        .draw(kMenuKinds[i], i == 0 ? "errors (%)" : "");
  }
  canvas.fill({0.0, kMenusHeight - 50.0, double(kMenusWidth), 50.0}, charts::kPanel);
  canvas.text({kMenusMargin, kMenusHeight - 19.0},
              std::string("A simulation. ") + kSimulationNotice +
                  " The assumptions are listed by icome techniques --menus --json.",
              {16.0, charts::kQuietInk});
  return canvas.snapshot();
}

}  // namespace icome::apps
