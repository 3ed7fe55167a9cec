#include "session/felt/felt_servos.h"

#include <algorithm>

namespace icome::session {

void FeltServos::add(haptics::Servo& servo, std::size_t place) {
  const std::lock_guard lock(mutex_);
  servos_.insert(servos_.begin() + std::ptrdiff_t(std::min(place, servos_.size())), &servo);
  if (!effects_.empty() || !menu_.empty()) servo.publish_effects(all_effects());
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
  const auto all = all_effects();
  for (haptics::Servo* servo : servos_) servo->publish_effects(all);
}

void FeltServos::publish_menu(const std::vector<haptics::PlacedEffect>& sheets) {
  const std::lock_guard lock(mutex_);
  menu_ = sheets;
  const auto all = all_effects();
  for (haptics::Servo* servo : servos_) servo->publish_effects(all);
}

std::vector<haptics::PlacedEffect> FeltServos::all_effects() const {
  std::vector<haptics::PlacedEffect> all = effects_;
  all.insert(all.end(), menu_.begin(), menu_.end());
  return all;
}

std::vector<haptics::CappedEffect> FeltServos::capped_effects() const {
  const std::lock_guard lock(mutex_);
  if (servos_.empty()) return {};
  auto capped = servos_.front()->capped_effects();
  std::erase_if(capped, [&](const haptics::CappedEffect& it) {
    return std::ranges::find(menu_, it.id, &haptics::PlacedEffect::id) != menu_.end();
  });
  return capped;
}

}  // namespace icome::session
