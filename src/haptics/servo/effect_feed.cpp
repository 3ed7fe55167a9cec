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
  const auto same = std::ranges::find_if(published_, [&](const Member& it) {
    return it.placed.id == placed.id && it.placed.text == placed.text;
  });
  if (same != published_.end()) return same->effect;
  auto made = make_effect(placed.text);
  return made ? std::shared_ptr<Effect>(std::move(*made)) : nullptr;
}

void EffectFeed::publish(const std::vector<PlacedEffect>& effects) {
  Members members;
  for (const PlacedEffect& placed : effects)
    if (auto effect = effect_of(placed)) members.push_back({placed, std::move(effect)});
  published_ = std::move(members);
  newest_.publish(published_);
}

Vector3 EffectFeed::force(const EffectInput& input) {
  Vector3 sum = Vector3::Zero();
  for (const Member& it : newest_.read()) {
    const base::Pose& pose = it.placed.world_from_effect;
    const Vector3 force = pose.linear() * it.effect->force(seen_from(pose, input));
    if (force.allFinite()) sum += force;
  }
  return sum;
}

void EffectFeed::reset() {
  for (const Member& it : newest_.read()) it.effect->reset();
}

}  // namespace icome::haptics
