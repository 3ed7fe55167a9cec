#include "interaction/techniques/world_technique.h"

#include <utility>

namespace icome::interaction {
namespace {

// The most that a hand moves and turns while it only presses a button.
constexpr double kStillWay = 0.001;   // m in the room
constexpr double kStillTurn = 0.005;  // rad

bool has_left(const HandInput& before, const HandInput& now) {
  if (!now.tracked) return false;
  if (!before.tracked) return true;
  const Pose way = before.room_from_hand.inverse() * now.room_from_hand;
  return way.translation().norm() > kStillWay ||
         base::Quaternion(way.linear()).angularDistance(base::Quaternion::Identity()) > kStillTurn;
}

}  // namespace

WorldTechnique::WorldTechnique(const Technique& technique, const base::Affine3& world_from_room)
    : technique_(technique), state_(begun(technique)) {
  state_.world_from_room = world_from_room;
}

void WorldTechnique::begin_anew() {
  let_go();
  const base::Affine3 room = state_.world_from_room;
  state_ = begun(technique_);
  state_.world_from_room = room;
  last_ = {};
}

bool WorldTechnique::resting() const {
  return !state_.hold && !state_.travel.arriving() && !last_.hands[0].travel && !last_.hands[1].travel;
}

void WorldTechnique::let_go() {
  state_ = interaction::let_go(std::move(state_), last_);
  taken_.reset();
  performed_ = false;
}

/// Has the hand moved since it took the held object, or the person with it? Once it has, it is moving.
bool WorldTechnique::has_moved(const TechniqueInput& input) {
  if (!taken_) return true;
  const auto& [before, room] = *taken_;
  const bool reeled = technique_.holding == Holding::AlongRay && input.hands[0].reel != 0.0;
  const bool by_other = input.hands[1].grab && has_left(before.hands[1], input.hands[1]);
  if (!reeled && !by_other && !has_left(before.hands[0], input.hands[0]) &&
      room.matrix() == state_.world_from_room.matrix())
    return false;
  taken_.reset();
  return true;
}

std::optional<world::Edit> WorldTechnique::edit_for(const world::World& world, const MovedTarget& moved,
                                                    Step& result) {
  auto edit = edit_of(world, moved);
  if (!edit) {
    result.refused = edit.error().message;
    let_go();
    return std::nullopt;
  }
  result.is_first = !std::exchange(performed_, true);
  return std::move(*edit);
}

WorldTechnique::Step WorldTechnique::step(const world::World& world, const TechniqueInput& input) {
  TechniqueStep next = interaction::step(technique_, state_, input, targets_.of(world));
  state_ = std::move(next.state);
  Step result;
  result.outcome = next.outcome;
  if (result.outcome.ignored) return result;
  last_ = input;
  if (result.outcome.picked || !state_.hold) {
    taken_.reset();
    performed_ = false;
  }
  if (result.outcome.picked && state_.hold) taken_ = Taken{input, state_.world_from_room};
  if (!result.outcome.moved) return result;
  if (has_moved(input)) {
    result.edit = edit_for(world, *result.outcome.moved, result);
  } else {
    result.outcome.moved.reset();
  }
  return result;
}

}  // namespace icome::interaction
