#include "session/felt/felt_servos.h"

#include <algorithm>

namespace icome::session {

void FeltServos::add(haptics::Servo& servo, std::size_t place) {
  const std::lock_guard lock(mutex_);
  servos_.insert(servos_.begin() + std::ptrdiff_t(std::min(place, servos_.size())), &servo);
  if (!effects_.empty()) servo.publish_effects(effects_);
  if (scene_) servo.publish(scene_);
}

void FeltServos::remove(const haptics::Servo& servo) {
  const std::lock_guard lock(mutex_);
  std::erase(servos_, &servo);
}

void FeltServos::publish(const std::shared_ptr<const haptics::HapticScene>& scene) {
  const std::lock_guard lock(mutex_);
  scene_ = scene;
  for (haptics::Servo* servo : servos_) servo->publish(scene);
}

void FeltServos::publish_effects(const std::vector<haptics::PlacedEffect>& effects) {
  const std::lock_guard lock(mutex_);
  effects_ = effects;
  for (haptics::Servo* servo : servos_) servo->publish_effects(effects);
}

std::vector<haptics::CappedEffect> FeltServos::capped_effects() const {
  const std::lock_guard lock(mutex_);
  return servos_.empty() ? std::vector<haptics::CappedEffect>() : servos_.front()->capped_effects();
}

}  // namespace icome::session
