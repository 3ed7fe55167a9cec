#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "session/hands/object_drag.h"
#include "session/hands/pointer_view.h"
#include "session/revisions.h"

namespace icome::session {

class Session;

/// Grabs by touch (the linear virtual hand of thesis 2.2.4): while button 0 of a pointer device is down, the
/// object that it touched when it went down goes along with the tip, with the rest of the selection if it is
/// of that; one action to undo. Where surfaces stop it the hand is pushed back, and snaps pull. It lets go
/// when anything else changes the world. One thread (main) uses it.
class HandGrab {
 public:
  /// The feel of the hand from now on, while it holds something and when it lets go; to be called once
  /// for each update of the session. `refused` gets the reason why something could not be moved.
  std::optional<haptics::GripFeel> update(Session& session, std::size_t pointer, const Revisions& revisions,
                                          std::string& refused);

  bool holds() const { return held_.has_value(); }

 private:
  struct Held {
    ObjectDrag drag;
    base::Vector3 start = base::Vector3::Zero();  // m, of the tip, stage frame
    std::uint64_t revision = 0;                   // of the world, as this left it
  };
  void begin(Session& session, std::size_t pointer, std::uint64_t revision);
  bool follow(Session& session, const base::Vector3& tip, const Revisions& revisions, std::string& refused);

  void arrive(Session& session, const Revisions& revisions);

  std::optional<Held> held_ = {};
  std::optional<Held> let_go_ = {};  // while it is not known yet how far it comes
  bool was_down_ = false;
};

}  // namespace icome::session
