#include "haptics/effects/effect.h"

#include <cassert>
#include <utility>

namespace icome::haptics {

std::size_t EffectSet::add(std::unique_ptr<Effect> effect) {
  assert(effect != nullptr);
  members_.push_back({std::move(effect)});
  return members_.size() - 1;
}

void EffectSet::set_enabled(std::size_t index, bool enabled) {
  assert(index < members_.size());
  Member& member = members_[index];
  if (enabled && !member.enabled) member.effect->reset();
  member.enabled = enabled;
}

Vector3 EffectSet::force(const EffectInput& input) {
  Vector3 sum = Vector3::Zero();
  for (Member& member : members_) {
    if (member.enabled) sum += member.effect->force(input);
  }
  return sum;
}

std::string EffectSet::capped(double device_mass, double dt) const {
  std::string all;
  for (const Member& member : members_) {
    const std::string one = member.enabled ? member.effect->capped(device_mass, dt) : std::string();
    if (!one.empty()) all += (all.empty() ? "" : ", ") + one;
  }
  return all;
}

void EffectSet::reset() {
  for (Member& member : members_) member.effect->reset();
}

}  // namespace icome::haptics
