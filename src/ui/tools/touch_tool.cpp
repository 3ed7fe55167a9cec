#include "ui/tools/touch_tool.h"

#include <QRectF>
#include <algorithm>
#include <cmath>
#include <utility>

#include "session/hands/user_interaction.h"

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
  session_.hands().hold_buttons(0);
  session_.hands().park();
}

bool TouchTool::step(int key, bool fine) {
  if (free_ && (key == Qt::Key_PageUp || key == Qt::Key_PageDown)) {
    turn_wheel(key == Qt::Key_PageUp ? 1.0 : -1.0);
    return true;
  }
  const double right = key == Qt::Key_Right ? 1.0 : key == Qt::Key_Left ? -1.0 : 0.0;
  const double down = key == Qt::Key_Down ? 1.0 : key == Qt::Key_Up ? -1.0 : 0.0;
  if (right == 0.0 && down == 0.0) return false;
  const double pixels = fine ? 1.0 : 8.0;
  input_.at.setX(std::clamp(input_.at.x() + pixels * right, 0.0, input_.size.width()));
  input_.at.setY(std::clamp(input_.at.y() + pixels * down, 0.0, input_.size.height()));
  return true;
}

/// Distance along the ray, m, at which the hand meets what is under the mouse; nothing: any will do.
std::optional<double> TouchTool::depth_under(const session::TechniqueHand& hand,
                                             const interaction::Ray& ray) const {
  const interaction::Technique& technique = hand.technique();
  if (technique.selecting == interaction::Selecting::Miniature) {
    const auto copy = session_.techniques().miniature();
    if (!copy) return std::nullopt;
    const base::Affine3 world_from_copy = copy->inverse();
    const base::Vector3 direction = world_from_copy.linear() * ray.direction;
    const auto picked = session_.stage().pick({world_from_copy * ray.origin, direction.normalized()});
    if (!picked) return std::nullopt;
    return (*copy * picked->place.point - ray.origin).norm();
  }
  const bool grows = technique.selecting == interaction::Selecting::GoGo;
  if (!grows && technique.selecting != interaction::Selecting::VirtualHand) return std::nullopt;
  const auto picked = session_.stage().pick(ray);
  if (!picked) return std::nullopt;
  if (!grows) return picked->place.distance;
  const double scale = session_.view().now().distance / session::UserInteraction::kScreenDistance;
  return scale *
         interaction::go_go_distance(technique.selecting_settings.go_go, picked->place.distance / scale);
}

/// While the button is down, the hand keeps its distance from the eye, except for the wheel.
void TouchTool::tick_technique(const session::TechniqueHand& hand) {
  constexpr double kReach = 0.6;  // of the view's distance, where any will do
  constexpr double kNotch = 0.05;
  const interaction::View& view = session_.view().now();
  const interaction::Ray ray = input_.ray(view);
  reach_ = std::clamp(reach_ * std::exp(kNotch * wheel_), 0.05, 20.0);
  wheel_ = 0.0;
  if (!pressing()) {
    const auto depth = depth_under(hand, ray);
    reach_ = depth ? *depth / view.distance : kReach;
  }
  session_.hands().put(ray.origin + reach_ * view.distance * ray.direction);
  const bool travels = input_.modifiers & Qt::ControlModifier;
  session_.hands().hold_buttons(pressing() ? (travels ? 2U : 1U) : 0U);
}

void TouchTool::go_freely(const std::optional<base::Vector3>& from) {
  free_.reset();
  wheel_ = 0.0;
  if (from) free_ = Free{*from};
}

/// The mouse counts from its first place, so that the hand does not leap to it.
void TouchTool::tick_freely() {
  constexpr double kNotch = 0.005;  // m
  session_.hands().hold_buttons(take_press() ? 1U : 0U);
  free_->away += kNotch * std::exchange(wheel_, 0.0);
  const base::Pose& world_from_eye = session_.view().now().world_from_eye;
  const base::Pose eye_from_world = world_from_eye.inverse();
  const base::Vector3 ray = eye_from_world.linear() * input_.ray(session_.view().now()).direction;
  if (!(ray.z() < 0.0)) return;
  const base::Vector2 mouse = ray.head<2>() / -ray.z();
  if (!free_->mouse_from) free_->mouse_from = mouse;
  base::Vector3 place = eye_from_world * free_->from;
  const double depth = -place.z();
  place.head<2>() += depth * (mouse - *free_->mouse_from);
  place.z() -= free_->away;
  const base::Vector3 target = world_from_eye * place;
  if (target.allFinite()) session_.hands().aim(target);
}

/// Before the haptic menu the hand hovers; it pushes in while the button is down.
void TouchTool::tick_menu(const base::Vector3& met) {
  constexpr double kHovers = 0.006;  // m of the menu, before its plane
  const interaction::ElementUse& menu = *session_.menu().use();
  const double push = 4.0 * menu.element().choosing.push_depth * pressure_ / kButton;
  const double before = menu.frame().size * (pressing() ? -push : kHovers);
  const base::Vector3 place = met + before * menu.frame().normal();
  pressing() ? session_.hands().aim(place) : session_.hands().put(place);
}

void TouchTool::tick() {
  if (!active_) return;
  if (const session::TechniqueHand* hand = session_.techniques().current();
      hand && !session_.hands().shaping())
    return tick_technique(*hand);
  if (free_) return tick_freely();
  session_.hands().hold_buttons(0);
  const interaction::View& view = session_.view().now();
  if (const auto met = session_.menu().met_by(input_.ray(view))) return tick_menu(*met);
  interaction::MouseHand::Input input;
  input.ray = input_.ray(view);
  input.distance = view.distance;
  const auto mouse = session_.hands().mouse();
  if (!mouse) return;
  input.hand = session_.hands().pointer(*mouse).scp;
  input.view_width = 2.0 * std::tan(0.5 * view.field) * std::max(1.0, input_.aspect());
  if (const auto picked = session_.stage().pick(input.ray)) input.picked = picked->place;
  input.pressure = pressure_;
  input.wheel = wheel_;
  wheel_ = 0.0;
  const base::Vector3 target = hand_.target(input);
  if (!target.allFinite()) return;
  // Without the button the hand is a pen in the air: surfaces on its way do not hold it back.
  if (pressing()) {
    session_.hands().aim(target);
  } else {
    session_.hands().put(target);
  }
}

}  // namespace icome::ui
