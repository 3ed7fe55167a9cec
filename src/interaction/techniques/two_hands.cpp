#include "interaction/techniques/two_hands.h"

#include <algorithm>
#include <cmath>

#include "base/decompositions.h"

namespace icome::interaction {
namespace {

using base::Pose;
using base::Quaternion;
using base::Vector3;

Vector3 between(const std::array<Pose, 2>& hands) { return hands[1].translation() - hands[0].translation(); }

/// Angle of a turn about the axis (unit), rad, in (-pi, pi].
double twist_about(const Quaternion& turn, const Vector3& axis) {
  const double angle = 2.0 * std::atan2(turn.vec().dot(axis), turn.w());
  return std::remainder(angle, 2.0 * EIGEN_PI);
}

/// The turn of the line between the hands the short way, and then that of the hands about it.
Quaternion turn_of_hands(const std::array<Pose, 2>& before, const std::array<Pose, 2>& now) {
  const Quaternion swing = base::rotation_between(between(before), between(now));
  const Vector3 line = between(now).normalized();
  double twist = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    const Quaternion hand_turn(now[i].linear() * before[i].linear().transpose());
    twist += 0.5 * twist_about(hand_turn * swing.conjugate(), line);
  }
  return Quaternion(Eigen::AngleAxisd(twist, line)) * swing;
}

}  // namespace

TwoHandGrip::TwoHandGrip(const TwoHandSettings& settings, const std::array<Pose, 2>& hands,
                         const Vector3& pivot)
    : settings_(settings),
      pivot_(pivot),
      middle_start_(0.5 * (hands[0].translation() + hands[1].translation())),
      middle_(middle_start_),
      apart_start_(between(hands).norm()),
      apart_(apart_start_),
      turned_at_(hands) {}

void TwoHandGrip::follow(const std::array<Pose, 2>& hands) {
  middle_ = 0.5 * (hands[0].translation() + hands[1].translation());
  apart_ = between(hands).norm();
  if (apart_ < settings_.closest) return;
  // A line that was too short to turn begins where it is long enough.
  if (between(turned_at_).norm() >= settings_.closest)
    turn_ = (turn_of_hands(turned_at_, hands) * turn_).normalized();
  turned_at_ = hands;
}

double TwoHandGrip::growth() const {
  return std::max(apart_, settings_.closest) / std::max(apart_start_, settings_.closest);
}

base::Affine3 TwoHandGrip::moved() const {
  const Vector3 from = settings_.moves ? middle_start_ : pivot_;
  const Vector3 to = settings_.moves ? middle_ : pivot_;
  base::Affine3 result = base::Affine3::Identity();
  result.translate(to);
  if (settings_.turns) result.rotate(turn_);
  if (settings_.scales) result.scale(growth());
  result.translate(-from);
  return result;
}

}  // namespace icome::interaction
