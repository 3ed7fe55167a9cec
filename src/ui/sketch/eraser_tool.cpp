#include <optional>

#include "sketch/tools/eraser.h"
#include "ui/sketch/canvas_tool.h"

namespace icome::ui {
namespace {

/// Takes away what its circle passes over; what is gone is seen at once, and is one step to undo.
class EraserTool final : public CanvasTool {
 public:
  using CanvasTool::CanvasTool;

  void press(const PenInput& input) override {
    last_ = input.place;
    erase(input.place);
  }
  void drag(const PenInput& input) override { erase(input.place); }
  void release(const PenInput& /*input*/) override { document().keep(); }
  void hover(const PenInput& input) override { move_circle(input.place); }
  void paint(QPainter& painter, const QRect& /*part*/) override {
    if (!circle_) return;
    painter.setPen(overlay_pen(1.2));
    painter.setBrush(QColor(255, 255, 255, 90));
    const double radius = reach();
    painter.drawEllipse(view().to_screen(*circle_), radius, radius);
    painter.setBrush(Qt::NoBrush);
  }

 private:
  double reach() const { return look().eraser_radius / view().on_paper(1.0); }  // pixels

  void erase(const drawing::Vector2& to) {
    const drawing::Vector2 way[] = {last_, to};
    std::uint64_t next = document().shown().next_id;
    const auto edit =
        sketch::erased(document().shown(), way, look().eraser_radius, look().whole_strokes, next);
    last_ = to;
    if (!edit.empty()) document().try_more(edit);
    move_circle(to);
  }

  void move_circle(const drawing::Vector2& to) {
    if (circle_) bench_.redraw(circle_box());
    circle_ = to;
    bench_.redraw(circle_box());
  }

  QRect circle_box() const {
    const double side = reach() + 3.0;
    const QPointF middle = view().to_screen(*circle_);
    return QRectF(middle - QPointF(side, side), QSizeF(2.0 * side, 2.0 * side)).toAlignedRect();
  }

  drawing::Vector2 last_ = drawing::Vector2::Zero();
  std::optional<drawing::Vector2> circle_;  // none: the pen was not here yet
};

}  // namespace

std::unique_ptr<CanvasTool> make_eraser_tool(SketchBench& bench) {
  return std::make_unique<EraserTool>(bench);
}

}  // namespace icome::ui
