#include "interaction/techniques/bench/aiming.h"

#include <algorithm>
#include <cmath>

namespace icome::interaction {
namespace {

/// Turned to the right and up, rad, from looking along -z.
base::Matrix3 pointing(const Vector3& control) {
  return (Eigen::AngleAxisd(-control.x(), Vector3::UnitY()) *
          Eigen::AngleAxisd(control.y(), Vector3::UnitX()))
      .toRotationMatrix();
}

Vector3 direction_angles(const Vector3& way) {
  return {std::atan2(way.x(), -way.z()), std::atan2(way.y(), std::hypot(way.x(), way.z())), 0.0};
}

base::Affine3 copy_for(const Technique& technique, const TechniqueScene& scene, const TechniqueInput& input) {
  return copy_from_world(technique.selecting_settings.miniature, scene.bounds(), input,
                         base::Affine3::Identity());
}

}  // namespace

Aiming::Aiming(const Technique& technique, const PersonModel& person)
    : technique_(technique), arm_length_(person.arm_length) {
  technique_.selecting_settings.go_go.arm = arm_length_;
}

Vector3 Aiming::eyes() { return {0.0, 1.6, 0.0}; }
Vector3 Aiming::pointing_hand() { return {0.15, 1.3, -0.25}; }

bool Aiming::goes() const {
  return technique_.selecting == Selecting::VirtualHand || technique_.selecting == Selecting::GoGo ||
         technique_.selecting == Selecting::Miniature;
}

const LimbModel& Aiming::limb(const PersonModel& person) const {
  if (goes()) return person.arm;
  return technique_.selecting == Selecting::LookAt ? person.head : person.wrist;
}

TechniqueInput Aiming::input(const Vector3& control, double time, bool grab) const {
  TechniqueInput input;
  input.time = time;
  input.room_from_head.translation() = eyes();
  HandInput& hand = input.hands[0];
  hand.tracked = true;
  hand.grab = grab;
  hand.room_from_hand.translation() = goes() ? control : pointing_hand();
  if (technique_.selecting == Selecting::LookAt) {
    input.room_from_head.linear() = pointing(control);
  } else if (!goes()) {
    hand.room_from_hand.linear() = pointing(control);
  }
  if (technique_.selecting == Selecting::Miniature) {
    input.hands[1].tracked = true;
    input.hands[1].room_from_hand.translation() = eyes() + Vector3(0.0, -0.4, -0.35);
  }
  return input;
}

std::optional<Vector3> Aiming::control_for(const TechniqueScene& scene, const Vector3& place) const {
  const TechniqueInput still = input(Vector3::Zero(), 0.0, false);
  const GoGoSettings& go_go = technique_.selecting_settings.go_go;
  const Vector3 chest = chest_of(go_go, still.room_from_head);
  Vector3 hand = place;
  switch (technique_.selecting) {
    case Selecting::LookAt:
      return direction_angles(place - eyes());
    case Selecting::RayPointer:
    case Selecting::Spotlight:
      return direction_angles(place - pointing_hand());
    case Selecting::VirtualHand:
      break;
    case Selecting::GoGo:
      hand = go_go_hand_for(go_go, chest, place);
      break;
    case Selecting::Miniature:
      hand = copy_for(technique_, scene, still) * place;
      break;
  }
  if ((hand - chest).norm() > arm_length_) return std::nullopt;
  return hand;
}

Vector3 Aiming::reached(const TechniqueScene& scene, const Vector3& control, const Vector3& place) const {
  const TechniqueInput now = input(control, 0.0, false);
  const GoGoSettings& go_go = technique_.selecting_settings.go_go;
  if (technique_.selecting == Selecting::VirtualHand) return control;
  if (technique_.selecting == Selecting::GoGo)
    return go_go_hand(go_go, chest_of(go_go, now.room_from_head), now.hands[0].room_from_hand).translation();
  if (technique_.selecting == Selecting::Miniature)
    return copy_for(technique_, scene, now).inverse() * control;
  const Vector3 from = technique_.selecting == Selecting::LookAt ? eyes() : pointing_hand();
  const Vector3 along = -pointing(control).col(2);
  return from + std::max(0.0, (place - from).dot(along)) * along;
}

double Aiming::viewing_distance(const TechniqueScene& scene, const Vector3& place) const {
  if (technique_.selecting != Selecting::Miniature) return (place - eyes()).norm();
  const TechniqueInput still = input(Vector3::Zero(), 0.0, false);
  return (copy_for(technique_, scene, still) * place - eyes()).norm();
}

TargetId Aiming::picked(const TechniqueScene& scene, const Vector3& control) const {
  return pointed_at(technique_.selecting, technique_.selecting_settings, input(control, 0.0, false), 0,
                    base::Affine3::Identity(), scene)
      .id;
}

/// The least distance, in any direction, up to which the steering may be off and still selects the target.
double Aiming::tolerance(const TechniqueScene& scene, TargetId target, const Vector3& control) const {
  constexpr double kFarthestOff = 1.0;
  constexpr int kHalvings = 14;
  double least = kFarthestOff;
  for (int axis = 0; axis < (goes() ? 3 : 2); ++axis) {
    for (const double sense : {-1.0, 1.0}) {
      double inside = 0.0, outside = kFarthestOff;
      // Near first: farther out the same target may be met again.
      for (int i = 0; i < kHalvings && inside < least; ++i) {
        const double off = i < kHalvings / 2 && inside == 0.0 ? outside * 0.25 : 0.5 * (inside + outside);
        const bool selects = picked(scene, control + sense * off * Vector3::Unit(axis)) == target;
        (selects ? inside : outside) = off;
      }
      least = std::min(least, inside);
    }
  }
  return least;
}

std::optional<Aiming::Goal> Aiming::goal_for(const TechniqueScene& scene, TargetId target) const {
  const SceneTarget* const found = scene.find(target);
  if (!found) return std::nullopt;
  const TargetBall ball = ball_of(*found);
  std::optional<Goal> best;
  // The middle, then to every side within the target, then beside it: a spotlight need not shine on it.
  constexpr std::array kOffs = {0.0, 0.6, -0.6, 1.5, -1.5};  // radii
  for (int i = 0; i < int(3 * kOffs.size()); ++i) {
    Vector3 place = ball.centre;
    place[i % 3] += kOffs[std::size_t(i / 3)] * ball.radius;
    const auto control = control_for(scene, place);
    if (!control || picked(scene, *control) != target) continue;
    const double around = tolerance(scene, target, *control);
    if (around > 0.0 && (!best || around > best->tolerance)) best = Goal{*control, around};
    if (i == 0 && best) return best;
  }
  return best;
}

}  // namespace icome::interaction
