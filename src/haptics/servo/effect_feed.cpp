#include "haptics/servo/effect_feed.h"

#include <algorithm>
#include <utility>

#include "haptics/effects/effect_text.h"
#include "haptics/effects/mass_shares.h"

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

/// Null where the text makes no effect.
std::shared_ptr<EffectFeed::Felt> EffectFeed::felt_as(const PlacedEffect& placed) const {
  const auto last = std::ranges::find_if(
      published_.members, [&](const Member& it) { return placed.id != 0 && it.placed.id == placed.id; });
  const bool goes_on = last != published_.members.end();
  if (goes_on && last->placed.text == placed.text) return last->felt;
  auto made = make_effect(placed.text);
  if (!made) return nullptr;
  if (!goes_on)
    return std::make_shared<Felt>(
        Felt{std::move(*made), std::make_shared<base::Pose>(placed.world_from_effect)});
  (*made)->continue_from(*last->felt->effect);
  return std::make_shared<Felt>(Felt{std::move(*made), last->felt->world_from_effect});
}

void EffectFeed::publish(const std::vector<PlacedEffect>& effects) {
  Version next;
  std::vector<MassNeed> needs;
  for (const PlacedEffect& placed : effects) {
    auto felt = felt_as(placed);
    if (!felt) continue;
    needs.push_back({felt->effect->mass_needed(limits_.effective_mass, limits_.dt),
                     transformed(placed.world_from_effect, felt->effect->reach())});
    next.members.push_back({placed, std::move(felt), needs.back().mass});
  }
  const std::vector<double> together = needed_together(needs);
  for (std::size_t i = 0; i < together.size(); ++i) {
    next.members[i].together = together[i];
    next.mass_needed = std::max(next.mass_needed, together[i]);
  }
  published_ = std::move(next);
  newest_.publish(published_);
}

std::vector<CappedEffect> EffectFeed::capped(double beside) const {
  std::vector<CappedEffect> capped;
  for (const Member& it : published_.members) {
    const double mass = mass_share(limits_.effective_mass, it.needs, it.together + beside);
    std::string what = it.felt->effect->capped(mass, limits_.dt);
    if (!what.empty()) capped.push_back({it.placed.id, it.placed.text, std::move(what)});
  }
  return capped;
}

void EffectFeed::follow() {
  if (!newest_.update()) return;
  for (const Member& it : newest_.read().members) {
    const base::Pose& now = it.placed.world_from_effect;
    base::Pose& before = *it.felt->world_from_effect;
    if (now.matrix() == before.matrix()) continue;
    it.felt->effect->reframe(now.inverse() * before);
    before = now;
  }
}

Vector3 EffectFeed::force(const EffectInput& input, double beside) {
  Vector3 sum = Vector3::Zero();
  for (const Member& it : newest_.read().members) {
    const base::Pose& pose = it.placed.world_from_effect;
    EffectInput own = seen_from(pose, input);
    own.device_mass = mass_share(input.device_mass, it.needs, it.together + beside);
    const Vector3 force = pose.linear() * it.felt->effect->force(own);
    if (force.allFinite()) sum += force;
  }
  return sum;
}

void EffectFeed::reset() {
  for (const Member& it : newest_.read().members) it.felt->effect->reset();
}

}  // namespace icome::haptics
