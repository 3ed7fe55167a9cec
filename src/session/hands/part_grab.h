#pragma once
#include <optional>
#include <string>

#include "session/hands/hand_grab.h"
#include "session/hands/part_pull.h"

namespace icome::session {

/// Drags by hand a part of the selection that has a place of its own: while button 0 of a pointer device is
/// down that touched nothing when it went down, the operand or the projector whose outline was nearest goes
/// along with the tip, turns with the stylus, and pulls back; one action to undo. It lets go when anything
/// else changes the world. One thread (main) uses it.
class PartGrab {
 public:
  /// The largest distance of the tip from an outline.
  static constexpr double kReach = 0.005;  // m

  /// The feel of the hand from now on, when that is something new; to be called once for each update of the
  /// session. `refused` gets the reason why something could not be dragged.
  std::optional<haptics::GripFeel> update(Session& session, std::size_t pointer, const Revisions& revisions,
                                          std::string& refused);

  bool holds() const { return held_.has_value(); }

 private:
  struct Held {
    PartPull pull;
    base::Vector3 start;      // m, of the tip, stage frame
    base::Quaternion turned;  // stage_from_stylus then
    std::uint64_t revision;   // of the world, as this left it
  };
  std::optional<haptics::GripFeel> begin(Session& session, std::size_t pointer, const Revisions& revisions,
                                         std::string& refused);
  base::Result<void> follow(Session& session, const PointerView& hand);

  std::optional<Held> held_ = {};
  bool was_down_ = true;  // a button that is down already does not count
};

}  // namespace icome::session
