#include "ui/sketch/selection_frame.h"

#include <algorithm>
#include <cmath>

#include "sketch/tools/attraction.h"
#include "ui/look/handle_reach.h"
#include "ui/look/theme.h"
#include "ui/sketch/canvas_tool.h"

namespace icome::ui {
namespace {

constexpr double kBeside = 8.0;     // pixels between the points and the frame
constexpr double kKnobAway = 22.0;  // pixels above the frame
constexpr double kHandle = 4.0;     // half a corner's side, pixels
constexpr double kLeastScaling = 0.01;
constexpr std::size_t kMostDots = 3000;
constexpr double kGridStep = 0.005;       // m
constexpr double kAngleStep = 0.2617994;  // rad, 15 degrees
constexpr double kAngleWithin = 0.2 * kAngleStep;

constexpr drawing::Bounds2::CornerType kCorners[] = {drawing::Bounds2::BottomLeft,
                                                     drawing::Bounds2::BottomRight,
                                                     drawing::Bounds2::TopRight, drawing::Bounds2::TopLeft};

Eigen::Affine2d about_place(const drawing::Vector2& place, const Eigen::Matrix2d& linear) {
  return Eigen::Translation2d(place) * Eigen::Affine2d(linear) * Eigen::Translation2d(-place);
}

}  // namespace

SelectionFrame::SelectionFrame(const drawing::Bounds2& box, const PaperView& view)
    : box_(box), corner_(box.min()), view_(view) {
  const drawing::Vector2 beside = drawing::Vector2::Constant(view.on_paper(kBeside));
  box_ = {box.min() - beside, box.max() + beside};
}

std::optional<SelectionFrame> SelectionFrame::around(const drawing::Drawing& drawing,
                                                     const sketch::Selection& selection,
                                                     const PaperView& view) {
  const drawing::Bounds2 box = sketch::bounds_of(drawing, selection);
  if (box.isEmpty()) return std::nullopt;
  return SelectionFrame(box, view);
}

QPointF SelectionFrame::knob() const {
  const double away = view_.on_paper(kKnobAway);
  return view_.to_screen({box_.center().x(), box_.min().y() - away});
}

std::optional<SelectionFrame::Grip> SelectionFrame::grip(QPointF at, bool control) const {
  const drawing::Vector2 place = view_.to_paper(at);
  const drawing::Vector2 middle = box_.center();
  if (distance(at, knob()) < kHandleReach) return Grip{Part::Knob, place, middle, corner_};
  for (const auto corner : kCorners) {
    const drawing::Vector2 there = box_.corner(corner);
    if (distance(at, view_.to_screen(there)) < kHandleReach)
      return Grip{Part::Corner, place, 2.0 * middle - there, corner_};
  }
  if (!box_.contains(place)) return std::nullopt;
  return Grip{control ? Part::Similar : Part::Inside, place, middle, corner_};
}

Eigen::Affine2d SelectionFrame::moved(const Grip& grip, const drawing::Vector2& to) {
  const drawing::Vector2 before = grip.from - grip.about;
  const drawing::Vector2 now = to - grip.about;
  if (grip.part == Part::Inside || before.isZero() || now.isZero())
    return Eigen::Affine2d(Eigen::Translation2d(drawing::Vector2(to - grip.from)));
  const double angle = std::atan2(before.x() * now.y() - before.y() * now.x(), before.dot(now));
  const double scaling = std::max(kLeastScaling, now.norm() / before.norm());
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
  if (grip.part == Part::Knob) return about_place(grip.about, turn);
  if (grip.part == Part::Corner) return about_place(grip.about, scaling * Eigen::Matrix2d::Identity());
  return about_place(grip.about, scaling * turn);
}

Eigen::Affine2d SelectionFrame::attracted(const Grip& grip, const Eigen::Affine2d& moved, double within) {
  if (grip.part == Part::Inside) {
    const double reach = std::min(within, 0.5 * kGridStep);
    const drawing::Vector2 there = moved * grip.corner;
    const drawing::Vector2 drawn(sketch::attracted(there.x(), kGridStep, reach),
                                 sketch::attracted(there.y(), kGridStep, reach));
    return Eigen::Affine2d(Eigen::Translation2d(drawn - there)) * moved;
  }
  if (grip.part != Part::Knob) return moved;
  const double angle = Eigen::Rotation2Dd(moved.linear()).angle();
  const double drawn = sketch::attracted(angle, kAngleStep, kAngleWithin);
  return about_place(grip.about, Eigen::Rotation2Dd(drawn).toRotationMatrix());
}

void SelectionFrame::paint(QPainter& painter) const {
  QPolygonF around;
  for (const auto corner : kCorners) around << view_.to_screen(box_.corner(corner));
  QPen dashed = overlay_pen(1.0);
  dashed.setStyle(Qt::DashLine);
  painter.setPen(dashed);
  painter.drawPolygon(around);
  painter.setPen(overlay_pen(1.2));
  painter.drawLine(view_.to_screen({box_.center().x(), box_.min().y()}), knob());
  painter.setBrush(Qt::white);
  for (const QPointF& corner : around)
    painter.drawRect(QRectF(corner - QPointF(kHandle, kHandle), QSizeF(2.0 * kHandle, 2.0 * kHandle)));
  painter.drawEllipse(knob(), kHandle, kHandle);
  painter.setBrush(Qt::NoBrush);
}

void paint_selection(QPainter& painter, const drawing::Drawing& drawing, const sketch::Selection& selection,
                     const PaperView& view) {
  std::size_t dots = 0;
  painter.setPen(Qt::NoPen);
  painter.setBrush(colours_of_light().accent);
  for (const auto& [id, chosen] : selection) {
    const drawing::Stroke* const stroke = drawing.find(id);
    if (stroke == nullptr || chosen.size() != 3 * stroke->curve.segments.size() + 1) continue;
    for (std::size_t i = 0; i < chosen.size() && dots < kMostDots; ++i) {
      if (!chosen[i]) continue;
      const std::size_t segment = std::min(i / 3, stroke->curve.segments.size() - 1);
      const double radius = i % 3 == 0 ? 2.6 : 1.6;  // the ends of segments stand out
      painter.drawEllipse(view.to_screen(stroke->curve.segments[segment].points[i - 3 * segment]), radius,
                          radius);
      ++dots;
    }
    if (dots >= kMostDots) break;
  }
  painter.setBrush(Qt::NoBrush);
  painter.setPen(overlay_pen());
  if (dots < kMostDots) {
    for (const drawing::Vector2& place : sketch::holding_points(drawing, selection))
      painter.drawEllipse(view.to_screen(place), 5.0, 5.0);
  }
}

}  // namespace icome::ui
