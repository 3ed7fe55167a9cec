#include "interaction/techniques/holding.h"

#include <algorithm>
#include <cmath>

#include "interaction/techniques/similarity.h"

namespace icome::interaction {

std::string_view name_of(Holding holding) {
  switch (holding) {
    case Holding::Hand:
      return "hand";
    case Holding::GoGo:
      return "Go-Go";
    case Holding::AlongRay:
      return "along the ray";
    case Holding::Miniature:
      return "world in miniature";
    case Holding::TwoHands:
      return "two hands";
    case Holding::ScaledWorld:
      return "scaled world";
  }
  return "";
}

Hold::Hold(Holding holding, const PointedAt& grasped)
    : holding_(holding), id_(grasped.id), grasped_(grasped.point) {}

Hold::Hands Hold::hands_now(const TechniqueInput& input) const {
  const auto holds = [&](std::size_t i) { return input.hands[i].tracked && input.hands[i].grab; };
  return {holds(0), holding_ == Holding::TwoHands && holds(1)};
}

/// The hand as it is mapped, in the world's frame.
Pose Hold::hand(const HoldingMoment& now, std::size_t which) const {
  Pose room_from_hand = now.input.hands[which].room_from_hand;
  if (holding_ == Holding::GoGo) {
    const GoGoSettings& arm = now.sizes.go_go;
    room_from_hand = go_go_hand(arm, chest_of(arm, now.input.room_from_head), room_from_hand);
  }
  return carried_by(now.world_from_room, room_from_hand);
}

/// The map from the world to the thing that the hand moves in: the world itself, or the miniature.
base::Affine3 Hold::shown_from_world(const HoldingMoment& now) const {
  if (holding_ != Holding::Miniature) return base::Affine3::Identity();
  return copy_from_world(now.sizes.miniature, now.world_bounds, now.input, now.world_from_room);
}

base::Affine3 Hold::slid() const {
  return base::Affine3(Eigen::Translation3d(0.0, 0.0, length_start_ - length_));
}

void Hold::begin(const HoldingMoment& now, const base::Affine3& world_from_target) {
  grip_.reset();
  if (by_[0] && by_[1]) {
    start_ = world_from_target;
    grip_.emplace(now.settings.two_hands, std::array<Pose, 2>{hand(now, 0), hand(now, 1)}, grasped_);
    return;
  }
  const Pose held_by = hand(now, by_[0] ? 0 : 1);
  const base::Affine3 shown = shown_from_world(now);
  hand_from_target_ = held_by.inverse() * shown * world_from_target;
  shown_scale_ = scale_of(shown);
  length_start_ =
      std::clamp((grasped_ - held_by.translation()).norm(), now.settings.nearest, now.settings.farthest);
  length_ = length_start_;
}

base::Affine3 Hold::follow(const HoldingMoment& now, const base::Affine3& world_from_target) {
  const Hands by = hands_now(now.input);
  if (!by[0] && !by[1]) {
    by_ = by;
    return world_from_target;
  }
  if (by != by_) {
    by_ = by;
    begin(now, world_from_target);
    return world_from_target;
  }
  if (grip_) {
    grip_->follow({hand(now, 0), hand(now, 1)});
    return grip_->moved() * start_;
  }
  const std::size_t which = by_[0] ? 0 : 1;
  if (holding_ == Holding::AlongRay) {
    const double reel = std::clamp(now.input.hands[which].reel, -1.0, 1.0);
    length_ = std::clamp(length_ * std::exp(now.settings.reel_speed * reel * now.seconds),
                         now.settings.nearest, now.settings.farthest);
  }
  const base::Affine3 shown = shown_from_world(now);
  // Travelling meanwhile may change the scale of the copy: the held object stays as large as it was.
  const double same_size = scale_of(shown) / shown_scale_;
  return shown.inverse() * hand(now, which) * slid() * hand_from_target_ * Eigen::Scaling(same_size);
}

double growth_to_reach(const Vector3& eyes, const Vector3& hand, const Vector3& grasped) {
  constexpr double kMost = 1e3;
  const double to_hand = (hand - eyes).norm();
  const double to_grasped = (grasped - eyes).norm();
  if (!(to_hand > 0.0) || !(to_grasped > 0.0)) return 1.0;
  return std::clamp(to_grasped / to_hand, 1.0 / kMost, kMost);
}

}  // namespace icome::interaction
