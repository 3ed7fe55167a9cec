#include "haptics/servo/effect_feed.h"

#include <algorithm>
#include <utility>

#include "haptics/effects/effect_text.h"
#include "haptics/effects/mass_shares.h"

namespace icome::haptics {
namespace {

/// Negates x if the effect is mirrored.
Vector3 across(bool mirrored, const Vector3& vector) {
  return mirrored ? Vector3(-vector.x(), vector.y(), vector.z()) : vector;
}

base::Pose across(bool mirrored, base::Pose pose) {
  if (!mirrored) return pose;
  pose.matrix().row(0) *= -1.0;
  pose.matrix().col(0) *= -1.0;
  return pose;
}

/// The input in the frame of an effect that moves with `velocity` (m/s, world) at the place of the tip.
EffectInput seen_from(const base::Pose& world_from_effect, bool mirrored, const Vector3& velocity,
                      const EffectInput& world) {
  const base::Pose effect_from_world = world_from_effect.inverse();
  EffectInput input = world;
  input.position = across(mirrored, Vector3(effect_from_world * world.position));
  input.velocity = across(mirrored, Vector3(effect_from_world.linear() * (world.velocity - velocity)));
  input.scp = across(mirrored, Vector3(effect_from_world * world.scp));
  return input;
}

/// Region in which the effect can act before the next version, world frame.
Reach reach_of(const PlacedEffect& placed, const Effect& effect) {
  Reach reach = reach_in_world(placed, effect);
  const Vector3 velocity = velocity_at(placed.world_from_effect, placed.motion, 0.0, reach.centre);
  reach.radius += Motion::kHorizon * velocity.norm();
  return reach;
}

/// The force, no longer than `newtons`, in its own direction.
Vector3 at_most(const Vector3& force, double newtons) {
  const double length = force.norm();
  return length > newtons ? Vector3(force * (newtons / length)) : force;
}

/// Null where the text makes none.
std::unique_ptr<Effect> effect_of(const PlacedEffect& placed) {
  if (placed.panel) return std::make_unique<Panel>(*placed.panel);
  if (placed.make) return (*placed.make)();
  auto made = make_effect(placed.text);
  return made ? std::move(*made) : nullptr;
}

}  // namespace

Reach reach_in_world(const PlacedEffect& placed, const Effect& effect) {
  Reach reach = effect.reach();
  reach.centre = across(placed.mirrored, reach.centre);
  reach.axis = across(placed.mirrored, reach.axis);
  return transformed(placed.world_from_effect, reach);
}

/// Continues the last published effect of the same object, if any. Null where the text makes no effect.
std::shared_ptr<EffectFeed::Felt> EffectFeed::felt_as(const PlacedEffect& placed) const {
  const auto last = std::ranges::find_if(
      published_.members, [&](const Member& it) { return placed.id != 0 && it.placed.id == placed.id; });
  const bool goes_on = last != published_.members.end();
  const bool as_mirrored = goes_on && last->placed.mirrored == placed.mirrored;
  if (goes_on && last->placed.same_effect(placed)) return last->felt;
  std::unique_ptr<Effect> made = effect_of(placed);
  if (!made) return nullptr;
  if (!goes_on)
    return std::make_shared<Felt>(
        Felt{std::move(made),
             std::make_shared<Whereabouts>(Whereabouts{placed.world_from_effect, placed.world_from_effect})});
  if (as_mirrored) made->continue_from(*last->felt->effect);
  return std::make_shared<Felt>(Felt{std::move(made), last->felt->whereabouts, true});
}

void EffectFeed::publish(const std::vector<PlacedEffect>& effects) {
  Version next;
  std::vector<MassNeed> needs;
  for (const PlacedEffect& placed : effects) {
    auto felt = felt_as(placed);
    if (!felt) continue;
    needs.push_back(
        {felt->effect->mass_needed(limits_.effective_mass, limits_.dt), reach_of(placed, *felt->effect)});
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

void EffectFeed::follow(double dt) {
  const bool newer = newest_.update();
  elapsed_ = newer ? 0.0 : elapsed_ + dt;
  for (const Member& it : newest_.read().members) bring(it, dt, newer);
}

/// Moves an effect, with its memory, to its pose in this tick.
void EffectFeed::bring(const Member& member, double dt, bool newer) {
  const PlacedEffect& placed = member.placed;
  Whereabouts& is = *member.felt->whereabouts;
  if (is.rests && !newer) return;
  if (newer && placed.world_from_effect.matrix() != is.put.matrix()) {
    is.put = placed.world_from_effect;
    is.left = kGlideSeconds;
  }
  const base::Pose before = is.at;
  const base::Pose carried = moved(before, is.goes_on, dt);
  const base::Pose goal = moved(placed.world_from_effect, placed.motion, elapsed_);
  is.at = is.left > dt ? between(carried, goal, dt / is.left) : goal;
  is.left = std::max(0.0, is.left - dt);
  is.goes_on = placed.motion.moves(elapsed_) ? placed.motion : Motion{};
  is.goes_on.arrives = 0.0;
  is.goes_on.ends = dt;
  is.rests = is.left == 0.0 && placed.motion.still();
  Effect& effect = *member.felt->effect;
  const base::Pose& stays = effect.rides() ? carried : before;
  if (is.at.matrix() != stays.matrix()) effect.reframe(across(placed.mirrored, is.at.inverse() * stays));
}

Vector3 EffectFeed::force(const EffectInput& input, double beside) {
  Vector3 sum = Vector3::Zero(), panels = Vector3::Zero();
  for (const Member& it : newest_.read().members) {
    const base::Pose& pose = it.felt->whereabouts->at;
    if (passes_over(*it.felt, it.placed.mirrored, input.position)) continue;
    Vector3 carried = Vector3::Zero();
    if (it.felt->effect->rides()) carried = velocity_at(pose, it.placed.motion, elapsed_, input.position);
    EffectInput own = seen_from(pose, it.placed.mirrored, carried, input);
    own.device_mass = mass_share(input.device_mass, it.needs, it.together + beside);
    const Vector3 force = pose.linear() * across(it.placed.mirrored, it.felt->effect->force(own));
    if (force.allFinite()) (it.placed.panel ? panels : sum) += eased(*it.felt, force, own);
  }
  return sum + of_panels(panels, input.dt);
}

/// Sheets lie beside and over each other: together they change by what one alone may.
Vector3 EffectFeed::of_panels(const Vector3& asked, double dt) {
  const Vector3 change = asked - panels_;
  const double most = Panel::kMostChange * dt;
  panels_ = change.norm() > most ? Vector3(panels_ + change * (most / change.norm())) : asked;
  return panels_;
}

/// Does the effect neither give a force nor change in this tick?
bool EffectFeed::passes_over(const Felt& felt, bool mirrored, const Vector3& tip) {
  const Whereabouts& is = *felt.whereabouts;
  if (felt.changed || !is.still.isZero(0.0) || !is.gave.isZero(0.0)) return false;
  const base::Pose& pose = is.at;
  const Vector3 place = pose.linear().transpose() * (tip - pose.translation());
  return felt.effect->is_idle_at(across(mirrored, place));
}

/// The requested force, and the fading rest of the force before the effect's numbers or its piece of the
/// device were changed. A constant push that fades adds no stiffness and no damping, so stability is kept.
Vector3 EffectFeed::eased(Felt& felt, const Vector3& asked, const EffectInput& own) const {
  Whereabouts& is = *felt.whereabouts;
  const double most = std::max(0.0, limits_.max_force);
  const bool changed = std::exchange(felt.changed, false);
  const bool other_share = std::exchange(is.share, own.device_mass) != own.device_mass;
  // Force above the device's maximum is left out: it would take long to fade, and nobody would feel why.
  if (is.felt && (changed || other_share)) is.still = at_most(is.gave, most) - at_most(asked, most);
  const double fades = most * own.dt / kEaseSeconds;
  const double left = is.still.norm();
  is.still = left > fades ? Vector3(is.still * (1.0 - fades / left)) : Vector3(Vector3::Zero());
  is.felt = true;
  is.gave = is.still.isZero(0.0) ? asked : Vector3(at_most(asked, most) + is.still);
  return is.gave;
}

void EffectFeed::reset() {
  panels_.setZero();
  for (const Member& it : newest_.read().members) {
    it.felt->effect->reset();
    it.felt->whereabouts->felt = false;
    it.felt->whereabouts->still.setZero();
  }
}

}  // namespace icome::haptics
