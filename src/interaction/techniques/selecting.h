#pragma once
#include <string_view>

#include "interaction/techniques/go_go.h"
#include "interaction/techniques/miniature.h"
#include "interaction/techniques/technique_scene.h"

namespace icome::interaction {

/// Ways to select an object (thesis 2.2, 2.3.1).
enum class Selecting : std::uint8_t {
  VirtualHand,  // touches it
  GoGo,         // touches it with an arm that grows
  RayPointer,   // the first thing that a ray from the hand meets
  Spotlight,    // one of the things in a cone of light from the hand, as JDCAD chooses
  Miniature,    // touches its copy in a world in miniature
  LookAt,       // the thing that one looks at
};
inline constexpr std::array kAllSelecting = {Selecting::VirtualHand, Selecting::GoGo,
                                             Selecting::RayPointer,  Selecting::Spotlight,
                                             Selecting::Miniature,   Selecting::LookAt};
/// Name of a way to select, such as "virtual hand": for people, reports and files.
std::string_view name_of(Selecting selecting);

/// Sizes of the techniques; room frame, so that they feel the same when the room is scaled.
struct SelectingSettings {
  double hand_radius = 0.02;     // m, of the virtual hand: things within are touched; 0 to 0.05
  double finger_radius = 0.005;  // m, likewise in the miniature; 0 to 0.02
  double spotlight = 0.14;       // rad, half the cone's angle; 0.05 to 0.3
  double same_angle = 0.005;     // rad: things this little farther from the axis count as equally near
  double look_angle = 0.02;      // rad: things that the look passes this near are looked at
  GoGoSettings go_go = {};
  MiniatureSettings miniature = {};
};

/// The target that a hand or the eyes point at.
struct PointedAt {
  TargetId id = 0;                             // 0: nothing
  Vector3 point = Vector3::Zero();             // m, world frame: on the target; if none, of the hand or ahead
  Pose world_from_pointer = Pose::Identity();  // the virtual hand, or the ray's start, pointing along -z
};

/// The target chosen among the lit ones (Liang and Green, JDCAD 1994; thesis 2.2.3): the nearest to the
/// axis, and of those equally near the nearest to the hand. 0 for none.
TargetId disambiguated(const std::vector<TechniqueScene::Lit>& lit, double same_angle);

/// The target that hand 0 or 1, or the eyes, point at. Nothing where the hand is needed but not tracked.
PointedAt pointed_at(Selecting selecting, const SelectingSettings& settings, const TechniqueInput& input,
                     int hand, const base::Affine3& world_from_room, const TechniqueScene& scene);

}  // namespace icome::interaction
