// Lasso and select by touching: a drag beside the selection chooses, one of its frame changes it.
#include <QPainterPath>
#include <cmath>
#include <optional>

#include "ui/sketch/canvas_tool.h"
#include "ui/sketch/selection_frame.h"

namespace icome::ui {
namespace {

constexpr double kTouchWithin = 5.0;  // pixels beside a line that touches it
constexpr double kMmInAMetre = 1000.0;
constexpr double kWayStep = 1.5;           // pixels between places of a way that are kept
constexpr double kAttractedWithin = 10.0;  // pixels beside a line of the grid

class SelectingTool final : public CanvasTool {
 public:
  SelectingTool(SketchBench& bench, bool lasso) : CanvasTool(bench), lasso_(lasso) {}

  void press(const PenInput& input) override;
  void drag(const PenInput& input) override;
  void release(const PenInput& input) override;
  void give_up() override;
  sketch::ToolGrip grip() const override;
  void paint(QPainter& painter, const QRect& part) override;

 private:
  std::optional<SelectionFrame> frame() const {
    return SelectionFrame::around(document().shown(), document().selection(), view());
  }
  void choose(bool add);
  Eigen::Affine2d dragged() const;
  void paint_way(QPainter& painter) const;
  void attract(sketch::ToolGrip& held) const;

  bool lasso_;
  std::optional<SelectionFrame::Grip> grip_;
  std::vector<drawing::Vector2> holding_;  // what holds the selection back, when it was taken
  std::vector<drawing::Vector2> way_;      // of the lasso or the touching; empty: nothing is chosen now
  PenInput now_;
};

void SelectingTool::press(const PenInput& input) {
  now_ = input;
  const bool add = input.modifiers & Qt::ShiftModifier;
  const auto around = frame();
  if (around && !add) grip_ = around->grip(input.at, input.modifiers & Qt::ControlModifier);
  if (grip_) holding_ = sketch::holding_points(document().drawing(), document().selection());
  if (!grip_) way_ = {input.place};
  redraw_all();
}

void SelectingTool::drag(const PenInput& input) {
  now_ = input;
  if (grip_) {
    document().try_out(sketch::transformed(document().drawing(), document().selection(), dragged()));
  } else if (!way_.empty() && (input.place - way_.back()).norm() > view().on_paper(kWayStep)) {
    way_.push_back(input.place);
  }
  redraw_all();
}

/// The transform of what is selected, as the grip is now.
Eigen::Affine2d SelectingTool::dragged() const {
  const Eigen::Affine2d to = SelectionFrame::moved(*grip_, now_.place);
  return look().attract ? SelectionFrame::attracted(*grip_, to, view().on_paper(kAttractedWithin)) : to;
}

void SelectingTool::release(const PenInput& input) {
  if (grip_) {
    grip_.reset();
    document().keep();
  } else if (!way_.empty()) {
    choose(input.modifiers & Qt::ShiftModifier);
  }
  way_.clear();
  redraw_all();
}

/// A lasso that was only clicked touches, so that a click always takes what it points at.
void SelectingTool::choose(bool add) {
  interaction::Value::List places;
  for (const drawing::Vector2& place : way_) places.emplace_back(command_place(place));
  interaction::Value::Fields fields = {{"way", std::move(places)}, {"add", add}};
  const bool goes_round = lasso_ && way_.size() > 2;
  if (!goes_round) fields.emplace_back("within", kMmInAMetre * view().on_paper(kTouchWithin));
  document().perform(command(goes_round ? "lasso" : "touch", std::move(fields)));
}

void SelectingTool::give_up() {
  grip_.reset();
  way_.clear();
  CanvasTool::give_up();
  redraw_all();
}

/// The grip that holds back what is dragged (thesis 4.15 and its analogues), and what attracts it.
sketch::ToolGrip SelectingTool::grip() const {
  using Part = SelectionFrame::Part;
  sketch::ToolGrip held;
  if (!grip_) return held;
  held.start = grip_->from;
  held.centre = grip_->about;
  double distances = 0.0;
  for (const drawing::Vector2& point : holding_) distances += (point - grip_->about).norm();
  if (grip_->part == Part::Inside) held.holding = double(holding_.size());
  if (grip_->part == Part::Knob || grip_->part == Part::Similar) held.turned = distances;
  if (grip_->part == Part::Corner || grip_->part == Part::Similar) held.scaled = distances;
  attract(held);
  return held;
}

/// To where the pen would be if the selection lay on the grid, or at the angle, that attracts it.
void SelectingTool::attract(sketch::ToolGrip& held) const {
  if (!look().attract) return;
  const Eigen::Affine2d to = SelectionFrame::moved(*grip_, now_.place);
  const drawing::Vector2 drawn = dragged() * to.inverse() * now_.place;
  const drawing::Vector2 way = drawn - now_.place;
  constexpr double kNoWay = 1e-9;  // m
  if (way.norm() < kNoWay) return;
  held.end = drawn;
  held.within = view().on_paper(kAttractedWithin);
  if (grip_->part != SelectionFrame::Part::Inside)
    held.free = (now_.place - grip_->about).normalized();
  else if (std::abs(way.x()) < kNoWay)
    held.free = drawing::Vector2::UnitX();
  else if (std::abs(way.y()) < kNoWay)
    held.free = drawing::Vector2::UnitY();
}

void SelectingTool::paint_way(QPainter& painter) const {
  QPolygonF line;
  for (const drawing::Vector2& place : way_) line << view().to_screen(place);
  QPen pen = overlay_pen();
  if (lasso_) pen.setStyle(Qt::DashLine);
  painter.setPen(pen);
  if (lasso_) {
    QColor wash = pen.color();
    wash.setAlphaF(0.08F);
    painter.setBrush(wash);
    painter.drawPolygon(line);
    painter.setBrush(Qt::NoBrush);
  } else {
    painter.drawPolyline(line);
  }
}

void SelectingTool::paint(QPainter& painter, const QRect& /*part*/) {
  if (!way_.empty()) return paint_way(painter);
  if (const auto around = frame()) around->paint(painter);
}

}  // namespace

std::unique_ptr<CanvasTool> make_lasso_tool(SketchBench& bench) {
  return std::make_unique<SelectingTool>(bench, true);
}
std::unique_ptr<CanvasTool> make_select_tool(SketchBench& bench) {
  return std::make_unique<SelectingTool>(bench, false);
}

}  // namespace icome::ui
