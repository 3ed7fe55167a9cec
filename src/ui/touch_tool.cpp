#include "ui/touch_tool.h"

#include <QRectF>
#include <algorithm>
#include <cmath>

namespace icome::ui {

void TouchTool::enter(const QSizeF& scene) {
  if (active_) return;
  active_ = true;
  if (!QRectF(QPointF(), scene).contains(input_.at) || input_.at.isNull())
    input_.at = {0.5 * scene.width(), 0.5 * scene.height()};
  input_.size = scene;
}

void TouchTool::leave() {
  if (!active_) return;
  active_ = false;
  pressure_ = wheel_ = 0.0;
  session_.park_hand();
}

bool TouchTool::step(int key, bool fine) {
  const double right = key == Qt::Key_Right ? 1.0 : key == Qt::Key_Left ? -1.0 : 0.0;
  const double down = key == Qt::Key_Down ? 1.0 : key == Qt::Key_Up ? -1.0 : 0.0;
  if (right == 0.0 && down == 0.0) return false;
  const double pixels = fine ? 1.0 : 8.0;
  input_.at.setX(std::clamp(input_.at.x() + pixels * right, 0.0, input_.size.width()));
  input_.at.setY(std::clamp(input_.at.y() + pixels * down, 0.0, input_.size.height()));
  return true;
}

/// Has something been in the way for a while that no button presses against? Then the hand is lifted like a
/// pen, and comes again from the eye, from where all that the mouse can point at is free to reach.
bool TouchTool::is_stuck(const interaction::MouseHand::Input& input, const base::Vector3& target) {
  constexpr double kFar = 0.1;   // of the view's width at the target
  constexpr int kPatience = 30;  // ticks
  const double width = input.view_width * (target - input.ray.origin).norm();
  const bool is_away = input.pressure <= 0.0 && input.hand && (*input.hand - target).norm() > kFar * width;
  away_ticks_ = is_away ? away_ticks_ + 1 : 0;
  if (away_ticks_ < kPatience) return false;
  away_ticks_ = 0;
  return true;
}

void TouchTool::tick() {
  if (!active_) return;
  const interaction::View& view = session_.view();
  interaction::MouseHand::Input input;
  input.ray = input_.ray(view);
  input.distance = view.distance;
  if (session_.pointers() > 0) input.hand = session_.pointer(0).scp;
  input.view_width = 2.0 * std::tan(0.5 * view.field) * std::max(1.0, input_.aspect());
  if (const auto picked = session_.pick(input.ray)) input.picked = picked->place;
  input.pressure = pressure_;
  input.wheel = wheel_;
  wheel_ = 0.0;
  const base::Vector3 target = hand_.target(input);
  if (!target.allFinite()) return;
  if (is_stuck(input, target)) session_.park_hand();
  session_.aim_hand(target);
}

}  // namespace icome::ui
