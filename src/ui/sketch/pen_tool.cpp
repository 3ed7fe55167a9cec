#include <QImage>
#include <optional>

#include "sketch/pen/running_stroke.h"
#include "ui/forms/colour_button.h"
#include "ui/sketch/canvas_tool.h"
#include "ui/sketch/stroke_picture.h"

namespace icome::ui {
namespace {

constexpr double kFrame = 0.016;           // s: how far the display runs ahead
constexpr double kFitError = 0.0001;       // m
constexpr double kMousePixelError = 0.8;   // pixels: a mouse has whole ones, whose stairs are no shape
constexpr double kTabletPixelError = 0.3;  // pixels
constexpr double kMmAMetre = 1000.0;

/// Draws strokes. While one is drawn, its finished segments are in a picture of their own, and only what is
/// after them is drawn at each move: a move costs the same, however long the stroke is.
class PenTool final : public CanvasTool {
 public:
  using CanvasTool::CanvasTool;

  void press(const PenInput& input) override;
  void drag(const PenInput& input) override;
  void release(const PenInput& input) override;
  void give_up() override;
  bool follows_all() const override { return true; }
  void paint(QPainter& painter, const QRect& part) override;

 private:
  sketch::FitSettings settings(const PenInput& input) const;
  sketch::PenSample sample(const PenInput& input) const;
  QPainterPath line(const drawing::Curve& curve) const;
  QPainterPath running_line() const;
  QPainterPath ahead_line() const;
  QRect on_screen(const QPainterPath& path) const;
  void dry_finished();
  void renew_running();

  std::optional<sketch::RunningStroke> stroke_;  // none: the pen is up
  sketch::FitSettings settings_;
  QImage dry_;             // the finished segments, opaque
  std::size_t dried_ = 0;  // how many there are in it
  QPainterPath running_;   // what is drawn after them, mm
  QRect running_box_;
};

sketch::FitSettings PenTool::settings(const PenInput& input) const {
  sketch::FitSettings wanted;
  wanted.error = std::max(kFitError, view().on_paper(input.is_pen ? kTabletPixelError : kMousePixelError));
  wanted.tip = look().tip;
  return wanted;
}

sketch::PenSample PenTool::sample(const PenInput& input) const {
  const double pressure = input.is_pen ? look().pressure(input.pressure) : input.pressure;
  return {input.time, input.place, pressure};
}

QPainterPath PenTool::line(const drawing::Curve& curve) const {
  return line_path(curve, drawing::CurveEnds::Round, view().on_paper(0.1));
}

QRect PenTool::on_screen(const QPainterPath& path) const {
  return view().screen_from_mm().mapRect(path.controlPointRect()).toAlignedRect().adjusted(-2, -2, 2, 2);
}

void PenTool::press(const PenInput& input) {
  settings_ = settings(input);
  stroke_.emplace(sample(input), settings_);
  dry_ = QImage((QSizeF(bench_.size()) * bench_.pixel_ratio()).toSize(), QImage::Format_ARGB32_Premultiplied);
  dry_.setDevicePixelRatio(bench_.pixel_ratio());
  dry_.fill(Qt::transparent);
  dried_ = 0;
  running_box_ = {};
  renew_running();
}

void PenTool::drag(const PenInput& input) {
  if (!stroke_) return;
  stroke_->add(sample(input));
  dry_finished();
  renew_running();
}

void PenTool::dry_finished() {
  if (dried_ == stroke_->finished()) return;
  QPainter painter(&dry_);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setTransform(view().screen_from_mm());
  QRect box;
  for (; dried_ < stroke_->finished(); ++dried_) {
    const QPainterPath path = line(stroke_->segment(dried_));
    painter.fillPath(path, screen_colour(look().colour));
    box |= on_screen(path);
  }
  bench_.redraw(box);
}

QPainterPath PenTool::running_line() const {
  QPainterPath path = line(stroke_->current());
  if (look().predict) path.addPath(ahead_line());
  return path;
}

/// From where the pen is to where it will be in a frame.
QPainterPath PenTool::ahead_line() const {
  const sketch::PenSample& last = stroke_->samples().back();
  const drawing::Vector2 there = stroke_->predicted(kFrame);
  if (there == last.place) return {};
  const double width = settings_.tip.width(last.pressure);
  drawing::Curve ahead;
  ahead.segments.push_back(drawing::CubicBezier::line(last.place, there));
  ahead.widths.push_back({0.0, width, 1.0, width});
  return line(ahead);
}

void PenTool::renew_running() {
  running_ = running_line();
  running_.setFillRule(Qt::WindingFill);
  const QRect box = on_screen(running_);
  bench_.redraw(box | running_box_);
  running_box_ = box;
}

void PenTool::release(const PenInput& /*input*/) {
  if (!stroke_) return;
  interaction::Value::List way;
  interaction::Value::List pressures;
  for (const sketch::PenSample& it : stroke_->samples()) {
    way.emplace_back(command_place(it.place));
    pressures.emplace_back(it.pressure);
  }
  stroke_.reset();
  redraw_all();
  document().perform(command("draw", {{"way", std::move(way)},
                                      {"pressures", std::move(pressures)},
                                      {"error", kMmAMetre * settings_.error},
                                      {"thinnest", kMmAMetre * settings_.tip.thinnest},
                                      {"widest", kMmAMetre * settings_.tip.widest},
                                      {"colour", command_colour(look().colour)},
                                      {"opacity", look().opacity},
                                      {"ends", look().ends == drawing::CurveEnds::Flat ? "flat" : "round"}}));
}

void PenTool::give_up() {
  stroke_.reset();
  redraw_all();
}

void PenTool::paint(QPainter& painter, const QRect& part) {
  if (!stroke_) return;
  // Line and overlap together, then laid over the drawing with the stroke's opacity.
  const double ratio = dry_.devicePixelRatio();
  const QRect pixels =
      QTransform::fromScale(ratio, ratio).mapRect(QRectF(part)).toAlignedRect() & dry_.rect();
  if (pixels.isEmpty()) return;
  QImage wet = dry_.copy(pixels);
  const QPointF corner = QPointF(pixels.topLeft()) / ratio;
  QPainter within(&wet);
  within.setRenderHint(QPainter::Antialiasing);
  within.setTransform(view().screen_from_mm() * QTransform::fromTranslate(-corner.x(), -corner.y()));
  within.fillPath(running_, screen_colour(look().colour));
  within.end();
  painter.setOpacity(look().opacity);
  painter.drawImage(corner, wet);
  painter.setOpacity(1.0);
}

}  // namespace

std::unique_ptr<CanvasTool> make_pen_tool(SketchBench& bench) { return std::make_unique<PenTool>(bench); }

}  // namespace icome::ui
