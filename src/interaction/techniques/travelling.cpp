#include "interaction/techniques/travelling.h"

#include <algorithm>
#include <cmath>

#include "interaction/techniques/similarity.h"

namespace icome::interaction {
namespace {

Ray pointing_ray(const TechniqueInput& input, const base::Affine3& world_from_room) {
  const Pose hand = carried_by(world_from_room, input.hands[0].room_from_hand);
  return {hand.translation(), -hand.linear().col(2)};
}

View view_at(const Pose& world_from_eye, double scale) {
  View view;
  view.world_from_eye = world_from_eye;
  view.distance = scale;
  return usable(view);
}

Vector3 middle_to_orbit(const TravelMoment& now) {
  if (const SceneTarget* target = now.scene.find(now.about)) return ball_of(*target).centre;
  const base::Bounds bounds = now.scene.bounds();
  return bounds.isEmpty() ? Vector3(Vector3::Zero()) : Vector3(bounds.center());
}

bool is_room_place(const base::Affine3& world_from_room) {
  constexpr double kFarthestRoom = 1e8;  // m
  return world_from_room.matrix().allFinite() &&
         world_from_room.matrix().cwiseAbs().maxCoeff() <= kFarthestRoom &&
         world_from_room.linear().determinant() > 0.0;
}

}  // namespace

std::string_view name_of(Travelling travelling) {
  switch (travelling) {
    case Travelling::None:
      return "none";
    case Travelling::Orbit:
      return "orbit";
    case Travelling::Fly:
      return "fly";
    case Travelling::Teleport:
      return "teleport";
    case Travelling::Miniature:
      return "world in miniature";
  }
  return "";
}

std::optional<Vector3> teleport_place(const TechniqueScene& scene, const Ray& ray,
                                      const TravelSettings& settings) {
  const double drop = ray.origin.y() - settings.floor;
  const double fall = -ray.direction.y();
  std::optional<double> floor;
  if (drop > 0.0 && fall > 0.0) floor = drop / fall;
  const auto hit = scene.first_hit(ray);
  const bool thing = hit && (!floor || hit->distance < *floor);
  if (!thing && !floor) return std::nullopt;
  double length = thing ? hit->distance : *floor;
  if (thing) {
    const double level = std::hypot(ray.direction.x(), ray.direction.z());
    if (level > 0.0) length = std::max(0.0, length - settings.stand_off / level);
  }
  if (!(length <= settings.farthest)) return std::nullopt;
  Vector3 place = ray.origin + length * ray.direction;
  place.y() = settings.floor;
  return place;
}

/// Two hands turn the world about its middle or the selected target, so the person goes the other way.
base::Affine3 Travel::orbit(const TravelMoment& now, const base::Affine3& world_from_room) {
  const auto& hands = now.input.hands;
  if (!hands[0].tracked || !hands[1].tracked || !hands[0].travel || !hands[1].travel) {
    orbit_.reset();
    return world_from_room;
  }
  const std::array<Pose, 2> poses = {hands[0].room_from_hand, hands[1].room_from_hand};
  // A held object may make the room larger or smaller; then orbiting begins anew.
  constexpr double kSameScale = 1e-9;
  const bool resized =
      orbit_ && std::abs(scale_of(world_from_room) / scale_of(orbit_->world_from_room) - 1.0) > kSameScale;
  if (!orbit_ || resized) {
    orbit_ = Orbit{TwoHandGrip({}, poses, Vector3::Zero()), world_from_room, middle_to_orbit(now),
                   now.input.room_from_head.translation()};
    return world_from_room;
  }
  orbit_->grip.follow(poses);
  const Vector3& centre = orbit_->centre;
  const base::Matrix3 axes = orbit_->world_from_room.linear() / scale_of(orbit_->world_from_room);
  const base::Matrix3 back = axes * orbit_->grip.turn().conjugate().toRotationMatrix() * axes.transpose();
  base::Affine3 turned_room = base::Affine3::Identity();
  turned_room.translate(centre).rotate(back).translate(-centre);
  turned_room = turned_room * orbit_->world_from_room;
  const Vector3 away = turned_room * orbit_->head - centre;
  return Eigen::Translation3d((orbit_->grip.growth() - 1.0) * away) * turned_room;
}

/// The eyes fly; the room keeps its present size, which a held object may change on the way.
base::Affine3 Travel::arrive(const TravelMoment& now, const base::Affine3& world_from_room) {
  const Arrival arrival = *arrival_;
  const ViewFlight flight(arrival.from, arrival.to, arrival.seconds);
  const double time = now.input.time - arrival.begun;
  if (flight.over(time)) arrival_.reset();
  return base::Affine3(flight.at(time).world_from_eye) * Eigen::Scaling(scale_of(world_from_room)) *
         base::Affine3(arrival.room_from_head.inverse());
}

/// Sets the destination of a teleport while the button is down.
void Travel::aim(const TravelMoment& now, const base::Affine3& world_from_room) {
  destination_.reset();
  const auto place = teleport_place(now.scene, pointing_ray(now.input, world_from_room), now.settings);
  if (!place) return;
  Pose eye = carried_by(world_from_room, now.input.room_from_head);
  eye.translation() = Vector3(place->x(), eye.translation().y(), place->z());
  destination_ = eye;
}

/// The hand takes the likeness of the person in the miniature, and moves it.
void Travel::take_likeness(const TravelMoment& now, const base::Affine3& world_from_room) {
  const base::Affine3 copy =
      copy_from_world(now.sizes.miniature, now.scene.bounds(), now.input, world_from_room);
  const Pose hand = carried_by(world_from_room, now.input.hands[0].room_from_hand);
  if (!pressed_) {
    const Pose likeness = carried_by(copy, carried_by(world_from_room, now.input.room_from_head));
    const double radius = scale_of(world_from_room) * now.settings.likeness_radius;
    if ((likeness.translation() - hand.translation()).norm() <= radius)
      hand_from_likeness_ = hand.inverse() * likeness;
  }
  if (hand_from_likeness_) destination_ = carried_by(copy.inverse(), hand * *hand_from_likeness_);
}

void Travel::set_out(const TravelMoment& now, const base::Affine3& world_from_room) {
  const Pose destination = *destination_;
  destination_.reset();
  hand_from_likeness_.reset();
  const double scale = scale_of(world_from_room);
  const Pose eye = carried_by(world_from_room, now.input.room_from_head);
  arrival_ = Arrival{view_at(eye, scale), view_at(destination, scale), now.input.time,
                     now.settings.flight_seconds, now.input.room_from_head};
}

base::Affine3 Travel::follow(const TravelMoment& now, const base::Affine3& world_from_room) {
  const HandInput& hand = now.input.hands[0];
  base::Affine3 result = world_from_room;
  const bool pressed = hand.tracked && hand.travel;
  if (arrival_) {
    result = arrive(now, world_from_room);
  } else if (travelling_ == Travelling::Orbit) {
    result = orbit(now, world_from_room);
  } else if (travelling_ == Travelling::Fly && pressed) {
    const double step = now.settings.fly_speed * scale_of(world_from_room) * now.seconds;
    result =
        Eigen::Translation3d(step * pointing_ray(now.input, world_from_room).direction) * world_from_room;
  } else if (pressed && travelling_ == Travelling::Teleport) {
    aim(now, world_from_room);
  } else if (pressed && travelling_ == Travelling::Miniature) {
    take_likeness(now, world_from_room);
  } else if (pressed_ && destination_ && !hand.travel) {
    set_out(now, world_from_room);
  }
  if (!hand.travel) hand_from_likeness_.reset();
  pressed_ = hand.travel;
  return is_room_place(result) ? result : world_from_room;
}

}  // namespace icome::interaction
