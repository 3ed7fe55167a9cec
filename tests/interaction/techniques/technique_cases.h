#pragma once
#include <gtest/gtest.h>

#include "base/random.h"
#include "interaction/techniques/technique.h"

namespace icome::interaction {

// What the tests of techniques share.

/// A ball of that number there.
inline SceneTarget ball_target(TargetId id, const Vector3& at, double radius = 0.05) {
  SceneTarget target;
  target.id = id;
  target.world_from_target.translation() = at;
  target.radius = radius;
  return target;
}

inline TechniqueScene scene_of(const std::vector<SceneTarget>& targets) {
  TechniqueScene scene;
  for (const SceneTarget& target : targets) EXPECT_TRUE(scene.add(target));
  return scene;
}

inline Pose pose_at(const Vector3& at, const base::Matrix3& turned = base::Matrix3::Identity()) {
  Pose pose = Pose::Identity();
  pose.linear() = turned;
  pose.translation() = at;
  return pose;
}

inline base::Matrix3 turn_about(const Vector3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

inline Pose random_pose(base::Random& random, double reach = 1.0) {
  return pose_at(random.uniform(0.0, reach) * random.direction(),
                 turn_about(random.direction(), random.uniform(-3.0, 3.0)));
}

/// A person whose eyes are at (0, 1.6, 0), with the first hand there.
inline TechniqueInput person_with(const Pose& hand, double time = 0.0) {
  TechniqueInput input;
  input.time = time;
  input.room_from_head.translation() = Vector3(0.0, 1.6, 0.0);
  input.hands[0].tracked = true;
  input.hands[0].room_from_hand = hand;
  return input;
}

}  // namespace icome::interaction
