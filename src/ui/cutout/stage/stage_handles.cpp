#include "ui/cutout/stage/stage_handles.h"

#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <set>

#include "ui/look/handle_reach.h"
#include "ui/look/theme.h"

namespace icome::ui {
namespace {

using animation::Affine2;
using animation::Cell;
using animation::CellState;
using animation::Hold;
using animation::Vector2;

constexpr double kHandleSide = 8.0;   // pixels
constexpr double kTurnStalk = 26.0;   // pixels from the frame to the handle that turns
constexpr double kPivotRadius = 5.5;  // pixels
constexpr double kSmallestFactor = 0.01;
constexpr double kStrictTurn = M_PI / 12.0;

/// A turn, counter-clockwise as seen, where y goes down.
Vector2 turned_as_seen(const Vector2& way, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * way.x() + s * way.y(), c * way.y() - s * way.x()};
}

double angle_as_seen(const Vector2& way) { return std::atan2(-way.y(), way.x()); }

/// Cells that are selected and may be moved, without those that hang on another of them and come along.
std::vector<CellId> movable_cells(const CutoutDocument& document) {
  const animation::Project& project = document.project();
  std::set<CellId> selected;
  for (const CellId cell : document.selection())
    if (!is_locked(project, cell)) selected.insert(cell);
  const auto parent_of = [&](CellId cell) -> CellId {
    for (const animation::Constraint& constraint : project.constraints)
      if (const auto* joint = std::get_if<animation::Joint>(&constraint.what); joint && joint->child == cell)
        return joint->parent;
    return {};
  };
  std::vector<CellId> free;
  for (const CellId cell : selected) {
    CellId above = parent_of(cell);
    for (std::size_t steps = 0; above && !selected.contains(above) && steps < animation::kMostCells; ++steps)
      above = parent_of(above);
    if (!above || !selected.contains(above)) free.push_back(cell);
  }
  return free;
}

bool hangs_on_joint(const animation::Project& project, CellId cell) {
  return std::ranges::any_of(project.constraints, [&](const animation::Constraint& constraint) {
    const auto* const joint = std::get_if<animation::Joint>(&constraint.what);
    return joint != nullptr && joint->child == cell;
  });
}

Vector2 middle_of(const CellStates& states, const std::vector<CellId>& cells) {
  Vector2 sum = Vector2::Zero();
  double count = 0;
  for (const CellId cell : cells) {
    const auto found = states.find(cell);
    if (found == states.end()) continue;
    sum += found->second.place;
    count += 1;
  }
  return count > 0 ? Vector2(sum / count) : sum;
}

}  // namespace

std::optional<std::array<Vector2, 4>> corners_of(CutoutDocument& document, CellId id) {
  const Cell* const cell = document.project().find(id);
  const auto found = document.shown().find(id);
  if (cell == nullptr || found == document.shown().end()) return std::nullopt;
  const CellState& state = found->second;
  if (id != animation::kCamera) return animation::outline_of(*cell, state, document.pictures());
  if (state.scale <= 0) return std::nullopt;
  const animation::Stage& stage = document.project().stage;
  const Vector2 half = 0.5 / state.scale * Vector2(stage.width, stage.height);
  std::array<Vector2, 4> corners = {Vector2(-half.x(), -half.y()), Vector2(half.x(), -half.y()), half,
                                    Vector2(-half.x(), half.y())};
  for (Vector2& corner : corners) corner = state.place + turned_as_seen(corner, state.angle);
  return corners;
}

std::optional<HandleFrame> handle_frame(CutoutDocument& document, const Affine2& screen_from_stage) {
  const auto& selection = document.selection();
  HandleFrame frame;
  if (selection.size() == 1) {
    const auto corners = corners_of(document, selection.front());
    if (!corners) return std::nullopt;
    for (std::size_t i = 0; i < 4; ++i) frame.corners[i] = point_of(screen_from_stage * (*corners)[i]);
    frame.pivot = point_of(screen_from_stage * document.shown().at(selection.front()).place);
  } else {
    QRectF around;
    for (const CellId cell : selection) {
      const auto corners = corners_of(document, cell);
      if (!corners) continue;
      QPolygonF polygon;
      for (const Vector2& corner : *corners) polygon << point_of(screen_from_stage * corner);
      around = around.united(polygon.boundingRect());
    }
    if (around.isNull()) return std::nullopt;
    frame.corners = {around.topLeft(), around.topRight(), around.bottomRight(), around.bottomLeft()};
  }
  frame.top = 0.5 * (frame.corners[0] + frame.corners[1]);
  QPointF way = frame.top - 0.5 * (frame.corners[2] + frame.corners[3]);
  const double length = std::hypot(way.x(), way.y());
  way = length > 1e-6 ? way / length : QPointF(0, -1);
  frame.turn = frame.top + kTurnStalk * way;
  return frame;
}

StageGrip grip_at(const HandleFrame& frame, QPointF at, bool takes_pivot) {
  if (takes_pivot && frame.pivot && distance(*frame.pivot, at) <= kHandleReach) return StageGrip::Pivot;
  if (distance(frame.turn, at) <= kHandleReach) return StageGrip::Turn;
  for (const QPointF& corner : frame.corners)
    if (distance(corner, at) <= kHandleReach) return StageGrip::Scale;
  const QPolygonF polygon(QList<QPointF>(frame.corners.begin(), frame.corners.end()));
  return polygon.containsPoint(at, Qt::OddEvenFill) ? StageGrip::Move : StageGrip::None;
}

