#pragma once
#include <vector>

#include "apps/touch_models.h"
#include "base/vector.h"
#include "haptics/renderer.h"

namespace icome::apps {

/// The way that the simulated hand takes over the models: from outside onto the surface, then along a
/// slow spiral that runs a little below it, so that the hand presses all the time. A closed model is
/// seen from the middle of all directions, a sheet or a half-space from its front. Planned before the
/// servo starts; immutable.
class Exploration {
 public:
  /// Plans about `seconds` of way for a tip of radius `tip` (m); a longer run goes back the same way.
  /// The models, at least one, are those of the scene; `renderer` is the one that will touch them.
  static Exploration plan(const std::vector<TouchModel>& models, const haptics::HapticScene& scene,
                          double tip, double seconds, haptics::Renderer renderer);

  /// Where the hand wants to be `t` >= 0 seconds after the start, m, world frame. Real-time safe.
  base::Vector3 target(double t) const;

  /// The middle of the models, m: where the device's workspace belongs.
  const base::Vector3& centre() const { return centre_; }

 private:
  Exploration() = default;
  void follow(const std::vector<base::Vector3>& way, double usual_speed, double seconds);

  base::Vector3 centre_ = base::Vector3::Zero();
  std::vector<base::Vector3> targets_;  // one each kStep seconds, at least two
};

}  // namespace icome::apps
