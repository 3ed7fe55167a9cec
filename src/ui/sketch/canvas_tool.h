#pragma once
#include <QPainter>
#include <functional>
#include <memory>

#include "sketch/feel/resistance.h"
#include "ui/sketch/paper_view.h"
#include "ui/sketch/sketch_document.h"
#include "ui/sketch/sketch_look.h"

namespace icome::ui {

/// One report of a pen or mouse over the paper.
struct PenInput {
  QPointF at;              // on the canvas
  drawing::Vector2 place;  // on the paper, m
  double time = 0.0;       // s, from any start
  double pressure = 0.5;   // 0 to 1
  double tilt = 0.0;       // of a pen, rad from upright
  bool is_pen = false;     // else it feels no pressure
  Qt::KeyboardModifiers modifiers = {};
};

/// The things that tools work on; all outlive them.
struct SketchBench {
  SketchDocument& document;
  const SketchLook& look;
  const PaperView& view;
  std::function<void(const QRect&)> redraw;  // a part of the canvas whose overlay has changed
  std::function<QSize()> size;               // of the canvas
  std::function<double()> pixel_ratio;
};

/// A tool of the canvas: what is pressed, dragged and let go becomes commands and edits of the document.
class CanvasTool {
 public:
  explicit CanvasTool(SketchBench& bench) : bench_(bench) {}
  virtual ~CanvasTool() = default;
  CanvasTool(const CanvasTool&) = delete;
  CanvasTool& operator=(const CanvasTool&) = delete;

  virtual void press(const PenInput& input) = 0;
  virtual void drag(const PenInput& input) = 0;
  virtual void release(const PenInput& input) = 0;
  virtual void hover(const PenInput& /*input*/) {}
  /// Leaves the drawing as it was before the press.
  virtual void give_up() { bench_.document.give_up(); }
  /// The grip of the pen on the drawing, for how that feels; none while nothing is held.
  virtual sketch::ToolGrip grip() const { return {}; }
  /// Does it need each reading of a pen, or only where it is when the screen is drawn?
  virtual bool follows_all() const { return false; }
  /// Draws what belongs to the tool over the drawing, at least within `part` of the canvas.
  virtual void paint(QPainter& /*painter*/, const QRect& /*part*/) {}

 protected:
  SketchDocument& document() const { return bench_.document; }
  const SketchLook& look() const { return bench_.look; }
  const PaperView& view() const { return bench_.view; }
  void redraw_all() const { bench_.redraw(QRect(QPoint(), bench_.size())); }

  SketchBench& bench_;
};

std::unique_ptr<CanvasTool> make_pen_tool(SketchBench& bench);
std::unique_ptr<CanvasTool> make_eraser_tool(SketchBench& bench);
std::unique_ptr<CanvasTool> make_pull_tool(SketchBench& bench);
std::unique_ptr<CanvasTool> make_lasso_tool(SketchBench& bench);
std::unique_ptr<CanvasTool> make_select_tool(SketchBench& bench);
std::unique_ptr<CanvasTool> make_width_tool(SketchBench& bench);
std::unique_ptr<CanvasTool> make_connect_tool(SketchBench& bench);
std::unique_ptr<CanvasTool> make_fill_tool(SketchBench& bench);

/// The distance from a line at which a pen still takes it, pixels.
inline constexpr double kTakenWithin = 12.0;

/// The line in which overlays are drawn, in the theme's accent: on white paper in either theme.
QPen overlay_pen(double width = 1.5);
/// An arrow for a force (N) on the pen.
void paint_force(QPainter& painter, QPointF at, const drawing::Vector2& force, const PaperView& view);

}  // namespace icome::ui
