#include "render/pictures/touch_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "charts/canvas.h"
#include "charts/length_text.h"
#include "charts/palette.h"
#include "charts/plot.h"
#include "render/gl/offscreen.h"
#include "render/model/camera.h"
#include "render/pictures/path_trace.h"
#include "render/pictures/touch_solid.h"
#include "render/pictures/touch_view.h"

namespace icome::render {
namespace {

using base::Vector2;
using base::Vector3;

// The page: 1600 x 1200 units at the default size; other sizes scale it by the tighter side.
constexpr double kPageWidth = 1600.0;
constexpr double kPageHeight = 1200.0;
constexpr double kMargin = 56.0;
constexpr double kHeader = 124.0;
constexpr double kPlotHeight = 318.0;

const charts::Colour kTip{0.10, 0.42, 0.66};
const charts::Stroke kTipSeen{kTip, 1.8, {}};
const charts::Stroke kTipHidden{kTip.with_alpha(0.75), 1.7, {0.5, 5.0}};
const charts::Colour kBackground{0.985, 0.987, 0.99};
const charts::Colour kBackgroundEdge{0.90, 0.915, 0.935};

/// The facts of a session that the captions and axes need.
struct Summary {
  std::size_t ticks = 0;
  std::size_t touching = 0;
  std::optional<std::size_t> strongest;  ///< the touching sample with the greatest force
  double greatest = 0.0;                 ///< N, while touching
  double highest = 0.0;                  ///< N, of all: effects are felt in the air, too
  double first = 0.0, last = 0.0;        ///< s
};

Summary summarise(std::span<const TouchSample> samples) {
  Summary summary;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const TouchSample& sample = samples[i];
    if (!is_finite(sample)) continue;
    if (summary.ticks == 0) summary.first = sample.t;
    summary.last = std::max(summary.first, sample.t);
    ++summary.ticks;
    const double force = sample.force.stableNorm();
    summary.highest = std::max(summary.highest, force);
    if (!sample.touching) continue;
    ++summary.touching;
    if (!summary.strongest || force > summary.greatest) summary.strongest = i;
    summary.greatest = std::max(summary.greatest, force);
  }
  return summary;
}

std::string caption(const Summary& summary, double rate_hz) {
  if (summary.ticks == 0) return "no samples";
  std::string text = fmt::format("{} ticks", charts::grouped(summary.ticks));
  if (rate_hz > 0.0) text += fmt::format(" at {:g} Hz", rate_hz);
  text += fmt::format("  \u00b7  {:.2f} s", summary.last - summary.first);
  if (summary.touching == 0) return text + "  \u00b7  never touching";
  const double share = 100.0 * static_cast<double>(summary.touching) / static_cast<double>(summary.ticks);
  return text +
         fmt::format("  \u00b7  touching {:.3g} %  \u00b7  greatest force {:.3g} N", share, summary.greatest);
}

/// The end of the force axis and of the colours: the first tick at or above the highest force.
double force_range(double highest) {
  if (!(highest > 0.0)) return 1.0;
  const double step = charts::nice_ticks(0.0, highest, 5).step;
  return step * std::max(1.0, std::ceil(highest / step - 1e-9));
}

std::vector<charts::Colour> force_colours(double opacity) {
  std::vector<charts::Colour> colours;
  for (int i = 0; i <= 32; ++i) colours.push_back(charts::magnitude_colour(i / 32.0).with_alpha(opacity));
  return colours;
}

/// The page cut into its parts; the view's edges fall on whole pixels.
struct Layout {
  double scale;
  charts::Area view, plot;
  int view_width, view_height;  ///< pixels
};

Layout make_layout(const TouchPicture& picture) {
  const double scale = std::min(picture.width / kPageWidth, picture.height / kPageHeight);
  const double page_width = picture.width / scale;
  const double page_height = picture.height / scale;
  const int top = static_cast<int>(std::lround(kHeader * scale));
  const int bottom = static_cast<int>(std::lround((page_height - kPlotHeight) * scale));
  Layout layout{scale, {}, {}, picture.width, bottom - top};
  layout.view = {0.0, top / scale, page_width, layout.view_height / scale};
  layout.plot = {kMargin - 10.0, layout.view.bottom() + 16.0, page_width - 2.0 * kMargin + 16.0,
                 kPlotHeight - 26.0};
  return layout;
}

/// All that one picture is drawn from.
struct Scene {
  const TouchPicture& picture;
  Summary summary;
  Layout layout;
  double newtons;  ///< the end of the colours
  ModelBall ball;
  Camera camera;
};

/// The model's points and the part of the tip's path that stays about the model.
std::vector<Vector3> points_to_show(const TouchPicture& picture, std::vector<Vector3> points,
                                    const ModelBall& ball) {
  const bool have_model = !points.empty();
  for (const TouchSample& sample : picture.samples) {
    if (!is_finite(sample)) continue;
    const bool close = (sample.tip - ball.centre).stableNorm() < 1.4 * ball.radius;
    if (close || !have_model) points.push_back(sample.tip);
    if (sample.touching) points.push_back(sample.scp);
  }
  return points;
}

Scene make_scene(const TouchPicture& picture, std::span<const PreparedSolid> solids) {
  std::vector<Vector3> points = model_points(picture.bodies);
  for (const PreparedSolid& solid : solids) {
    const std::vector<Vector3> own = solid.points();
    points.insert(points.end(), own.begin(), own.end());
  }
  if (points.empty()) {  // nothing but effects: the tip's way is all there is to see
    for (const TouchSample& sample : picture.samples)
      if (is_finite(sample)) points.push_back(sample.tip);
  }
  const ModelBall ball = model_ball(points, picture.up);
  const Layout layout = make_layout(picture);
  FitOptions fit;
  fit.toward_eye = contact_direction(picture.samples, picture.up);
  fit.up = picture.up;
  fit.aspect = layout.view.width / layout.view.height;
  fit.margin_x = std::min(0.2, 190.0 / layout.view.width);
  fit.margin_y = 0.055;
  const Camera camera = fit_camera(points_to_show(picture, points, ball), fit);
  const Summary summary = summarise(picture.samples);
  return {picture, summary, layout, force_range(summary.highest), ball, camera};
}

base::Result<StudioPicture> photograph(const Scene& scene, const Offscreen& context,
                                       const StudioScene& models) {
  StudioSettings settings;
  settings.width = scene.layout.view_width;
  settings.height = scene.layout.view_height;
  settings.up = scene.picture.up;
  settings.centre = scene.ball.centre;
  settings.radius = scene.ball.radius;
  settings.floor = scene.ball.lowest;
  settings.background = kBackground;
  settings.background_edge = kBackgroundEdge;
  return draw_studio(context, models, scene.camera, settings);
}

std::vector<Vector2> page_points(std::span<const TracePoint> run) {
  std::vector<Vector2> points;
  for (const TracePoint& point : run) points.push_back(point.at);
  return points;
}

void draw_tip_path(charts::Canvas& canvas, const Scene& scene, const PlacedPicture& placed) {
  const auto samples = scene.picture.samples;
  const auto stretches = trace_path(placed, samples.size(), [&](std::size_t i) {
    return PathPoint{samples[i].tip, 0.0, is_finite(samples[i])};
  });
  for (const auto& stretch : stretches) {
    for (const auto run : visibility_runs(stretch)) {
      const bool visible = run.front().visible;
      canvas.line(page_points(run), visible ? kTipSeen : kTipHidden);
    }
  }
}

/// One run in the colours of its values, each segment in that of its end.
void draw_coloured(charts::Canvas& canvas, std::span<const TracePoint> run, double range, double width,
                   double opacity) {
  for (std::size_t i = 1; i < run.size(); ++i) {
    const Vector2 segment[] = {run[i - 1].at, run[i].at};
    canvas.line(segment, {charts::magnitude_colour(run[i].value / range).with_alpha(opacity), width, {}});
  }
  if (run.size() == 1)
    canvas.fill_disc(run[0].at, 0.5 * width, charts::magnitude_colour(run[0].value / range));
}

void draw_scp_path(charts::Canvas& canvas, const Scene& scene, const PlacedPicture& placed) {
  const auto samples = scene.picture.samples;
  const auto stretches = trace_path(placed, samples.size(), [&](std::size_t i) {
    const TouchSample& s = samples[i];
    return PathPoint{s.scp, s.force.stableNorm(), s.touching && is_finite(s)};
  });
  for (const auto& stretch : stretches) {
    for (const auto run : visibility_runs(stretch)) {
      if (run.front().visible) {
        canvas.line(page_points(run), {charts::kPaper.with_alpha(0.9), 8.0, {}});
      } else {
        canvas.line(page_points(run), {charts::Colour{0.35, 0.36, 0.40, 0.28}, 2.5, {}});
      }
    }
  }
  for (const auto& stretch : stretches) {
    for (const auto run : visibility_runs(stretch)) {
      if (run.front().visible) draw_coloured(canvas, run, scene.newtons, 5.0, 1.0);
    }
  }
}

/// A ring where the force was greatest, as on the plot.
void draw_strongest(charts::Canvas& canvas, const Scene& scene, const PlacedPicture& placed) {
  if (!scene.summary.strongest) return;
  const Vector3& scp = scene.picture.samples[*scene.summary.strongest].scp;
  const auto at = place_on_page(placed, scp);
  if (!at || !is_visible(placed, scp)) return;
  canvas.fill_disc(*at, 7.0, charts::kPaper);
  canvas.circle(*at, 7.0, {charts::kInk, 2.4, {}});
}

void draw_header(charts::Canvas& canvas, const Scene& scene) {
  const charts::TextStyle title{31.0, charts::kInk, true};
  const charts::TextStyle quiet{18.5, charts::kQuietInk};
  charts::TextStyle note = quiet;
  note.align = 1.0;
  const double right = canvas.width() - kMargin;
  const std::string head = charts::fitted(canvas, scene.picture.title, title, 0.62 * canvas.width());
  canvas.text({kMargin, 62.0}, head, title);
  const std::string below = caption(scene.summary, scene.picture.rate_hz);
  canvas.text({kMargin, 98.0}, charts::fitted(canvas, below, quiet, right - kMargin), quiet);
  const double left_ends[] = {kMargin + canvas.text_width(head, title),
                              kMargin + canvas.text_width(below, quiet)};
  const std::size_t count = std::min<std::size_t>(2, scene.picture.notes.size());
  for (std::size_t i = 0; i < count; ++i) {
    const double room = right - left_ends[i] - 30.0;
    canvas.text({right, 62.0 + 36.0 * static_cast<double>(i)},
                charts::fitted(canvas, scene.picture.notes[i], note, room), note);
  }
}

void draw_colour_bar(charts::Canvas& canvas, const Scene& scene) {
  const charts::Area& view = scene.layout.view;
  const double height = std::min(300.0, 0.5 * view.height);
  const charts::Area bar{view.right() - kMargin - 62.0, view.y + 74.0, 18.0, height};
  canvas.fill_gradient(bar, force_colours(1.0), true);
  const charts::Ticks ticks = charts::nice_ticks(0.0, scene.newtons, 5);
  for (const double value : ticks.at) {
    const double y = bar.bottom() - bar.height * value / scene.newtons;
    const Vector2 mark[] = {{bar.right() + 2.0, y}, {bar.right() + 7.0, y}};
    canvas.line(mark, {charts::kInk, 1.2, {}});
    canvas.text({bar.right() + 13.0, y + 5.8}, charts::tick_label(value, ticks.step), {16.0, charts::kInk});
  }
  canvas.text({bar.x + 9.0, bar.y - 18.0}, "force (N)", {17.0, charts::kInk, false, 0.5});
}

void draw_scale_bar(charts::Canvas& canvas, const Scene& scene, const PlacedPicture& placed) {
  const Vector3 side = scene.camera.camera_from_world.linear().row(0).transpose();
  const double reach = scene.ball.radius;
  const auto from = place_on_page(placed, scene.ball.centre);
  const auto to = place_on_page(placed, scene.ball.centre + reach * side);
  if (!from || !to) return;
  const double units_per_metre = (*to - *from).norm() / reach;
  const double metres = charts::nice_length_below(220.0 / units_per_metre);
  const double length = metres * units_per_metre;
  const double right = scene.layout.view.right() - kMargin;
  const double y = scene.layout.view.bottom() - 34.0;
  const Vector2 bar[] = {{right - length, y}, {right, y}};
  canvas.line(bar, {charts::kInk, 2.6, {}});
  for (const Vector2& end : bar) {
    const Vector2 tick[] = {{end.x(), y - 6.0}, {end.x(), y + 6.0}};
    canvas.line(tick, {charts::kInk, 2.0, {}});
  }
  canvas.text({right - 0.5 * length, y - 14.0}, charts::length_text(metres),
              {17.0, charts::kInk, false, 0.5});
}

/// One line of the legend: a sample of the stroke and what it stands for.
void draw_key(charts::Canvas& canvas, double y, const charts::Stroke& stroke, const std::string& text) {
  const Vector2 sample[] = {{kMargin, y}, {kMargin + 46.0, y}};
  canvas.line(sample, stroke);
  canvas.text({kMargin + 60.0, y + 5.8}, text, {17.0, charts::kInk});
}

void draw_legend(charts::Canvas& canvas, const Scene& scene) {
  if (scene.summary.ticks == 0) return;
  double y = scene.layout.view.bottom() - 34.0;
  draw_key(canvas, y, kTipHidden, "behind or inside the model");
  y -= 28.0;
  draw_key(canvas, y, kTipSeen, "path of the tip");
  if (scene.summary.touching == 0) return;
  y -= 28.0;
  const charts::Area swatch{kMargin, y - 2.5, 46.0, 5.0};
  canvas.fill({swatch.x - 1.5, swatch.y - 1.5, swatch.width + 3.0, swatch.height + 3.0}, charts::kPaper);
  canvas.fill_gradient(swatch, force_colours(1.0), false);
  canvas.text({kMargin + 60.0, y + 5.8}, "surface contact point", {17.0, charts::kInk});
  y -= 28.0;
  canvas.fill_disc({kMargin + 23.0, y}, 7.0, charts::kPaper);
  canvas.circle({kMargin + 23.0, y}, 7.0, {charts::kInk, 2.4, {}});
  canvas.text({kMargin + 60.0, y + 5.8}, "greatest force", {17.0, charts::kInk});
}

/// The stretches of time in which something is touched.
std::vector<charts::Span> touching_spans(std::span<const TouchSample> samples) {
  std::vector<charts::Span> spans;
  bool open = false;
  for (const TouchSample& sample : samples) {
    if (!is_finite(sample)) continue;
    if (sample.touching && !open) spans.push_back({sample.t, sample.t});
    if (open || sample.touching) spans.back().to = sample.t;
    open = sample.touching;
  }
  return spans;
}

void draw_force_plot(charts::Canvas& canvas, const Scene& scene) {
  const charts::Area& area = scene.layout.plot;
  if (scene.summary.ticks == 0) {
    canvas.text({area.x + 0.5 * area.width, area.y + 0.5 * area.height}, "no force to plot",
                {18.5, charts::kQuietInk, false, 0.5});
    return;
  }
  std::vector<Vector2> points;
  points.reserve(scene.picture.samples.size());
  for (const TouchSample& sample : scene.picture.samples) {
    if (is_finite(sample)) points.emplace_back(sample.t, sample.force.stableNorm());
  }
  charts::TimePlot plot;
  plot.x_label = "time (s)  \u2014  touching where shaded";
  plot.y_label = "force (N)";
  plot.points = points;
  plot.shaded = touching_spans(scene.picture.samples);
  const bool has_length = scene.summary.last > scene.summary.first;
  plot.x_range = has_length ? charts::Span{scene.summary.first, scene.summary.last}
                            : charts::Span{scene.summary.first, scene.summary.first + 1.0};
  plot.y_max = scene.newtons;
  plot.fill = force_colours(0.55);
  plot.mark_peak = scene.summary.strongest && scene.summary.greatest == scene.summary.highest;
  charts::draw_time_plot(canvas, area, plot);
}

void draw_view(charts::Canvas& canvas, const Scene& scene, const StudioPicture& photograph) {
  const charts::Area& view = scene.layout.view;
  canvas.image(photograph.image, view);
  const PlacedPicture placed{scene.camera, photograph, view, 0.012 * scene.ball.radius};
  canvas.clip(view);
  draw_tip_path(canvas, scene, placed);
  draw_scp_path(canvas, scene, placed);
  draw_strongest(canvas, scene, placed);
  canvas.unclip();
  if (scene.summary.touching > 0) draw_colour_bar(canvas, scene);
  draw_scale_bar(canvas, scene, placed);
  draw_legend(canvas, scene);
}

}  // namespace

