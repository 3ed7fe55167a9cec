#include <algorithm>
#include <cmath>

#include "ui/cutout/stage/stage_view.h"
#include "ui/look/theme.h"

namespace icome::ui {
namespace {

using animation::Affine2;
using animation::Vector2;

constexpr double kJointRadius = 4.5;   // pixels
constexpr double kAxisReach = 10'000;  // px of the stage: beyond every edge

/// Draws constraints of one kind after the other.
class ConstraintPainter {
 public:
  ConstraintPainter(QPainter& painter, const CutoutDocument& document, const Affine2& map)
      : painter_(painter), document_(document), map_(map) {}

  void paint(const animation::Constraint& constraint) {
    const auto cells = animation::cells_of(constraint);
    const bool is_chosen =
        std::ranges::any_of(cells, [&](CellId cell) { return document_.is_selected(cell); });
    colour_ = is_chosen ? colours().accent : colours().link_text;
    colour_.setAlphaF(is_chosen ? 1.0F : 0.55F);
    std::visit([this](const auto& what) { paint_one(what); }, constraint.what);
  }

 private:
  std::optional<QPointF> on_screen(CellId id, const animation::PointOnCell& point) const {
    const animation::Cell* const cell = document_.project().find(id);
    const auto state = document_.shown().find(id);
    if (cell == nullptr || state == document_.shown().end()) return std::nullopt;
    return point_of(map_ * (animation::stage_from_picture(*cell, state->second) * point));
  }
  void line(double width, Qt::PenStyle style = Qt::SolidLine) {
    painter_.setPen(QPen(colour_, width, style, Qt::RoundCap, Qt::RoundJoin));
    painter_.setBrush(Qt::NoBrush);
  }
  void dot(QPointF at, double radius) {
    painter_.setPen(QPen(Qt::white, 1.2));
    painter_.setBrush(colour_);
    painter_.drawEllipse(at, radius, radius);
  }

  void paint_one(const animation::Joint& joint) {
    if (const auto at = on_screen(joint.child, joint.on_child)) dot(*at, kJointRadius);
  }
  void paint_one(const animation::Chain& chain) {
    QPolygonF way;
    for (std::size_t i = 1; i < chain.cells.size(); ++i)
      for (const animation::Constraint& constraint : document_.project().constraints) {
        const auto* const joint = std::get_if<animation::Joint>(&constraint.what);
        if (joint == nullptr || joint->child != chain.cells[i] || joint->parent != chain.cells[i - 1])
          continue;
        if (const auto at = on_screen(joint->child, joint->on_child)) way << *at;
      }
    if (!chain.cells.empty()) {
      const animation::Cell* const last = document_.project().find(chain.cells.back());
      if (last != nullptr)
        if (const auto at = on_screen(last->id, last->pivot)) way << *at;
    }
    line(2.4);
    painter_.drawPolyline(way);
  }
  void paint_one(const animation::DistanceLimit& limit) {
    const auto one = on_screen(limit.one, limit.on_one), other = on_screen(limit.other, limit.on_other);
    if (!one || !other) return;
    line(1.6, limit.least == limit.greatest ? Qt::SolidLine : Qt::DashLine);
    painter_.drawLine(*one, *other);
    dot(*one, 0.7 * kJointRadius);
    dot(*other, 0.7 * kJointRadius);
  }
  void paint_one(const animation::PathGuide& guide) {
    QPolygonF way;
    for (const Vector2& place : guide.way) way << point_of(map_ * place);
    line(1.8);
    guide.closed ? painter_.drawPolygon(way) : painter_.drawPolyline(way);
    if (const auto at = on_screen(guide.cell, guide.on_cell)) dot(*at, 0.8 * kJointRadius);
  }
  void paint_one(const animation::AxisGuide& guide) {
    const Vector2 way(std::cos(guide.direction), -std::sin(guide.direction));
    line(1.4, Qt::DashDotLine);
    painter_.drawLine(point_of(map_ * (guide.through - kAxisReach * way)),
                      point_of(map_ * (guide.through + kAxisReach * way)));
    if (const auto at = on_screen(guide.cell, guide.on_cell)) dot(*at, 0.8 * kJointRadius);
  }

  QPainter& painter_;
  const CutoutDocument& document_;
  const Affine2& map_;
  QColor colour_;
};

}  // namespace

void paint_constraints(QPainter& painter, const CutoutDocument& document, const Affine2& screen_from_stage) {
  ConstraintPainter it(painter, document, screen_from_stage);
  for (const animation::Constraint& constraint : document.project().constraints) it.paint(constraint);
}

}  // namespace icome::ui
