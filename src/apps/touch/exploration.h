#pragma once
#include <string>
#include <vector>

#include "apps/touch/touch_models.h"
#include "base/vector.h"

namespace icome::apps {

/// The way that the simulated hand takes over the models, planned by geometry alone, before the servo starts
/// and without the solver that will touch them: strokes a little below the surface, so that the hand presses,
/// and flights through free space in between. A closed model is looked at from everywhere, a sheet or a
/// half-space from its front, as they are at the start. Immutable.
class Exploration {
 public:
  struct Leg;

  /// The share of its time that a hand should touch.
  static constexpr double kEnough = 0.6;

  /// Plans about `seconds` of way over the models, at least one, for a tip of radius `tip` (m); a longer run
  /// goes back the same way. Where there are effects alone, it leads through the air about these.
  static Exploration plan(const std::vector<TouchModel>& models, double tip, double seconds);

  /// A clause that says why a hand on this way may have touched for less than that.
  std::string why_little() const;

  /// The place that the hand aims for `t` >= 0 seconds after the start, m, world frame. Real-time safe.
  base::Vector3 target(double t) const;

  /// The middle of the models, m: the place for the device's workspace.
  const base::Vector3& centre() const { return centre_; }

 private:
  Exploration() = default;
  static Exploration over_surfaces(const std::vector<TouchModel>& models, double tip, double seconds);
  static Exploration among_effects(const std::vector<TouchModel>& models, double seconds);
  void follow(const std::vector<Leg>& way, double speed);

  base::Vector3 centre_ = base::Vector3::Zero();
  double planned_ = 0.0;                // the share of the way that presses
  bool changes_ = false;                // does anything change with time?
  std::vector<base::Vector3> targets_;  // one each kStep seconds, at least two
};

}  // namespace icome::apps
