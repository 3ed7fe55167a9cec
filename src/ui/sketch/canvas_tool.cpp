#include "ui/sketch/canvas_tool.h"

#include <QPainterPath>
#include <cmath>

#include "ui/look/theme.h"

namespace icome::ui {
namespace {

constexpr double kArrowLength = 60.0;  // pixels for a newton
constexpr double kArrowHead = 8.0;     // pixels
constexpr double kLeastArrow = 3.0;    // pixels: shorter ones are not seen

}  // namespace

QPen overlay_pen(double width) {
  return {colours_of_light().accent, width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin};
}

void paint_force(QPainter& painter, QPointF at, const drawing::Vector2& force, const PaperView& view) {
  // Through the view without its zoom: the arrow turns with the paper.
  const QPointF way = QTransform().rotate(view.turned()).map(QPointF(force.x(), force.y())) * kArrowLength;
  const double length = std::hypot(way.x(), way.y());
  if (length < kLeastArrow) return;
  const QPointF end = at + way;
  const QPointF back = way * (kArrowHead / length);
  const QPointF side(-0.5 * back.y(), 0.5 * back.x());
  painter.setPen(QPen(colours_of_light().bad, 2.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawLine(at, end);
  painter.setBrush(colours_of_light().bad);
  painter.drawPolygon(QPolygonF{end, end - back + side, end - back - side});
  painter.setBrush(Qt::NoBrush);
}

}  // namespace icome::ui
