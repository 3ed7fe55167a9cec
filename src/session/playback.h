#pragma once
#include <optional>

#include "world/motion.h"

namespace icome::session {

/// The world with its motions at a moment, for a representation that shows them: kept beside the replica
/// at rest while they are played.
class Playback {
 public:
  /// Does anything move?
  bool moves() const { return posed_ && posed_->moves(); }
  /// The world to be shown instead of the one at rest.
  const world::World& shown(const world::World& at_rest) const { return posed_ ? posed_->world() : at_rest; }

  /// Plays the motions from `time` (s) after their beginning on; none: ends playing. Gives the changes.
  world::Changes play(const world::World& at_rest, std::optional<double> time);
  /// Follows edits of the world that changed this; adds the moving objects to the changes.
  world::Changes follow(const world::World& at_rest, const world::Changes& changes, double time);
  /// Goes to a later time (s). Nothing changes while nothing is played.
  world::Changes go_to(double time) { return posed_ ? posed_->go_to(time) : world::Changes(); }

 private:
  std::optional<world::PosedWorld> posed_;  // none: all is at rest
};

}  // namespace icome::session
