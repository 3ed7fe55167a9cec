#pragma once
#include <optional>
#include <string>

#include "session/hands/hand_grab.h"
#include "session/hands/point_pull.h"

namespace icome::session {

/// Shapes by touch: while button 0 of a pointer device is down, the vertex, edge, face or point of a lattice
/// that was nearest to the tip goes along with it, and pulls back (thesis 4.5.3); one action to undo. Parts
/// of meshes are those of the touched object and of the selection. It lets go when anything else changes the
/// world. One thread (main) uses it.
class PointGrab {
 public:
  /// The largest distance of the tip from a handle that it takes hold of.
  static constexpr double kReach = 0.01;  // m

  /// The feel of the hand from now on, when that is something new; to be called once for each update of the
  /// session, while that is shaping. `refused` gets the reason why something could not be dragged.
  std::optional<haptics::GripFeel> update(Session& session, std::size_t pointer, const Revisions& revisions,
                                          const GrabSettings& settings, std::string& refused);

  bool holds() const { return pull_.has_value(); }
  /// The handle that it holds or would take hold of.
  const std::optional<interaction::MarkedHandle>& marked() const { return marked_; }

 private:
  bool begin(Session& session, const base::Vector3& tip, std::uint64_t revision, std::string& refused);
  bool follow(Session& session, const base::Vector3& tip, const Revisions& revisions, std::string& refused);
  void look(Session& session, std::size_t pointer);

  std::optional<PointPull> pull_ = {};
  base::Vector3 start_ = base::Vector3::Zero();  // m, of the tip, stage frame
  std::uint64_t revision_ = 0;                   // of the world, as this left it
  std::optional<interaction::MarkedHandle> marked_ = {};
  bool was_down_ = true;  // a button that is down when shaping begins does not count
};

}  // namespace icome::session
