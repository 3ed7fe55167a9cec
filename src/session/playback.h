#pragma once
#include <optional>

#include "world/motion.h"

namespace icome::session {

/// The world as its motions have it, for a representation that shows them: kept beside the replica at rest
/// while they are played.
class Playback {
 public:
  /// Does anything move?
  bool moves() const { return posed_ && posed_->moves(); }
  /// What is to be shown of a world that is this at rest.
  const world::World& shown(const world::World& at_rest) const { return posed_ ? posed_->world() : at_rest; }

  /// From now, `time` (s) after the motions began, they are played; or not any more. Gives what has changed.
  world::Changes play(const world::World& at_rest, std::optional<double> time);
  /// The world has been through edits that changed this; adds what moves.
  world::Changes follow(const world::World& at_rest, const world::Changes& changes, double time);
  /// Time has passed. Nothing changes while nothing is played.
  world::Changes go_to(double time) { return posed_ ? posed_->go_to(time) : world::Changes(); }

 private:
  std::optional<world::PosedWorld> posed_;  // none: all is at rest
};

}  // namespace icome::session
