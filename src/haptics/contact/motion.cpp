#include "haptics/contact/motion.h"

#include <algorithm>

namespace icome::haptics {
namespace {

/// A turn by the vector's length about its direction.
base::Quaternion turn_by(const Vector3& rotation) {
  const double angle = rotation.norm();
  if (angle <= 0.0) return base::Quaternion::Identity();
  return base::Quaternion(Eigen::AngleAxisd(angle, rotation / angle));
}

}  // namespace

Motion motion_between(const Pose& from, const Pose& to, double seconds) {
  const Eigen::AngleAxisd turned(base::Matrix3(to.linear() * from.linear().transpose()));
  Motion motion;
  motion.linear = (to.translation() - from.translation()) / seconds;
  motion.angular = turned.angle() / seconds * turned.axis();
  motion.arrives = motion.ends = seconds;
  return motion;
}

Pose moved(const Pose& said, const Motion& motion, double elapsed) {
  if (motion.still()) return said;
  const double time = std::clamp(elapsed, 0.0, motion.ends) - motion.arrives;
  Pose result = said;
  result.linear() = turn_by(motion.angular * time) * result.linear();
  result.translation() += motion.linear * time;
  return result;
}

Vector3 velocity_at(const Pose& pose, const Motion& motion, double elapsed, const Vector3& place) {
  if (!motion.moves(elapsed)) return Vector3::Zero();
  return motion.linear + motion.angular.cross(place - pose.translation());
}

Pose between(const Pose& from, const Pose& to, double share) {
  Pose result;
  const base::Quaternion before(from.linear());
  result.linear() = before.slerp(share, base::Quaternion(to.linear())).normalized().toRotationMatrix();
  result.translation() = from.translation() + share * (to.translation() - from.translation());
  return result;
}

}  // namespace icome::haptics
