#include "session/display/technique_marks.h"

#include <array>
#include <cmath>
#include <numbers>

#include "interaction/techniques/similarity.h"
#include "session/session.h"

namespace icome::session {
namespace {

using base::Affine3;
using base::Pose;
using base::Vector3;
using interaction::Selecting;
using interaction::TechniqueOutcome;
using interaction::Travelling;

constexpr charts::Colour kBeamColour{0.16, 0.47, 0.90};
constexpr charts::Colour kConeColour{0.16, 0.47, 0.90, 0.5};
constexpr charts::Colour kMeantColour{1.0, 0.62, 0.08};
constexpr charts::Colour kGoalColour{0.20, 0.66, 0.33};

/// Adds the twelve edges of the target's box.
void add_box(render::SceneOverlay& overlay, const world::World& world, interaction::TargetId target) {
  const world::ObjectId id{target};
  const world::PhysicalObject* object = world.find(id);
  const world::GeometryObject* geometry = object ? world.find(object->geometry) : nullptr;
  if (!geometry) return;
  const base::Bounds box = geometry->shape->bounds();
  if (box.isEmpty() || !box.sizes().allFinite()) return;
  const Affine3 place = world_from_object(world, id);
  const auto corner = [&](int which) {
    return Vector3(place * box.corner(base::Bounds::CornerType(which)));  // bits: x, y, z
  };
  for (const int z : {0, 4}) {
    const std::vector<Vector3> loop = {corner(z), corner(z + 1), corner(z + 3), corner(z + 2), corner(z)};
    overlay.lines.push_back({loop, kMeantColour, 1.5});
  }
  for (int side = 0; side < 4; ++side)
    overlay.lines.push_back({{corner(side), corner(side + 4)}, kMeantColour, 1.5});
}

void add_cone(render::SceneOverlay& overlay, const TechniqueOutcome& outcome, double half_angle) {
  constexpr int kRims = 32;
  const Pose& pointer = outcome.pointed.world_from_pointer;
  const double depth = -(pointer.inverse() * outcome.pointed.point).z();
  if (!(depth > 0.0)) return;
  std::vector<Vector3> rim;
  for (int i = 0; i <= kRims; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRims;
    const double radius = depth * std::tan(half_angle);
    rim.emplace_back(pointer * Vector3(radius * std::cos(angle), radius * std::sin(angle), -depth));
  }
  for (int i = 0; i < kRims; i += 4)
    overlay.lines.push_back({{pointer.translation(), rim[std::size_t(i)]}, kConeColour, 1.0});
  overlay.lines.push_back({rim, kConeColour, 1.0});
}

/// Adds the virtual hand, and the line to it from the hand itself.
void add_mapped_hand(render::SceneOverlay& overlay, const TechniqueHand& hand, double radius) {
  const Vector3 mapped = hand.outcome().pointed.world_from_pointer.translation();
  const Vector3 own = hand.stage_from_room() * Vector3(hand.input().hands[0].room_from_hand.translation());
  overlay.balls.push_back({mapped, radius, hand.outcome().pointed.id != 0 ? kMeantColour : kBeamColour});
  overlay.lines.push_back({{own, mapped}, kConeColour, 1.0});
}

void add_pointer(render::SceneOverlay& overlay, const TechniqueHand& hand) {
  const TechniqueOutcome& outcome = hand.outcome();
  const Selecting selecting = hand.technique().selecting;
  const interaction::SelectingSettings& sizes = hand.technique().selecting_settings;
  const double scale = interaction::scale_of(hand.stage_from_room());
  if (selecting == Selecting::LookAt) {
    overlay.balls.push_back({outcome.pointed.point, 0.004 * scale, kBeamColour});
    return;
  }
  if (!hand.input().hands[0].tracked) return;
  if (selecting == Selecting::RayPointer) {
    overlay.lines.push_back(
        {{outcome.pointed.world_from_pointer.translation(), outcome.pointed.point}, kBeamColour, 2.0});
  } else if (selecting == Selecting::Spotlight) {
    add_cone(overlay, outcome, sizes.spotlight);
  } else if (selecting == Selecting::GoGo) {
    add_mapped_hand(overlay, hand, scale * sizes.hand_radius);
  } else if (selecting == Selecting::Miniature) {
    overlay.balls.push_back(
        {outcome.pointed.world_from_pointer.translation(), scale * sizes.finger_radius, kBeamColour});
  }
}

/// Adds a person who stands there, as tall as from the floor to the eyes.
void add_person(render::SceneOverlay& overlay, const Affine3& copy, const Pose& eye, double floor,
                double size) {
  const Vector3 head = eye.translation();
  overlay.balls.push_back({copy * head, size, kGoalColour});
  overlay.lines.push_back({{copy * head, copy * Vector3(head.x(), floor, head.z())}, kGoalColour, 2.0});
  const Vector3 ahead = (copy.linear() * -eye.linear().col(2)).normalized();
  overlay.arrows.push_back({copy * head, copy * head + 4.0 * size * ahead, 0.3 * size, kGoalColour});
}

void add_goal(render::SceneOverlay& overlay, TechniqueHand& hand, const Session& session) {
  const Travelling travelling = hand.technique().travelling;
  const auto& goal = hand.outcome().destination;
  const double scale = interaction::scale_of(hand.stage_from_room());
  const interaction::TravelSettings& travel = hand.technique().travel_settings;
  const Pose eye = interaction::carried_by(hand.stage_from_room(), hand.input().room_from_head);
  if (travelling == Travelling::Teleport && goal)
    add_person(overlay, Affine3::Identity(), *goal, travel.floor, 0.01 * scale);
  if (travelling != Travelling::Miniature) return;
  if (const auto copy = hand.copy_from_stage(session))
    add_person(overlay, *copy, goal.value_or(eye), travel.floor, 0.004 * scale);
}

}  // namespace

render::SceneOverlay technique_marks(TechniqueHand& hand, const Session& session) {
  render::SceneOverlay overlay;
  if (hand.outcome().ignored || !(interaction::scale_of(hand.stage_from_room()) > 0.0)) return overlay;
  add_pointer(overlay, hand);
  if (hand.outcome().pointed.id != 0) add_box(overlay, session.world(), hand.outcome().pointed.id);
  add_goal(overlay, hand, session);
  return overlay;
}

}  // namespace icome::session
