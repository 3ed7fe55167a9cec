#pragma once
#include <array>

#include "base/vector.h"

namespace icome::interaction {

/// The changes that two hands make to a thing that they hold (thesis 2.3.1).
struct TwoHandSettings {
  bool moves = true;
  bool turns = true;
  bool scales = true;
  double closest = 0.03;  // m: hands that are nearer to each other neither turn nor scale; 0.01 to 0.1
};

/// Two hands that hold something: it moves with the point half way between them, turns with the line between
/// them and, about that line, by the mean turn of the hands, and grows as they part. A plain value. Hands
/// that both move as one rigid thing take it along as that thing.
class TwoHandGrip {
 public:
  /// `pivot` stays where it is if the grip does not move things.
  TwoHandGrip(const TwoHandSettings& settings, const std::array<base::Pose, 2>& hands,
              const base::Vector3& pivot);
  /// Takes the hands' new poses. Turning is followed from step to step.
  void follow(const std::array<base::Pose, 2>& hands);
  /// The map from places at the beginning of the grip to places now; identity at the beginning.
  base::Affine3 moved() const;
  /// The turn since the beginning.
  const base::Quaternion& turn() const { return turn_; }
  /// The hands' distance, in that at the beginning.
  double growth() const;

 private:
  TwoHandSettings settings_;
  base::Vector3 pivot_;
  base::Vector3 middle_start_, middle_;
  double apart_start_, apart_;
  std::array<base::Pose, 2> turned_at_;  // the hands when they turned last
  base::Quaternion turn_ = base::Quaternion::Identity();
};

}  // namespace icome::interaction