base::Result<charts::Image> draw_touch_picture(const TouchPicture& picture) {
  constexpr int kLeast = 400;
  constexpr int kMost = 16384;
  if (std::min(picture.width, picture.height) < kLeast || std::max(picture.width, picture.height) > kMost) {
    return base::fail(fmt::format("a picture of {}x{} cannot be drawn; choose sides from {} to {} pixels",
                                  picture.width, picture.height, kLeast, kMost));
  }
  const auto context = Offscreen::create();
  if (!context) return base::fail(context.error().message);
  auto solids = prepare_solids(picture.solids);
  if (!solids) return base::fail(solids.error().message);
  const Scene scene = make_scene(picture, *solids);
  const double pixels = static_cast<double>(scene.layout.view_width) * scene.layout.view_height;
  StudioScene models{picture.bodies, {}};
  for (PreparedSolid& solid : *solids) {
    const auto placed = solid.place(models, *context, scene.camera, pixels, picture.tell);
    if (!placed) return base::fail(placed.error().message);
  }
  const auto view = photograph(scene, *context, models);
  if (!view) return base::fail(view.error().message);
  charts::Canvas canvas(picture.width, picture.height, scene.layout.scale);
  draw_view(canvas, scene, *view);
  draw_header(canvas, scene);
  draw_force_plot(canvas, scene);
  return canvas.snapshot();
}

base::Result<void> write_touch_picture(const TouchPicture& picture, const std::filesystem::path& path) {
  const auto image = draw_touch_picture(picture);
  if (!image) return base::fail(image.error().message);
  return charts::write_png(*image, path);
}

}  // namespace icome::render
