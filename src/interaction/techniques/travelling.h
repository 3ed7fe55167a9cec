#pragma once
#include <optional>
#include <string_view>

#include "interaction/techniques/selecting.h"
#include "interaction/techniques/two_hands.h"

namespace icome::interaction {

/// Ways to travel (thesis 2.2.2, 2.3.1, 2.4.3) while the travel button is down. The room moves, so that
/// hands and pointers come along with the view.
enum class Travelling : std::uint8_t {
  None,
  Orbit,      // two hands turn the person about what is selected; their distance sets how far away it is
  Fly,        // to where the hand points
  Teleport,   // to the place that the hand points at when the button comes up
  Miniature,  // to where the person's likeness in the miniature is put
};
inline constexpr std::array kAllTravelling = {Travelling::None, Travelling::Orbit, Travelling::Fly,
                                              Travelling::Teleport, Travelling::Miniature};
std::string_view name_of(Travelling travelling);

struct TravelSettings {
  double fly_speed = 2.0;         // m/s in the room's scale; 0.5 to 10
  double floor = 0.0;             // m: the height on which one stands in the world
  double stand_off = 0.7;         // m before a thing that one teleports to; 0.3 to 1
  double farthest = 100.0;        // m, of a teleport
  double flight_seconds = 1.0;    // until one arrives; 0.3 to 2
  double likeness_radius = 0.05;  // m in the room's scale: from there the hand takes the likeness
};

/// The inputs of travelling at one moment.
struct TravelMoment {
  const TechniqueInput& input;
  const SelectingSettings& sizes;
  const TravelSettings& settings;
  const TechniqueScene& scene;
  TargetId about;  // what one orbits; 0: the middle of the scene
  double seconds;  // since the last step
};

/// A person on the way. A plain value; the room's place is passed through.
class Travel {
 public:
  explicit Travel(Travelling travelling = Travelling::None) : travelling_(travelling) {}

  /// The room's place in the world after the step.
  base::Affine3 follow(const TravelMoment& now, const base::Affine3& world_from_room);
  /// Is an animated way to somewhere under way? Buttons for travelling are ignored then.
  bool arriving() const { return arrival_.has_value(); }
  /// The eyes' place to which a teleport or the likeness in the miniature leads when the button comes up.
  const std::optional<Pose>& destination() const { return destination_; }

 private:
  struct Orbit {
    TwoHandGrip grip;  // in the room's frame
    base::Affine3 world_from_room;
    Vector3 centre;  // m, world frame
    Vector3 head;    // m, room frame
  };
  struct Arrival {
    View from, to;
    double begun;         // s
    double seconds;       // until arrival
    Pose room_from_head;  // when it began
  };
  base::Affine3 orbit(const TravelMoment& now, const base::Affine3& world_from_room);
  base::Affine3 arrive(const TravelMoment& now, const base::Affine3& world_from_room);
  void aim(const TravelMoment& now, const base::Affine3& world_from_room);
  void take_likeness(const TravelMoment& now, const base::Affine3& world_from_room);
  void set_out(const TravelMoment& now, const base::Affine3& world_from_room);

  Travelling travelling_;
  bool pressed_ = false;
  std::optional<Orbit> orbit_;
  std::optional<Pose> hand_from_likeness_;
  std::optional<Pose> destination_;  // world_from_eye
  std::optional<Arrival> arrival_;
};

/// The place where a person stands who teleports along the ray: on the floor, or on it before the thing
/// that the ray meets first; nothing where it leads nowhere near enough.
std::optional<Vector3> teleport_place(const TechniqueScene& scene, const Ray& ray,
                                      const TravelSettings& settings);

}  // namespace icome::interaction