void paint_handles(QPainter& painter, const HandleFrame& frame, StageGrip under_pointer) {
  const ThemeColours& theme = colours();
  const auto pen = [&](const QColor& colour, double width) {
    QPen line(colour, width);
    line.setJoinStyle(Qt::MiterJoin);
    return line;
  };
  // A light line under the accent's, so that it is seen on any picture.
  const QPolygonF polygon(QList<QPointF>(frame.corners.begin(), frame.corners.end()));
  painter.setBrush(Qt::NoBrush);
  for (const auto& [colour, width] :
       {std::pair(QColor(255, 255, 255, 150), 3.0), std::pair(theme.accent, 1.4)}) {
    painter.setPen(pen(colour, width));
    painter.drawPolygon(polygon);
    painter.drawLine(frame.top, frame.turn);
  }
  const auto dress = [&](StageGrip grip) {
    painter.setPen(pen(theme.accent, 1.4));
    painter.setBrush(grip == under_pointer ? theme.accent : QColor(Qt::white));
  };
  dress(StageGrip::Scale);
  for (const QPointF& corner : frame.corners)
    painter.drawRect(
        QRectF(corner - 0.5 * QPointF(kHandleSide, kHandleSide), QSizeF(kHandleSide, kHandleSide)));
  dress(StageGrip::Turn);
  painter.drawEllipse(frame.turn, 0.55 * kHandleSide, 0.55 * kHandleSide);
  if (!frame.pivot) return;
  dress(StageGrip::Pivot);
  painter.drawEllipse(*frame.pivot, kPivotRadius, kPivotRadius);
  painter.setPen(pen(under_pointer == StageGrip::Pivot ? QColor(Qt::white) : theme.accent, 1.2));
  const QPointF across(kPivotRadius + 3.0, 0.0), down(0.0, kPivotRadius + 3.0);
  painter.drawLine(*frame.pivot - across, *frame.pivot + across);
  painter.drawLine(*frame.pivot - down, *frame.pivot + down);
}

StageDrag begin_drag(const CutoutDocument& document, StageGrip grip, const Vector2& from) {
  return {grip, document.shown(), from, middle_of(document.shown(), movable_cells(document))};
}

std::vector<Hold> dragged(const CutoutDocument& document, const StageDrag& drag, const Vector2& to,
                          bool strict) {
  Vector2 way = to - drag.from;
  if (strict && drag.grip == StageGrip::Move) (std::abs(way.x()) > std::abs(way.y()) ? way.y() : way.x()) = 0;
  const Vector2 arm_before = drag.from - drag.middle, arm = to - drag.middle;
  double turn = arm.isZero() || arm_before.isZero() ? 0.0 : angle_as_seen(arm) - angle_as_seen(arm_before);
  turn = std::remainder(turn, 2 * M_PI);
  if (strict) turn = kStrictTurn * std::round(turn / kStrictTurn);
  const double factor =
      arm_before.norm() > 1e-9 ? std::max(kSmallestFactor, arm.norm() / arm_before.norm()) : 1.0;
  std::vector<Hold> holds;
  for (const CellId id : movable_cells(document)) {
    const auto found = drag.start.find(id);
    const Cell* const cell = document.project().find(id);
    if (found == drag.start.end() || cell == nullptr) continue;
    Hold hold{.cell = id, .wish = found->second};
    CellState& wish = hold.wish;
    const Vector2 out = wish.place - drag.middle;
    switch (drag.grip) {
      case StageGrip::Move:
        wish.place += way;
        if (hangs_on_joint(document.project(), id))
          hold.pulled = animation::stage_from_picture(*cell, found->second).inverse() * drag.from;
        break;
      case StageGrip::Turn:
        wish.place = drag.middle + turned_as_seen(out, turn);
        wish.angle += turn;
        break;
      case StageGrip::Scale:
        wish.place = drag.middle + factor * out;
        // A camera that sees more has a smaller picture of it.
        wish.scale = id == animation::kCamera ? wish.scale / factor : wish.scale * factor;
        break;
      case StageGrip::Pivot:
      case StageGrip::None:
        break;
    }
    holds.push_back(std::move(hold));
  }
  return holds;
}

std::vector<Hold> nudged(const CutoutDocument& document, const Vector2& by) {
  StageDrag drag = begin_drag(document, StageGrip::Move, Vector2::Zero());
  // Pulled where it lies.
  if (!document.selection().empty()) {
    const auto found = drag.start.find(document.selection().back());
    if (found != drag.start.end()) drag.from = found->second.place;
  }
  return dragged(document, drag, drag.from + by, false);
}

std::optional<interaction::Value> pivot_command(const CutoutDocument& document, CellId id,
                                                const Vector2& place) {
  const Cell* const cell = document.project().find(id);
  const auto found = document.shown().find(id);
  if (cell == nullptr || found == document.shown().end() || id == animation::kCamera) return std::nullopt;
  const Vector2 pivot = animation::on_cell(*cell, found->second, place);
  return cutout_command("change-cell", {{"cell", cell->name}, {"pivot", command_point(pivot)}});
}

}  // namespace icome::ui
