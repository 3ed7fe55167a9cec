#include "interaction/techniques/technique.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "interaction/techniques/similarity.h"
#include "world/hasher.h"

namespace icome::interaction {
namespace {

/// The longest time that one step counts: a pause of the devices must not carry anybody far.
constexpr double kLongestStep = 0.1;  // s

void grow_room(TechniqueState& state, const TechniqueInput& input, double growth) {
  const Vector3 eyes = state.world_from_room * Vector3(input.room_from_head.translation());
  state.world_from_room = scaled_about(eyes, growth) * state.world_from_room;
}

void take_hold(const Technique& technique, TechniqueState& state, const TechniqueInput& input,
               const PointedAt& pointed, const base::Bounds& all) {
  state.hold.emplace(technique.holding, pointed);
  state.shown = all;
  if (technique.holding != Holding::ScaledWorld || !input.hands[0].tracked) return;
  const Vector3 eyes = state.world_from_room * Vector3(input.room_from_head.translation());
  const Vector3 hand = state.world_from_room * Vector3(input.hands[0].room_from_hand.translation());
  state.room_growth = growth_to_reach(eyes, hand, pointed.point);
  grow_room(state, input, state.room_growth);
}

void release_held(TechniqueState& state, const TechniqueInput& input) {
  state.hold.reset();
  if (state.room_growth != 1.0) grow_room(state, input, 1.0 / state.room_growth);
  state.room_growth = 1.0;
}

bool still_held(const Technique& technique, const TechniqueInput& input) {
  return input.hands[0].grab || (technique.holding == Holding::TwoHands && input.hands[1].grab);
}

/// Is the place in reach? A magnified hand must not lead anything to where numbers end, drag by drag.
bool is_in_reach(const base::Affine3& place, const base::Affine3& before, const Vector3& eyes,
                 double farthest) {
  const double away = (place.translation() - eyes).norm();
  return away <= farthest || away <= (before.translation() - eyes).norm();
}

void move_held(const Technique& technique, TechniqueStep& result, const TechniqueInput& input,
               const TechniqueScene& scene, double seconds) {
  Hold& hold = *result.state.hold;
  const base::Affine3 before = scene.find(hold.id())->world_from_target;
  const SelectingSettings sizes = sizes_now(technique, result.state);
  const HoldingMoment now{input,          sizes,  technique.holding_settings, result.state.world_from_room,
                          scene.bounds(), seconds};
  const base::Affine3 place = hold.follow(now, before);
  const base::Affine3& room = result.state.world_from_room;
  const Vector3 eyes = room * Vector3(input.room_from_head.translation());
  const double farthest = technique.holding_settings.farthest * std::max(1.0, scale_of(room));
  if (place.matrix() != before.matrix() && place.matrix().allFinite() &&
      is_in_reach(place, before, eyes, farthest))
    result.outcome.moved = MovedTarget{hold.id(), place};
}

void add_pose(world::Hasher& hasher, const Pose& pose) { hasher.add(pose.matrix()); }

}  // namespace

base::Result<void> check(const Technique& technique) {
  struct Size {
    const char* name;
    double value, least, most;
  };
  const SelectingSettings& sizes = technique.selecting_settings;
  const HoldingSettings& hold = technique.holding_settings;
  const TravelSettings& travel = technique.travel_settings;
  const Size all[] = {
      {"hand radius", sizes.hand_radius, 0.0, 1.0},
      {"finger radius", sizes.finger_radius, 0.0, 1.0},
      {"spotlight's half angle", sizes.spotlight, 1e-6, 1.5},
      {"angle that counts as the same", sizes.same_angle, 0.0, 1.5},
      {"angle of the look", sizes.look_angle, 1e-6, 1.5},
      {"arm's length", sizes.go_go.arm, 0.1, 10.0},
      {"near share of the arm", sizes.go_go.near_share, 0.0, 1.0},
      {"gain of Go-Go", sizes.go_go.gain, 0.0, 1e6},
      {"height of the eyes above the chest", sizes.go_go.chest_below_eyes, 0.0, 2.0},
      {"size of the miniature", sizes.miniature.size, 1e-3, 100.0},
      {"reel speed", hold.reel_speed, 0.0, 100.0},
      {"shortest ray", hold.nearest, 1e-6, 1e6},
      {"longest ray", hold.farthest, hold.nearest, 1e6},
      {"closest distance of two hands", hold.two_hands.closest, 1e-6, 1.0},
      {"speed of flying", travel.fly_speed, 0.0, 1e4},
      {"stand-off", travel.stand_off, 0.0, 100.0},
      {"farthest teleport", travel.farthest, 0.0, 1e6},
      {"time of arrival", travel.flight_seconds, 0.0, 60.0},
      {"reach to the likeness", travel.likeness_radius, 0.0, 10.0},
      {"floor", travel.floor, -1e6, 1e6},
  };
  for (const Size& size : all)
    if (!(size.value >= size.least && size.value <= size.most))
      return base::fail(fmt::format("the {} is {}; choose one from {} to {}.", size.name, size.value,
                                    size.least, size.most));
  return {};
}

SelectingSettings sizes_now(const Technique& technique, const TechniqueState& state) {
  SelectingSettings sizes = technique.selecting_settings;
  if (state.hold && sizes.miniature.shown.isEmpty()) sizes.miniature.shown = state.shown;
  return sizes;
}

TechniqueState begun(const Technique& technique) {
  TechniqueState state;
  state.travel = Travel(technique.travelling);
  return state;
}

TechniqueStep step(const Technique& technique, const TechniqueState& state, const TechniqueInput& input,
                   const TechniqueScene& scene) {
  TechniqueStep result{state, {}};
  result.outcome.selected = state.selected;
  result.outcome.world_from_room = state.world_from_room;
  if (!makes_sense(input) || (state.time && input.time < *state.time)) {
    result.outcome.ignored = true;
    return result;
  }
  TechniqueState& now = result.state;
  const double seconds = state.time ? std::min(input.time - *state.time, kLongestStep) : 0.0;
  now.time = input.time;
  if (now.hold && (!scene.find(now.hold->id()) || !still_held(technique, input))) release_held(now, input);
  if (!scene.find(now.selected)) now.selected = 0;
  const SelectingSettings sizes = sizes_now(technique, now);
  const TravelMoment journey{input, sizes, technique.travel_settings, scene, now.selected, seconds};
  now.world_from_room = now.travel.follow(journey, now.world_from_room);
  PointedAt pointed = pointed_at(technique.selecting, sizes, input, 0, now.world_from_room, scene);
  const bool pressed = input.hands[0].grab && !state.grabbing;
  if (pressed && !now.hold) {
    now.selected = pointed.id;
    result.outcome.picked = true;
    if (pointed.id != 0) take_hold(technique, now, input, pointed, scene.bounds());
  }
  now.grabbing = input.hands[0].grab;
  if (now.hold) {
    move_held(technique, result, input, scene, seconds);
    pointed.id = now.hold->id();
  }
  result.outcome.pointed = pointed;
  result.outcome.selected = now.selected;
  result.outcome.world_from_room = now.world_from_room;
  result.outcome.destination = now.travel.destination();
  return result;
}

TechniqueState let_go(TechniqueState state, const TechniqueInput& input) {
  if (state.hold) release_held(state, input);
  return state;
}

std::vector<TechniqueOutcome> replay(const Technique& technique, std::span<const TechniqueInput> stream,
                                     TechniqueScene& scene) {
  std::vector<TechniqueOutcome> outcomes;
  outcomes.reserve(stream.size());
  TechniqueState state = begun(technique);
  for (const TechniqueInput& input : stream) {
    TechniqueStep next = step(technique, state, input, scene);
    if (next.outcome.moved) scene.move(next.outcome.moved->id, next.outcome.moved->world_from_target);
    state = std::move(next.state);
    outcomes.push_back(next.outcome);
  }
  return outcomes;
}

std::uint64_t hash(std::span<const TechniqueOutcome> outcomes) {
  world::Hasher hasher;
  for (const TechniqueOutcome& it : outcomes) {
    hasher.add(it.ignored);
    hasher.add(it.pointed.id);
    hasher.add(it.pointed.point);
    add_pose(hasher, it.pointed.world_from_pointer);
    hasher.add(it.selected);
    hasher.add(it.picked);
    hasher.add(it.world_from_room.matrix());
    hasher.add(it.moved.has_value());
    if (it.moved) {
      hasher.add(it.moved->id);
      hasher.add(it.moved->world_from_target.matrix());
    }
    hasher.add(it.destination.has_value());
    if (it.destination) add_pose(hasher, *it.destination);
  }
  return hasher.value();
}

}  // namespace icome::interaction
