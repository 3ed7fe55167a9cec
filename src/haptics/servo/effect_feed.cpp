#include "haptics/servo/effect_feed.h"

#include <algorithm>
#include <utility>

#include "haptics/effects/effect_text.h"

namespace icome::haptics {
namespace {

EffectInput seen_from(const base::Pose& world_from_effect, const EffectInput& world) {
  const base::Pose effect_from_world = world_from_effect.inverse();
  EffectInput input = world;
  input.position = effect_from_world * world.position;
  input.velocity = effect_from_world.linear() * world.velocity;
  input.scp = effect_from_world * world.scp;
  return input;
}

}  // namespace

std::shared_ptr<Effect> EffectFeed::effect_of(const PlacedEffect& placed) const {
  if (!kept_.empty()) {
    const auto& last = kept_.back()->members;
    const auto same = std::ranges::find_if(
        last, [&](const Member& it) { return it.placed.id == placed.id && it.placed.text == placed.text; });
    if (same != last.end()) return same->effect;
  }
  auto made = make_effect(placed.text);
  return made ? std::shared_ptr<Effect>(std::move(*made)) : nullptr;
}

void EffectFeed::publish(const std::vector<PlacedEffect>& effects) {
  const std::uint64_t taken = taken_.load(std::memory_order_acquire);
  while (!kept_.empty() && kept_.front()->number < taken) kept_.pop_front();
  auto next = std::make_unique<Version>();
  next->number = next_number_++;
  for (const PlacedEffect& placed : effects)
    if (auto effect = effect_of(placed)) next->members.push_back({placed, std::move(effect)});
  kept_.push_back(std::move(next));
  newest_.publish(kept_.back().get());
}

Vector3 EffectFeed::force(const EffectInput& input) {
  if (newest_.update()) taken_.store(newest_.read()->number, std::memory_order_release);
  Vector3 sum = Vector3::Zero();
  const Version* const version = newest_.read();
  if (version == nullptr) return sum;
  for (const Member& it : version->members) {
    const base::Pose& pose = it.placed.world_from_effect;
    const Vector3 force = pose.linear() * it.effect->force(seen_from(pose, input));
    if (force.allFinite()) sum += force;
  }
  return sum;
}

void EffectFeed::reset() {
  const Version* const version = newest_.read();
  if (version == nullptr) return;
  for (const Member& it : version->members) it.effect->reset();
}

}  // namespace icome::haptics
