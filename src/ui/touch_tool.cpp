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
  // Without the button the hand is a pen in the air: nothing that it passes behind holds it back.
  if (pressing()) {
    session_.aim_hand(target);
  } else {
    session_.put_hand(target);
  }
}

}  // namespace icome::ui
